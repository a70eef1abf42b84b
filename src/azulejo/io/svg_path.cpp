#include "azulejo/io/svg_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "azulejo/io/svg_text.h"
#include "azulejo/math/arc.h"

namespace azulejo {
namespace {

glm::vec2 stored(const glm::dvec2& point) { return {to_float(point.x), to_float(point.y)}; }

/// Appends an arc that begins at the path's end; `last` is its end exactly.
void append(Path& path, const EllipticalArc& arc, const glm::dvec2& last) {
  constexpr double kShare = 5e-6;  // of the radius: an eighth of a turn is one cubic
  const double radius = std::sqrt(std::max(glm::dot(arc.x, arc.x), glm::dot(arc.y, arc.y)));
  const auto cubics = arc_to_cubics(arc, kShare * radius);
  if (cubics.empty()) path.line_to(stored(last));  // so short that its ends are one
  for (std::size_t i = 0; i < cubics.size(); ++i) {
    path.cubic_to(stored(cubics[i][1]), stored(cubics[i][2]), stored(i + 1 == cubics.size() ? last : cubics[i][3]));
  }
}

class PathReader {
 public:
  PathReader(std::string_view text, Path& path) : next_(text.data()), end_(next_ + text.size()), path_(path) {}

  bool read() {
    skip_blanks();
    while (next_ != end_) {
      const char command = *next_++;
      if (path_is_empty_ && command != 'M' && command != 'm') return false;
      if (!command_with_arguments(command)) return false;
      skip_blanks();
    }
    return true;
  }

 private:
  void skip_blanks() {
    while (next_ != end_ && is_svg_blank(*next_)) ++next_;
  }

  bool number(double& value) {
    const char* const behind = parse_svg_number(next_, end_, value);
    if (behind == nullptr) return false;
    next_ = behind;
    return true;
  }

  /// A number behind another.
  bool next_number(double& value) {
    skip_between();
    return number(value);
  }

  bool skip_between() {
    skip_blanks();
    if (next_ == end_ || *next_ != ',') return false;
    ++next_;
    skip_blanks();
    return true;
  }

  /// 0 or 1, which needs nothing between itself and what follows.
  bool next_flag(bool& value) {
    skip_between();
    if (next_ == end_ || (*next_ != '0' && *next_ != '1')) return false;
    value = *next_++ == '1';
    return true;
  }

  bool next_point(glm::dvec2& point, bool relative) {
    if (!next_number(point.x) || !next_number(point.y)) return false;
    if (relative) point += here_;
    return true;
  }

  /// A command, and its repetitions without a letter.
  bool command_with_arguments(char letter) {
    const bool relative = letter >= 'a';
    char command = static_cast<char>(letter & ~0x20);
    if (command == 'Z') return close();
    skip_blanks();
    for (bool first = true;; first = false) {
      const char* const before = next_;
      const bool comma = !first && skip_between();
      // A number, or the end of the repetitions.
      const bool begins = next_ != end_ && (text_begins_number(*next_));
      if (!begins) {
        if (!first && !comma) next_ = before;
        return !first && !comma;
      }
      if (!arguments(command, relative)) return false;
      if (command == 'M') command = 'L';
    }
  }

  static bool text_begins_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }

  bool arguments(char command, bool relative) {
    switch (command) {
      case 'M': return move(relative);
      case 'L': return line(relative);
      case 'H':
      case 'V': return straight(command == 'H', relative);
      case 'C':
      case 'S': return cubic(command == 'S', relative);
      case 'Q':
      case 'T': return quadratic(command == 'T', relative);
      case 'A': return arc(relative);
      default: return false;
    }
  }

  bool move(bool relative) {
    glm::dvec2 to;
    if (!next_point(to, relative)) return false;
    path_.move_to(stored(to));
    path_is_empty_ = false;
    start_ = to;
    return arrive(to, to, Before::Other);
  }

  bool close() {
    path_.close();
    return arrive(start_, start_, Before::Other);
  }

  bool line(bool relative) {
    glm::dvec2 to;
    if (!next_point(to, relative)) return false;
    path_.line_to(stored(to));
    return arrive(to, to, Before::Other);
  }

  bool straight(bool horizontal, bool relative) {
    double value = 0;
    if (!next_number(value)) return false;
    glm::dvec2 to = here_;
    double& changed = horizontal ? to.x : to.y;
    changed = relative ? changed + value : value;
    path_.line_to(stored(to));
    return arrive(to, to, Before::Other);
  }

  bool cubic(bool smooth, bool relative) {
    glm::dvec2 first = before_ == Before::Cubic ? 2.0 * here_ - control_ : here_;
    glm::dvec2 second;
    glm::dvec2 to;
    if (!smooth && !next_point(first, relative)) return false;
    if (!next_point(second, relative) || !next_point(to, relative)) return false;
    path_.cubic_to(stored(first), stored(second), stored(to));
    return arrive(to, second, Before::Cubic);
  }

  bool quadratic(bool smooth, bool relative) {
    glm::dvec2 control = before_ == Before::Quadratic ? 2.0 * here_ - control_ : here_;
    glm::dvec2 to;
    if (!smooth && !next_point(control, relative)) return false;
    if (!next_point(to, relative)) return false;
    path_.quadratic_to(stored(control), stored(to));
    return arrive(to, control, Before::Quadratic);
  }

  bool arc(bool relative) {
    glm::dvec2 radii;
    double degrees = 0;
    bool large = false;
    bool sweep = false;
    glm::dvec2 to;
    if (!next_number(radii.x) || !next_number(radii.y) || !next_number(degrees) || !next_flag(large) ||
        !next_flag(sweep) || !next_point(to, relative)) {
      return false;
    }
    if (const auto arc = arc_between(here_, to, radii, std::fmod(degrees, 360.0) / 360, large, sweep)) {
      append(path_, *arc, to);
    } else if (to != here_) {
      path_.line_to(stored(to));
    }
    return arrive(to, to, Before::Other);
  }

  enum class Before { Other, Cubic, Quadratic };

  bool arrive(const glm::dvec2& to, const glm::dvec2& control, Before kind) {
    here_ = to;
    control_ = control;
    before_ = kind;
    return true;
  }

  const char* next_;
  const char* const end_;
  Path& path_;
  bool path_is_empty_ = true;
  glm::dvec2 here_{0, 0};
  glm::dvec2 start_{0, 0};
  glm::dvec2 control_{0, 0};  ///< the last of the segment before
  Before before_ = Before::Other;
};

}  // namespace

bool parse_path_data(std::string_view text, Path& path) { return PathReader(text, path).read(); }

void add_arc(Path& path, const glm::dvec2& center, const glm::dvec2& radii, int first_eighth, int count) {
  const EllipticalArc arc = arc_around(center, radii, 0, first_eighth / 8.0, count / 8.0);
  const auto at = [&](const glm::dvec2& unit) { return center + radii * unit; };
  const glm::vec2 start = stored(at(arc.first));
  if (path.commands.empty()) {
    path.move_to(start);
  } else if (path.points.back() != start) {
    path.line_to(start);
  }
  append(path, arc, at(arc.last));
}

}  // namespace azulejo
