#include "azulejo/modelling/offset.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "azulejo/engine/operation.h"
#include "azulejo/modelling/path_polygon.h"
#include "azulejo/modelling/plane_overlay.h"

namespace azulejo {
namespace {

constexpr int kMostHalvings = 12;  // of a round corner

/// Triangles along the sides of rings that have the inside to their left, on the outer or the inner side.
class BandBuilder {
 public:
  BandBuilder(const OffsetOptions& options, const plane::Grid& grid, plane::GraphBuilder& builder)
      : options_(options), grid_(grid), builder_(builder), distance_(std::abs(double{options.distance})) {}

  void add(std::span<const glm::vec2> ring) {
    const std::size_t count = ring.size();
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec2 before = ring[i == 0 ? count - 1 : i - 1];
      const glm::dvec2 here = ring[i];
      const glm::dvec2 after = ring[i + 1 == count ? 0 : i + 1];
      const glm::dvec2 arriving = direction(before, here);
      const glm::dvec2 leaving = direction(here, after);
      const glm::dvec2 n = normal(leaving);
      triangle(here, here + distance_ * n, after + distance_ * n);
      triangle(here, after + distance_ * n, after);
      const double turn = arriving.x * leaving.y - arriving.y * leaving.x;
      if (outwards() ? turn > 0 : turn < 0) corner(here, arriving, leaving);
    }
  }

 private:
  bool outwards() const { return options_.distance > 0; }
  static glm::dvec2 direction(const glm::dvec2& from, const glm::dvec2& to) {
    return (to - from) / glm::length(to - from);
  }
  /// To the side where the band is.
  glm::dvec2 normal(const glm::dvec2& along) const {
    return outwards() ? glm::dvec2(along.y, -along.x) : glm::dvec2(-along.y, along.x);
  }

  void corner(const glm::dvec2& here, const glm::dvec2& arriving, const glm::dvec2& leaving) {
    std::vector<glm::dvec2> normals{normal(arriving), normal(leaving)};
    const double cosine = glm::dot(normals[0], normals[1]);
    if (options_.join == LineJoin::Round) round(normals, arriving);
    const double limit = options_.miter_limit;
    if (options_.join == LineJoin::Miter && limit * limit * (1 + cosine) >= 2) {
      normals.insert(normals.begin() + 1, (normals[0] + normals[1]) / (1 + cosine));
    }
    for (std::size_t i = 0; i + 1 < normals.size(); ++i) {
      triangle(here, here + distance_ * normals[i], here + distance_ * normals[i + 1]);
    }
  }

  /// Halves the angles until chords are near enough to the circle.
  void round(std::vector<glm::dvec2>& normals, const glm::dvec2& ahead) const {
    for (int halving = 0; halving < kMostHalvings; ++halving) {
      const double middle = glm::length(normals[0] + normals[1]) / 2;  // of a chord, from the centre
      if (distance_ * (1 - middle) <= double{options_.tolerance}) return;
      std::vector<glm::dvec2> finer;
      for (std::size_t i = 0; i + 1 < normals.size(); ++i) {
        const glm::dvec2 sum = normals[i] + normals[i + 1];
        finer.push_back(normals[i]);
        finer.push_back(middle > 1e-9 ? sum / glm::length(sum) : ahead);
      }
      finer.push_back(normals.back());
      normals.swap(finer);
    }
  }

  /// Counter-clockwise, on the grid, whatever rounding did to it: windings of one sign don't cancel each other.
  void triangle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    std::array<plane::GridPoint, 3> corners = {grid_.snap(a), grid_.snap(b), grid_.snap(c)};
    const std::int64_t turn = plane::turn(corners[0], corners[1], corners[2]);
    if (turn == 0) return;
    if (turn < 0) std::swap(corners[1], corners[2]);
    builder_.add(corners, {0, 1});
  }

  const OffsetOptions& options_;
  const plane::Grid& grid_;
  plane::GraphBuilder& builder_;
  double distance_;
};

std::vector<Value> run_offset(std::span<const Value> inputs, const OffsetOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(offset(*inputs[0].drawing(), options, run));
  return results;
}

}  // namespace

extern const Operation kOffset = with_examples(
    value_operation<OffsetOptions>(
        "offset", "Makes what a drawing fills larger or smaller all around.",
        {{"source", "the drawing: its fills, not its lines", ValueKind::Drawing}},
        {{"drawing", "its paths, offset", ValueKind::Drawing}},
        {field("distance", &OffsetOptions::distance, {-1e6, 1e6}, "",
               "outwards, in units of the page; negative: inwards"),
         field("join", &OffsetOptions::join, "how corners look that turn away"),
         field("miter_limit", &OffsetOptions::miter_limit, {1, 1e3}, "",
               "a miter that reaches further than this times the distance becomes a bevel"),
         field("tolerance", &OffsetOptions::tolerance, {1e-6, 1e6}, "", "how far lines may be from curves")},
        run_offset),
    {{"star.svg offset:distance=12 draw", "Larger by 12 px, with round corners."},
     {"star.svg offset:distance=-9,join=miter draw", "Smaller by 9 px."},
     {"star.svg offset:distance=8,join=bevel draw", "Larger, its corners cut off."}});

Polygon offset(const Polygon& polygon, const OffsetOptions& options, FillRule rule, const Run& run) {
  kOffset.check(&options);
  Polygon rings = simplified(polygon, rule, run);
  if (rings.points.empty() || options.distance == 0) return rings;
  const float reach = std::abs(options.distance) * (options.join == LineJoin::Miter ? options.miter_limit : 1.0F);
  const plane::Grid grid(std::min(plane::largest_coordinate(rings) + reach, std::numeric_limits<float>::max()));
  plane::GraphBuilder builder(grid);
  builder.add(rings, {1, 0});
  BandBuilder bands(options, grid, builder);
  for (std::size_t r = 0; r < rings.ring_count(); ++r) bands.add(rings.ring(r));
  const plane::Inside inside = options.distance > 0 ? plane::Inside::Union : plane::Inside::Difference;
  return rings_of(outline(builder.graph(), inside, run), grid);
}

Drawing offset(const Drawing& drawing, const OffsetOptions& options, const Run& run) {
  kOffset.check(&options);
  warn_of_unfilled(drawing, run);
  Drawing result;
  result.width = drawing.width;
  result.height = drawing.height;
  result.unit = drawing.unit;
  result.patterns = drawing.patterns;
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingPath& path = drawing.paths[placed.path];
    if (!drawing.styles[path.style].fill) continue;
    DrawingStyle style = placed_style(drawing, placed, result);
    const Polygon polygon = polygon_of(drawing.view(path), placed.page_from_path, options.tolerance);
    const Polygon moved = offset(polygon, options, style.fill_rule, run);
    style.stroke.reset();
    style.points.reset();
    result.add_path(path_of(moved), result.add_style(style), path.id);
  }
  return result;
}

}  // namespace azulejo
