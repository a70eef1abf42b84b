#include "azulejo/rendering/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "azulejo/modelling/curve_points.h"
#include "azulejo/modelling/path_segments.h"
#include "azulejo/rendering/dash.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostDashes = std::size_t{1} << 21;
constexpr float kFinestPattern = 0.25F;
constexpr float kFarthest = 1e12F;
/// Square of the share of a side that a join may take away: both leave some.
constexpr float kSpare = 0.16F;
/// Of a curve's piece, before it is taken as a cusp.
constexpr int kMostRefinements = 64;

/// Where the pen moves: a space in which it is round and a unit is about a pixel.
struct PenSpace {
  glm::mat3x2 pen_from_path;
  std::optional<glm::mat3x2> picture_from_pen;  ///< none: they are the same
  float scale = 1;                              ///< pen units of the style's unit of length
};

PenSpace pen_space(const glm::mat3x2& picture_from_path, bool fixed) {
  if (fixed) return {picture_from_path, std::nullopt, 1};
  const glm::dvec2 x(picture_from_path[0]);
  const glm::dvec2 y(picture_from_path[1]);
  const double sum = glm::dot(x, x) + glm::dot(y, y);
  const double determinant = x.x * y.y - x.y * y.x;
  // The difference of the squares of the singular values.
  const double difference = std::sqrt(std::max(0.0, sum * sum - 4 * determinant * determinant));
  const double scale = std::sqrt((sum + difference) / 2);
  constexpr double kSimilar = 1e-5;
  if (difference <= kSimilar * sum) return {picture_from_path, std::nullopt, static_cast<float>(scale)};
  const auto s = static_cast<float>(scale);
  return {{s, 0, 0, s, 0, 0}, glm::mat3x2(glm::vec2(x / scale), glm::vec2(y / scale), picture_from_path[2]), s};
}

/// The window as the pen sees it, with all around it from which a line can reach into it.
Box2 pen_window(const Box2& window, const PenSpace& space, const StrokeShape& shape) {
  constexpr float kAll = std::numeric_limits<float>::infinity();
  Box2 seen{window.lower - 1.0F, window.upper + 1.0F};
  if (space.picture_from_pen) {
    const glm::dmat3x2 m(*space.picture_from_pen);
    const double determinant = m[0].x * m[1].y - m[0].y * m[1].x;
    Box2 box;
    for (int corner = 0; corner < 4; ++corner) {
      const glm::dvec2 at((corner & 1) != 0 ? seen.upper.x : seen.lower.x,
                          (corner & 2) != 0 ? seen.upper.y : seen.lower.y);
      const glm::dvec2 v = at - m[2];
      const glm::vec2 point(glm::dvec2(m[1].y * v.x - m[1].x * v.y, m[0].x * v.y - m[0].y * v.x) / determinant);
      if (!finite(point)) return {glm::vec2(-kAll), glm::vec2(kAll)};
      box.lower = glm::min(box.lower, point);
      box.upper = glm::max(box.upper, point);
    }
    seen = box;
  }
  float reach = shape.cap == LineCap::Square ? 1.5F : 1.0F;
  if (shape.join == LineJoin::Miter) reach = std::max(reach, shape.miter_limit);
  return {seen.lower - reach * shape.radius, seen.upper + reach * shape.radius};
}

glm::vec2 left_of(const glm::vec2& direction, float length) {
  const glm::dvec2 d(direction);
  const double square = glm::dot(d, d);
  return square > 0 ? glm::vec2(glm::dvec2(-d.y, d.x) * (static_cast<double>(length) / std::sqrt(square)))
                    : glm::vec2(0);
}

/// Cuts segments into pieces, dashes them and hands what is in the window to the pen.
class Stroker {
 public:
  Stroker(const StrokeShape& shape, const Box2& window, const DashPattern* pattern, const glm::vec2& x_axis,
          StrokeScratch& scratch, FlatPath& result)
      : shape_(shape), window_(window), x_axis_(x_axis), pen_(shape, scratch, result) {
    if (pattern != nullptr) dash_.emplace(*pattern);
    const glm::vec2 size = window.upper - window.lower;
    long_ = 2 * (size.x + size.y);
    // Half of the tolerance is for the distance of a curve from its chords, half for that of its sides.
    turn_limit_ = shape.radius * std::max(shape.radius - 2 * shape.tolerance, 0.5F * shape.radius);
  }

