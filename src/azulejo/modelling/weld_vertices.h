#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "azulejo/data/array.h"
#include "azulejo/modelling/weld.h"

namespace azulejo {

/// Of each position, the first one that it becomes one with (itself, if it stays): as `weld` says, within a positive
/// tolerance or, with 0, at exactly equal positions.
///
/// classes  positions of different classes stay apart; empty: all are of one
Array<std::uint32_t> weld_vertices(std::span<const glm::vec3> positions, std::span<const std::uint32_t> classes,
                                   WeldMethod method, double tolerance, const Run& run);

}  // namespace azulejo
