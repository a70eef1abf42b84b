#include "azulejo/io/svg_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "azulejo/io/svg_text.h"
#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

constexpr double kPi = 3.141592653589793;

glm::vec2 stored(const glm::dvec2& point) { return {to_float(point.x), to_float(point.y)}; }

double squared_length(const glm::dvec2& v) { return v.x * v.x + v.y * v.y; }

/// What follows the endpoints in an arc command.
struct ArcShape {
  glm::dvec2 radii;
  double degrees = 0;
  bool large = false;
  bool sweep = false;
};

/// An arc as its center sees it: center + x cos + y sin.
struct CenteredArc {
  glm::dvec2 center;
  glm::dvec2 x;
  glm::dvec2 y;
  double first = 0;
  double sweep = 0;
};

/// Source: SVG 1.1, F.6.5 and F.6.6. Nothing where it can't be computed.
std::optional<CenteredArc> centered(const glm::dvec2& from, const glm::dvec2& to, const ArcShape& shape) {
  const double angle = std::fmod(shape.degrees, 360.0) * kPi / 180;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  glm::dvec2 radii(std::abs(shape.radii.x), std::abs(shape.radii.y));
  const glm::dvec2 half = (from - to) / 2.0;
  // In the ellipse's axes, where it is a unit circle.
  glm::dvec2 unit((c * half.x + s * half.y) / radii.x, (c * half.y - s * half.x) / radii.y);
  const double size = std::sqrt(squared_length(unit));
  if (!std::isfinite(size) || size == 0) return std::nullopt;
  if (size > 1) {
    radii *= size;
    unit /= size;
  }
  const double rest = std::sqrt(std::max(0.0, 1 / std::min(squared_length(unit), 1.0) - 1));
  const double side = shape.large == shape.sweep ? -1 : 1;
  const glm::dvec2 middle = glm::dvec2(unit.y, -unit.x) * (side * rest);
  CenteredArc arc;
  arc.x = glm::dvec2(c, s) * radii.x;
  arc.y = glm::dvec2(-s, c) * radii.y;
  arc.center = (from + to) / 2.0 + arc.x * middle.x + arc.y * middle.y;
  arc.first = std::atan2(unit.y - middle.y, unit.x - middle.x);
  arc.sweep = std::atan2(-unit.y - middle.y, -unit.x - middle.x) - arc.first;
  if (shape.sweep && arc.sweep < 0) arc.sweep += 2 * kPi;
  if (!shape.sweep && arc.sweep > 0) arc.sweep -= 2 * kPi;
  return std::isfinite(squared_length(arc.center)) ? std::optional(arc) : std::nullopt;
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
    ArcShape shape;
    glm::dvec2 to;
    if (!next_number(shape.radii.x) || !next_number(shape.radii.y) || !next_number(shape.degrees) ||
        !next_flag(shape.large) || !next_flag(shape.sweep) || !next_point(to, relative)) {
      return false;
    }
    add_arc_to(to, shape);
    return arrive(to, to, Before::Other);
  }

  void add_arc_to(const glm::dvec2& to, const ArcShape& shape) {
    if (to == here_) return;
    const bool flat = shape.radii.x == 0 || shape.radii.y == 0;
    const std::optional<CenteredArc> arc = flat ? std::nullopt : centered(here_, to, shape);
    if (!arc) {
      path_.line_to(stored(to));
      return;
    }
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(arc->sweep) / (kPi / 4) - 1e-9)));
    const double step = arc->sweep / count;
    const double reach = 4.0 / 3 * std::tan(step / 4);
    const auto at = [&](double angle) { return arc->center + arc->x * std::cos(angle) + arc->y * std::sin(angle); };
    const auto along = [&](double angle) { return (arc->y * std::cos(angle) - arc->x * std::sin(angle)) * reach; };
    glm::dvec2 from = here_;
    for (int i = 0; i < count; ++i) {
      const double begin = arc->first + step * i;
      const double end = arc->first + step * (i + 1);
      const glm::dvec2 stop = i + 1 == count ? to : at(end);
      path_.cubic_to(stored(from + along(begin)), stored(stop - along(end)), stored(stop));
      from = stop;
    }
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
  const double reach = 4.0 / 3 * std::tan(kPi / 16);
  const auto from_circle = [&](double x, double y) { return stored(center + radii * glm::dvec2(x, y)); };
  Turn from = turn_of(first_eighth, 8);
  const glm::vec2 start = from_circle(from.cosine, from.sine);
  if (path.commands.empty()) {
    path.move_to(start);
  } else if (path.points.back() != start) {
    path.line_to(start);
  }
  for (int i = first_eighth + 1; i <= first_eighth + count; ++i) {
    const Turn to = turn_of(i, 8);
    path.cubic_to(from_circle(from.cosine - reach * from.sine, from.sine + reach * from.cosine),
                  from_circle(to.cosine + reach * to.sine, to.sine - reach * to.cosine),
                  from_circle(to.cosine, to.sine));
    from = to;
  }
}

}  // namespace azulejo
