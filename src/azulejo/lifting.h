#pragma once

#include <span>
#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/engine/operation.h"

namespace azulejo {

/// Whether an operation on a mesh can be done to each mesh of a scene: its first input is its only mesh, and it gives
/// meshes and reports only.
bool is_liftable(const Operation& operation);

/// What an output of a lifted operation holds: scenes in place of meshes.
ValueKind lifted_kind(ValueKind output);

/// Runs an operation on a mesh once for each mesh of a scene, the first of `inputs`; instances share its result.
/// Nodes, materials and all else stay. A scene with skinned or morphed meshes is posed first, with a warning.
///
/// options         the same for each; whole numbers of fields that are `shared` are divided among the meshes in proportion
///                 to their triangles
/// mesh outputs    a scene with the results in place of the meshes
/// report outputs  the sums of the numbers that the reports have, and "meshes": each report with the mesh's name
/// stages          of a scene with several meshes: those of the first under step "-0", of the second "-1", …
/// Throws          as invoke
std::vector<Value> invoke_lifted(const Operation& operation, const void* options, std::span<const Value> inputs,
                                 const Run& run, const std::string& step);

}  // namespace azulejo
