#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {

/// "#d0021b": what a kind of fault is drawn in.
AZULEJO_EXPORT std::string_view mark_color(MeshFaultKind kind);

struct MarkedScene {
  Scene scene;
  std::array<std::size_t, kMeshFaultKinds> marks{};   ///< how many of each kind are drawn
  std::array<std::size_t, kMeshFaultKinds> hidden{};  ///< and of these, about how many the first camera can't see
};

/// The meshes of a scene in pale gray with their faults on them, in colors that don't depend on the light: edges as tubes,
/// vertices as balls, faces tinted, those too small to be seen with a ball too; where many balls of one kind are crowded,
/// some of them. Textures, attributes, lights, cameras,
/// animations are left out. Where no place shows all marks the gray is half transparent.
///
/// topologies  of each of the scene's meshes
/// at_most     marks of each kind; the first ones that the topologies list. Those of nodes that aren't visible, and what
///             is not finite or beyond 10³⁰, are left out
/// cameras     "faults" sees all meshes; then one for each kind that is marked, of its name, sees these from nearer.
///             Each looks from the one of 27 directions from which the most marks are not hidden, each kind counted as
///             much as any other; of equal ones from azimuth 30°, elevation 20°
/// Cost        O(meshes' size); with faults, 27 times as much. Memory about 400 bytes a mark
/// Throws      as Scene; the scene must need no pose
AZULEJO_EXPORT MarkedScene mark_faults(const Scene& scene, std::span<const Topology> topologies, std::size_t at_most,
                                       const Run& run = {});

}  // namespace azulejo
