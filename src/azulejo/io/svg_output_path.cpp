#include <cmath>

#include "azulejo/io/svg_output.h"

namespace azulejo {
namespace {

bool is_finite(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// Writes the commands of one path.
class PathWriter {
 public:
  PathWriter(std::string& text, const glm::mat3x2& matrix) : text_(text), matrix_(matrix) {
    moved_ = matrix != glm::mat3x2(1, 0, 0, 1, 0, 0);
  }

  void put(PathCommand command, const glm::vec2* points) {
    glm::vec2 p[3] = {};
    const std::size_t count = points_of(command);
    bool finite = true;
    for (std::size_t i = 0; i < count; ++i) {
      p[i] = moved_ ? transformed(matrix_, points[i]) : points[i];
      finite = finite && is_finite(p[i]);
    }
    switch (command) {
      case PathCommand::Move: move(p[0], finite); return;
      case PathCommand::Close: close(); return;
      case PathCommand::Line: return segment(command, p, 1, finite);
      case PathCommand::Quadratic: return segment(command, p, 2, finite);
      case PathCommand::Cubic: return segment(command, p, 3, finite);
    }
  }

 private:
  void move(const glm::vec2& to, bool finite) {
    here_ = start_ = to;
    drawn_ = whole_ = finite;
    if (finite) put_move(to);
  }

  void put_move(const glm::vec2& to) {
    put_letter('M');
    put_point(to);
    drawn_ = true;
  }

  /// To the end of `points`, from where the path is.
  void segment(PathCommand command, const glm::vec2* points, std::size_t count, bool finite) {
    const glm::vec2 to = points[count - 1];
    if (!finite || !is_finite(here_)) {
      whole_ = drawn_ = false;
      here_ = to;
      return;
    }
    if (!drawn_) put_move(here_);
    if (command == PathCommand::Line) {
      put_line(to);
    } else {
      put_letter(command == PathCommand::Quadratic ? 'Q' : 'C');
      for (std::size_t i = 0; i < count; ++i) put_point(points[i]);
    }
    here_ = to;
  }

  void put_line(const glm::vec2& to) {
    if (to.y == here_.y) {
      put_letter('H');
      put_coordinate(to.x);
    } else if (to.x == here_.x) {
      put_letter('V');
      put_coordinate(to.y);
    } else {
      put_letter('L');
      put_point(to);
    }
  }

  void close() {
    if (whole_) {
      text_ += 'Z';
      letter_ = 'Z';
      here_ = start_;
      return;
    }
    // Something before was left out: the subpath that is written begins elsewhere.
    segment(PathCommand::Line, &start_, 1, is_finite(start_));
    drawn_ = false;
    here_ = start_;
  }

  void put_letter(char letter) {
    // Coordinates behind a Move would be lines.
    if (letter != letter_ || letter == 'M') text_ += letter;
    first_ = letter != letter_ || letter == 'M';
    letter_ = letter;
  }

  void put_point(const glm::vec2& point) {
    put_coordinate(point.x);
    put_coordinate(point.y);
  }

  void put_coordinate(float value) {
    if (!first_ && !(value < 0)) text_ += ' ';
    first_ = false;
    put_number(text_, value);
  }

  std::string& text_;
  glm::mat3x2 matrix_;
  bool moved_ = false;
  char letter_ = 0;
  bool first_ = false;  ///< a letter stands before the next number
  bool drawn_ = false;  ///< the last that was written ends where the path is
  bool whole_ = false;  ///< all of the subpath was written
  glm::vec2 here_{0, 0};
  glm::vec2 start_{0, 0};
};

void put_circle(std::string& text, const glm::mat3x2& shape) {
  Path circle;
  constexpr float kReach = 0.5522847498F;  // of the control points of a quarter
  circle.move_to({1, 0});
  circle.cubic_to({1, kReach}, {kReach, 1}, {0, 1}).cubic_to({-kReach, 1}, {-1, kReach}, {-1, 0});
  circle.cubic_to({-1, -kReach}, {-kReach, -1}, {0, -1}).cubic_to({kReach, -1}, {1, -kReach}, {1, 0}).close();
  put_path_data(text, {circle.commands, circle.points}, shape);
}

void put_polygon(std::string& text, const glm::mat3x2& shape, std::initializer_list<glm::vec2> corners) {
  Path polygon;
  for (const glm::vec2& corner : corners) {
    polygon.commands.empty() ? polygon.move_to(corner) : polygon.line_to(corner);
  }
  polygon.close();
  put_path_data(text, {polygon.commands, polygon.points}, shape);
}

/// Two bars, each a quarter as thick as long; `turned`: a ×.
void put_bars(std::string& text, const glm::mat3x2& shape, bool turned) {
  constexpr float kHalf = 0.25F;
  constexpr float kSide = 1 / (1 + kHalf);  // its corners reach as far as those of a square
  const glm::mat3x2 turn(kSide, kSide, -kSide, kSide, 0, 0);
  put_polygon(text, turned ? combined(shape, turn) : shape,
              {{-1, -kHalf},
               {-kHalf, -kHalf},
               {-kHalf, -1},
               {kHalf, -1},
               {kHalf, -kHalf},
               {1, -kHalf},
               {1, kHalf},
               {kHalf, kHalf},
               {kHalf, 1},
               {-kHalf, 1},
               {-kHalf, kHalf},
               {-1, kHalf}});
}

/// A mark that reaches from -1 to 1, brought to its place.
void put_mark(std::string& text, PointShape shape, const glm::mat3x2& place) {
  switch (shape) {
    case PointShape::Circle: return put_circle(text, place);
    case PointShape::Square: return put_polygon(text, place, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
    case PointShape::Diamond: return put_polygon(text, place, {{0, -1}, {1, 0}, {0, 1}, {-1, 0}});
    case PointShape::Triangle: return put_polygon(text, place, {{0, -1}, {1, 1}, {-1, 1}});
    case PointShape::Plus: return put_bars(text, place, false);
    case PointShape::Cross: return put_bars(text, place, true);
  }
}

}  // namespace

void put_path_data(std::string& text, const PathView& path, const glm::mat3x2& matrix) {
  PathWriter writer(text, matrix);
  const glm::vec2* points = path.points.data();
  for (const PathCommand command : path.commands) {
    writer.put(command, points);
    points += points_of(command);
  }
}

void put_marks(std::string& text, const PathView& path, PointShape shape, float size, const glm::mat3x2& to_page) {
  const float area = to_page[0].x * to_page[1].y - to_page[1].x * to_page[0].y;
  if (!std::isfinite(1 / area)) return;
  // What a step on the page is in the path's coordinates.
  const float scale = size / 2 / area;
  glm::mat3x2 place(to_page[1].y * scale, -to_page[0].y * scale, -to_page[1].x * scale, to_page[0].x * scale, 0, 0);
  const glm::vec2* points = path.points.data();
  for (const PathCommand command : path.commands) {
    points += points_of(command);
    if (command == PathCommand::Close || !is_finite(points[-1])) continue;
    place[2] = points[-1];
    put_mark(text, shape, place);
  }
}

}  // namespace azulejo