  bool too_many_dashes() const { return dashes_ > kMostDashes; }

  void begin(const glm::vec2& point, bool closes) {
    here_ = start_ = point;
    has_length_ = false;
    first_.reset();
    if (dash_) dash_->restart();
    starts_line_ = closes && is_on();
    run_start_ = StrokeEnd::Cap;
  }

  void lines(const glm::vec2* points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) line(points[i]);
  }

  void curve(const CurveSegment& curve) {
    const glm::vec2 end = curve.points[curve.order];
    if (!is_seen(curve, window_)) return line(end);
    visible_curve(curve);
    here_ = end;
  }

  void end(bool closed) {
    if (!has_length_) return dot();
    if (!pen_.empty()) {
      if (closed && first_) {
        pen_.add(beginning_of(*first_), StrokeJoint::Styled);
        return pen_.finish(StrokeEnd::Seam);
      }
      pen_.finish(StrokeEnd::Cap);
    }
    if (first_ && shape_.cap != LineCap::Butt) {
      pen_.begin(StrokeEnd::Cap, beginning_of(*first_));
      pen_.finish(StrokeEnd::Seam);
    }
  }

 private:
  bool is_on() const { return !dash_ || dash_->on(); }

  void line(const glm::vec2& to) {
    constexpr float kLeast = 1e-30F;
    constexpr float kMost = 1e24F;
    const glm::vec2 along = to - here_;
    const float square = glm::dot(along, along);
    if (square >= kLeast && square <= kMost) {
      const float length = std::sqrt(square);
      const glm::vec2 normal = glm::vec2(-along.y, along.x) * (shape_.radius / length);
      place({here_, to, normal, normal, kSpare * square}, StrokeJoint::Styled, length);
    } else if (square > kMost) {
      const glm::vec2 from = glm::clamp(here_, -kFarthest, kFarthest);
      const glm::vec2 end = glm::clamp(to, -kFarthest, kFarthest);
      const glm::vec2 normal = left_of(end - from, shape_.radius);
      const float length = glm::length(end - from);
      if (length > 0) place({from, end, normal, normal, kSpare * length * length}, StrokeJoint::Styled, length);
    } else {
      return;
    }
    here_ = to;
  }

  void visible_curve(const CurveSegment& curve) {
    const int pieces = pieces_of_curve(curve, 0.5F * shape_.tolerance);
    const CurvePolynomial polynomial(curve);
    const auto& p = curve.points;
    // Where control points coincide the next one gives the direction of an end.
    std::size_t begin = 1;
    while (begin < curve.order && p[begin] == p[0]) ++begin;
    std::size_t end = curve.order - 1;
    while (end > 0 && p[end] == p[curve.order]) --end;
    Sample before{p[0], left_of(p[begin] - p[0], shape_.radius), 0};
    joint_ = StrokeJoint::Styled;
    for (int i = 1; i <= pieces; ++i) {
      Sample sample{p[curve.order], left_of(p[curve.order] - p[end], shape_.radius), 1};
      if (i < pieces) sample = sample_of(polynomial, static_cast<float>(i) / static_cast<float>(pieces));
      span(polynomial, before, sample);
      before = sample;
    }
  }

  struct Sample {
    glm::vec2 point;
    glm::vec2 normal;
    float at;
  };

  Sample sample_of(const CurvePolynomial& polynomial, float t) const {
    const glm::vec2 tangent = polynomial.tangent_at(t);
    const float square = glm::dot(tangent, tangent);
    const glm::vec2 normal =
        square > 1e-30F ? glm::vec2(-tangent.y, tangent.x) * (shape_.radius / std::sqrt(square)) : glm::vec2(0);
    return {polynomial.at(t), normal, t};
  }

  /// From sample to sample, with more between where the direction changes so much that the sides would leave the
  /// tolerance.
  void span(const CurvePolynomial& polynomial, const Sample& from, const Sample& to) {
    if (glm::dot(from.normal, to.normal) >= turn_limit_) return curve_piece(from, to);
    // The angle is at most a half turn; that of a span may be as far as `angle` from one limit to the other.
    const float allowed = std::sqrt(2 * (1 - turn_limit_ / (shape_.radius * shape_.radius)));
    const int spans = std::clamp(static_cast<int>(std::ceil(3.1416F / allowed)), 2, kMostRefinements);
    Sample before = from;
    for (int i = 1; i <= spans; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(spans);
      const Sample sample = i < spans ? sample_of(polynomial, from.at + share * (to.at - from.at)) : to;
      curve_piece(before, sample);
      before = sample;
    }
  }

  void curve_piece(const Sample& from, const Sample& to) {
    const glm::vec2 along = to.point - from.point;
    const float square = glm::dot(along, along);
    if (!(square > 1e-30F)) return;
    StrokePiece piece{from.point, to.point, from.normal, to.normal, kSpare * square};
    const bool smooth =
        glm::dot(from.normal, to.normal) >= turn_limit_ && along.x * from.normal.y > along.y * from.normal.x;
    if (smooth) {
      const float change = std::abs(glm::dot(to.normal - from.normal, along));
      const float inner = std::max(0.0F, square - change);
      piece.spare = kSpare * inner * inner / square;
    } else {
      piece.from_normal = piece.to_normal = glm::vec2(-along.y, along.x) * (shape_.radius / std::sqrt(square));
    }
    StrokeJoint joint = joint_;
    if (joint != StrokeJoint::Styled) {
      joint = piece.from_normal == normal_ ? StrokeJoint::Smooth : StrokeJoint::Round;
    }
    place(piece, joint, std::sqrt(square));
    normal_ = piece.to_normal;
    joint_ = StrokeJoint::Smooth;
  }

  void place(StrokePiece piece, StrokeJoint joint, float length) {
    has_length_ = true;
    if (!meets(window_, glm::min(piece.from, piece.to), glm::max(piece.from, piece.to))) return leave_out(length);
    if (length > long_) return place_long(piece, joint, length);
    put(piece, joint, length);
  }

  /// Only what is in the window of a piece that is much longer.
  void place_long(const StrokePiece& piece, StrokeJoint joint, float length) {
    const glm::dvec2 from(piece.from);
    const glm::dvec2 along = glm::dvec2(piece.to) - from;
    double begin = 0;
    double end = 1;
    for (int axis = 0; axis < 2; ++axis) {
      if (along[axis] == 0) continue;
      const double a = (window_.lower[axis] - from[axis]) / along[axis];
      const double b = (window_.upper[axis] - from[axis]) / along[axis];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    if (!(begin < end)) return leave_out(length);
    StrokePiece part = piece;
    if (begin > 0) {
      leave_out(static_cast<float>(begin * length));
      part.from = glm::vec2(from + begin * along);
    }
    if (end < 1) part.to = glm::vec2(from + end * along);
    put(part, joint, static_cast<float>((end - begin) * length));
    if (end < 1) leave_out(static_cast<float>((1 - end) * length));
  }

  void leave_out(float length) {
    if (!pen_.empty()) pen_.finish(StrokeEnd::Seam);
    run_start_ = StrokeEnd::Seam;
    starts_line_ = false;
    if (dash_) dash_->skip(length);
  }

  void put(const StrokePiece& piece, StrokeJoint joint, float length) {
    if (!dash_) return draw(piece, joint);
    const double whole = length;
    double done = 0;
    while (whole - done >= dash_->left() && !too_many_dashes()) {
      const double stop = done + dash_->left();
      if (dash_->on()) {
        if (stop > done || shape_.cap != LineCap::Butt) draw(part_of(piece, done / whole, stop / whole), joint);
        if (!pen_.empty()) pen_.finish(StrokeEnd::Cap);
        ++dashes_;
      }
      dash_->turn();
      run_start_ = StrokeEnd::Cap;
      starts_line_ = false;
      done = stop;
    }
    if (dash_->on() && whole > done) draw(part_of(piece, done / whole, 1), joint);
    dash_->advance(std::max(0.0, whole - done));
  }

  StrokePiece part_of(const StrokePiece& piece, double begin, double end) const {
    const bool straight = piece.from_normal == piece.to_normal;
    const auto at = [&](double share) { return piece.from + static_cast<float>(share) * (piece.to - piece.from); };
    const auto normal_at = [&](double share) {
      if (straight || share == 0) return piece.from_normal;
      const glm::vec2 mixed = piece.from_normal + static_cast<float>(share) * (piece.to_normal - piece.from_normal);
      return mixed * (shape_.radius / glm::length(mixed));
    };
    StrokePiece part = piece;
    if (begin > 0) {
      part.from = at(begin);
      part.from_normal = normal_at(begin);
    }
    if (end < 1) {
      part.to = at(end);
      part.to_normal = end > begin ? normal_at(end) : part.from_normal;
    }
    const auto share = static_cast<float>(end - begin);
    part.spare *= share * share;
    return part;
  }

  void draw(const StrokePiece& piece, StrokeJoint joint) {
    if (!pen_.empty()) return pen_.add(piece, joint);
    if (starts_line_) first_ = piece;
    pen_.begin(starts_line_ ? StrokeEnd::Seam : run_start_, piece);
    starts_line_ = false;
  }

  /// A piece without length, to join to another's seam or to put a cap there.
  static StrokePiece beginning_of(const StrokePiece& piece) {
    return {piece.from, piece.from, piece.from_normal, piece.from_normal, 0};
  }

  void dot() {
    if (shape_.cap == LineCap::Butt || !is_on()) return;
    const glm::vec2 normal = left_of(x_axis_, shape_.radius);
    pen_.begin(StrokeEnd::Cap, {start_, start_, normal, normal, 0});
    pen_.finish(StrokeEnd::Cap);
  }

  StrokeShape shape_;
  Box2 window_;
  glm::vec2 x_axis_;
  StrokePen pen_;
  std::optional<DashPosition> dash_;
  std::size_t dashes_ = 0;
  float long_ = 0;        ///< beyond that a piece is clipped
  float turn_limit_ = 0;  ///< product of a piece's normals
  glm::vec2 here_{0};
  glm::vec2 start_{0};
  glm::vec2 normal_{0};  ///< of the curve's piece before
  StrokeJoint joint_ = StrokeJoint::Styled;
  bool has_length_ = false;
  StrokeEnd run_start_ = StrokeEnd::Cap;  ///< how the next run begins
  bool starts_line_ = false;              ///< that is where a line begins which is closed, perhaps
  std::optional<StrokePiece> first_;      ///< of such a line, where it is drawn: its seam waits for a join, or a cap
};

}  // namespace

