#pragma once

#include "azulejo/core/run.h"
#include "azulejo/modelling/plane_graph.h"

namespace azulejo::plane {

/// Puts a point of the grid where edges cross or touch, and leads edges through it: of the result, edges meet at their
/// ends only. An edge moves by less than a step; none goes across a point that it didn't go across before.
///
/// This is snap rounding: squares of the grid with an end or a crossing in them are hot, and every edge through a hot
/// square is bent to its centre. Crossings are found by Bentley and Ottmann's sweep, kept as exact fractions. What else
/// goes through a hot square crosses one of its diagonals: two more sweeps, along the one and the other diagonal, find
/// it among the neighbours of the square's centre.
///
/// Cost    O((n + k) log n), k crossings and squares passed
/// Throws  Error(Resource) beyond run.limits.memory_bytes, Error(Cancelled)
/// Source  J. D. Hobby, Practical segment intersection with finite precision output, 1999; de Berg et al.,
///         Computational geometry, 3rd ed., 2.1
Graph snap_rounded(const Graph& graph, const Run& run);

}  // namespace azulejo::plane
