#pragma once

#include <glm/vec2.hpp>
#include <string_view>

#include "azulejo/data/drawing.h"

namespace azulejo {

/// Appends what path data says ("M1 2h3z"). Arcs become cubics of an eighth of a turn at most: within 5·10⁻⁶ of the radius.
/// Positions are added up in double precision.
///
/// Result  false: there is an error; what stands before it was appended, as SVG wants it
/// Cost    O(text)
/// Source  SVG 1.1, 8.3 and F.6
bool parse_path_data(std::string_view text, Path& path);

/// An arc of an ellipse in the direction from the x to the y axis, in eighths of a turn that begin at the x axis. A line
/// goes to where it begins, a Move if the path is empty.
void add_arc(Path& path, const glm::dvec2& center, const glm::dvec2& radii, int first_eighth, int count);

}  // namespace azulejo
