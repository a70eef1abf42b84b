#pragma once

#include "azulejo/core/run.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/value.h"

namespace azulejo {

/// Whether a value of one kind is taken where another is wanted. Only these: Mesh as Scene, Scene as Mesh, Frame as
/// Image, Labels as Image; and each kind as itself.
bool converts(ValueKind from, ValueKind to);

/// The value as the kind that is wanted.
///
/// Mesh as Scene    shows the mesh alone
/// Scene as Mesh    flattened, skinned meshes posed first, with a warning
/// Frame as Image   its layer "color", else its first; no pixels are copied
/// Labels as Image  the ids: u16, or f32 where there are more than 65535
/// Throws           Error(Argument) for kinds that don't convert and for a frame without layers
Value convert(const Value& value, ValueKind wanted, const Run& run);

/// The variant of an operation that takes such a first input: as it is, else converted; else the operation itself.
const Operation& variant_for(const Operation& operation, ValueKind first);

/// The layer that stands for a frame; null if it has none.
const Image* main_layer(const Frame& frame);

}  // namespace azulejo