void stroke_path(const PathView& path, const DrawingStyle& style, const glm::mat3x2& picture_from_path,
                 const StrokeOptions& options, StrokeScratch& scratch, FlatPath& result) {
  const PenSpace space = pen_space(picture_from_path, style.fixed_stroke);
  constexpr float kLeast = 1e-6F;
  constexpr float kMost = 1e9F;
  StrokeShape shape{0.5F * style.stroke_width * space.scale, style.cap, style.join, style.miter_limit,
                    options.tolerance};
  if (!(shape.radius >= 0.5F * kLeast)) return;
  shape.radius = std::min(shape.radius, 0.5F * kMost);
  const float extension = style.cap == LineCap::Square  ? 2 * shape.radius
                          : style.cap == LineCap::Round ? 1.5707963F * shape.radius
                                                        : 0.0F;
  std::optional<DashPattern> pattern = DashPattern::of(style, space.scale);
  const auto make_solid = [&] {
    shape.radius *= pattern->share(extension);
    pattern.reset();
  };
  if (pattern && pattern->period() < kFinestPattern) make_solid();
  const glm::vec2 x_axis = space.picture_from_pen ? glm::vec2(1, 0) : picture_from_path[0];
  const std::size_t first_point = result.points.size();
  const std::size_t first_contour = result.contour_count();
  const auto stroke = [&] {
    Stroker stroker(shape, pen_window(options.window, space, shape), pattern ? &*pattern : nullptr, x_axis, scratch,
                    result);
    walk_segments(path, space.pen_from_path, stroker);
    return !stroker.too_many_dashes();
  };
  if (!stroke()) {
    result.points.resize(first_point);
    result.starts.resize(first_contour);
    result.closed.resize(first_contour);
    result.summed.resize(first_contour);
    make_solid();
    stroke();
  }
  if (!space.picture_from_pen) return;
  for (std::size_t i = first_point; i < result.points.size(); ++i) {
    result.points[i] = transformed(*space.picture_from_pen, result.points[i]);
  }
}

}  // namespace azulejo
