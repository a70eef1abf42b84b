#include "azulejo/modelling/classify_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/math/predicates.h"
#include "azulejo/modelling/classify_in_mesh.h"
#include "azulejo/modelling/path_polygon.h"

namespace azulejo {
namespace {

struct Line {
  glm::dvec2 a;
  glm::dvec2 b;
};

bool is_finite(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

std::vector<Line> lines_of(const Polygon& polygon) {
  std::vector<Line> lines;
  lines.reserve(polygon.points.size());
  std::vector<glm::dvec2> ring;
  for (std::size_t r = 0; r < polygon.ring_count(); ++r) {
    ring.clear();
    for (const glm::vec2& point : polygon.ring(r)) {
      if (is_finite(point)) ring.emplace_back(point);
    }
    for (std::size_t i = 0; i < ring.size(); ++i) lines.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]});
  }
  return lines;
}

bool lies_on(const Line& line, const glm::dvec2& point) {
  return std::min(line.a.x, line.b.x) <= point.x && point.x <= std::max(line.a.x, line.b.x) &&
         std::min(line.a.y, line.b.y) <= point.y && point.y <= std::max(line.a.y, line.b.y) &&
         orient2d(line.a, line.b, point) == 0;
}

bool is_near(const Line& line, const glm::dvec2& point, double distance) {
  const glm::dvec2 along = line.b - line.a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(point - line.a, along) / square, 0.0, 1.0) : 0.0;
  const glm::dvec2 away = point - (line.a + t * along);
  return glm::dot(away, away) <= distance * distance;
}

/// What going from one place to another adds to the winding where it crosses a line; neither place is on it. Ends of
/// lines that are met count as left of the way.
int crossing(const Line& line, const glm::dvec2& from, const glm::dvec2& to) {
  if (std::max(line.a.x, line.b.x) < std::min(from.x, to.x) || std::min(line.a.x, line.b.x) > std::max(from.x, to.x) ||
      std::max(line.a.y, line.b.y) < std::min(from.y, to.y) || std::min(line.a.y, line.b.y) > std::max(from.y, to.y)) {
    return 0;
  }
  const bool from_left = orient2d(line.a, line.b, from) > 0;
  const bool to_left = orient2d(line.a, line.b, to) > 0;
  if (from_left == to_left) return 0;
  const bool a_left = orient2d(from, to, line.a) >= 0;
  const bool b_left = orient2d(from, to, line.b) >= 0;
  if (a_left == b_left) return 0;
  return to_left ? 1 : -1;
}

}  // namespace

/// Lines by the cells of a grid, and the winding of a place in each cell: on the way from there to a point in the same
/// cell only the cell's lines can be crossed.
struct PointClassifier::Index {
  std::vector<Line> lines;
  FillRule rule = FillRule::NonZero;
  double border = 0;
  glm::dvec2 lower{0, 0};
  glm::dvec2 upper{-1, -1};
  int columns = 1;
  int rows = 1;
  glm::dvec2 cells_per_unit{0, 0};
  glm::dvec2 cell_size{1, 1};
  std::vector<std::uint32_t> begins;  ///< of each cell, into `members`
  std::vector<std::uint32_t> members;
  struct Reference {
    glm::dvec2 place;
    int winding = 0;
  };
  std::vector<Reference> references;

  static int cell(double offset, double per_unit, int count) {
    return static_cast<int>(std::clamp(offset * per_unit, 0.0, static_cast<double>(count - 1)));
  }
  int column(double x) const { return cell(x - lower.x, cells_per_unit.x, columns); }
  int row(double y) const { return cell(y - lower.y, cells_per_unit.y, rows); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  std::span<const std::uint32_t> members_of(std::size_t cell) const {
    return {members.data() + begins[cell], begins[cell + 1] - begins[cell]};
  }
  bool contains(int winding) const { return rule == FillRule::NonZero ? winding != 0 : (winding & 1) != 0; }

  void measure();
  template <class Take>
  void cells_of(const Line& line, Take take) const;
  void fill_cells();
  void place_references();
  int crossings(std::size_t cell, const glm::dvec2& from, const glm::dvec2& to) const;
  int crossings(std::size_t left, std::size_t right, const glm::dvec2& from, const glm::dvec2& to) const;
  glm::dvec2 free_place(int column, int row) const;
  PointClass classify(const glm::vec2& point) const;
};

/// So many columns and rows that lines are in few cells, and few lines in a cell.
void PointClassifier::Index::measure() {
  lower = glm::dvec2(std::numeric_limits<double>::max());
  upper = -lower;
  glm::dvec2 lengths(0);
  for (const Line& line : lines) {
    lower = glm::min(lower, glm::min(line.a, line.b));
    upper = glm::max(upper, glm::max(line.a, line.b));
    lengths += glm::abs(line.b - line.a);
  }
  lower -= glm::dvec2(border);
  upper += glm::dvec2(border);
  const glm::dvec2 size = upper - lower;
  const auto count = static_cast<double>(lines.size());
  // Of n lines, about n (1 + columns · mean width + rows · mean height) memberships; 4 n of each kind at most.
  const auto most = [&](double length, double extent) {
    const double spans = extent > 0 ? (length + count * 2 * border) / extent : 0;
    return spans > 0 ? std::clamp(4 * count / spans, 1.0, 2 * count + 1) : 1.0;
  };
  double wanted_columns = most(lengths.x, size.x);
  double wanted_rows = most(lengths.y, size.y);
  const double cells = 2 * count + 1;
  if (wanted_columns * wanted_rows > cells) {
    const double less = std::sqrt(cells / (wanted_columns * wanted_rows));
    wanted_columns = std::max(1.0, wanted_columns * less);
    wanted_rows = std::clamp(cells / wanted_columns, 1.0, wanted_rows);
    wanted_columns = std::clamp(cells / wanted_rows, 1.0, wanted_columns);
  }
  columns = static_cast<int>(wanted_columns);
  rows = static_cast<int>(wanted_rows);
  if (size.x > 0) cell_size.x = size.x / columns;
  if (size.y > 0) cell_size.y = size.y / rows;
  cells_per_unit = {size.x > 0 ? columns / size.x : 0, size.y > 0 ? rows / size.y : 0};
}

/// Calls take(cell) for the cells that a line is in or near, and maybe for a few more.
template <class Take>
void PointClassifier::Index::cells_of(const Line& line, Take take) const {
  const bool rises = line.a.y <= line.b.y;
  const glm::dvec2& low = rises ? line.a : line.b;
  const glm::dvec2& high = rises ? line.b : line.a;
  const glm::dvec2 slack = border + 1e-9 * (upper - lower) / glm::dvec2(columns, rows);
  const int last_row = row(high.y + slack.y);
  const int first_row = row(low.y - slack.y);
  const double slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0;
  const double least = std::min(low.x, high.x);
  const double most = std::max(low.x, high.x);
  for (int r = first_row; r <= last_row; ++r) {
    double begin = least;
    double end = most;
    if (first_row != last_row && high.y > low.y) {
      const double row_begin = lower.y + r * cell_size.y - slack.y;
      const double row_end = lower.y + (r + 1) * cell_size.y + slack.y;
      const double x0 = std::clamp(low.x + (row_begin - low.y) * slope, least, most);
      const double x1 = std::clamp(low.x + (row_end - low.y) * slope, least, most);
      begin = std::min(x0, x1);
      end = std::max(x0, x1);
    }
    const int last = column(end + slack.x);
    for (int c = column(begin - slack.x); c <= last; ++c) take(at(c, r));
  }
}

void PointClassifier::Index::fill_cells() {
  begins.assign(at(0, rows) + 1, 0);
  for (const Line& line : lines) {
    cells_of(line, [&](std::size_t cell) { ++begins[cell + 1]; });
  }
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  members.resize(begins.back());
  std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
  for (std::uint32_t l = 0; l < lines.size(); ++l) {
    cells_of(lines[l], [&](std::size_t cell) { members[next[cell]++] = l; });
  }
}

int PointClassifier::Index::crossings(std::size_t cell, const glm::dvec2& from, const glm::dvec2& to) const {
  int sum = 0;
  for (const std::uint32_t member : members_of(cell)) sum += crossing(lines[member], from, to);
  return sum;
}

/// On a way through two cells: lines in both count once.
int PointClassifier::Index::crossings(std::size_t left, std::size_t right, const glm::dvec2& from,
                                      const glm::dvec2& to) const {
  int sum = crossings(left, from, to);
  const auto known = members_of(left);
  for (const std::uint32_t member : members_of(right)) {
    if (!std::binary_search(known.begin(), known.end(), member)) sum += crossing(lines[member], from, to);
  }
  return sum;
}

/// A place in a cell that isn't on a line: of finitely many lines, each can be met by two of the tries at most where
/// these lie on no line themselves, as points of a parabola do.
glm::dvec2 PointClassifier::Index::free_place(int column, int row) const {
  const glm::dvec2 corner = lower + glm::dvec2(column, row) * cell_size;
  const std::size_t tries = 2 * members_of(at(column, row)).size() + 1;
  for (std::size_t i = 0;; ++i) {
    const double t = 0.3 + 0.4 * static_cast<double>(i) / static_cast<double>(tries);
    const glm::dvec2 place = corner + glm::dvec2(t, t * t + 0.25) * cell_size;
    const auto on = [&](std::uint32_t member) { return lies_on(lines[member], place); };
    const auto cell = members_of(at(column, row));
    if (i > tries || std::none_of(cell.begin(), cell.end(), on)) return place;
  }
}

void PointClassifier::Index::place_references() {
  references.resize(begins.size() - 1);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const std::size_t here = at(c, r);
      Reference& reference = references[here];
      reference.place = free_place(c, r);
      if (c == 0) {  // from outside
        const glm::dvec2 outside(lower.x - columns * cell_size.x, reference.place.y);
        reference.winding = crossings(here, outside, reference.place);
      } else {
        const Reference& before = references[here - 1];
        reference.winding = before.winding + crossings(here - 1, here, before.place, reference.place);
      }
    }
  }
}

PointClass PointClassifier::Index::classify(const glm::vec2& point) const {
  const glm::dvec2 p(point);
  if (!(p.x >= lower.x && p.y >= lower.y && p.x <= upper.x && p.y <= upper.y)) return PointClass::Outside;
  const std::size_t cell = at(column(p.x), row(p.y));
  int around = references[cell].winding;
  for (const std::uint32_t member : members_of(cell)) {
    const Line& line = lines[member];
    if (border > 0 ? is_near(line, p, border) : lies_on(line, p)) return PointClass::Border;
    around += crossing(line, references[cell].place, p);
  }
  return contains(around) ? PointClass::Inside : PointClass::Outside;
}

PointClassifier::PointClassifier(const Polygon& polygon, FillRule rule, float border) {
  auto index = std::make_unique<Index>();
  index->lines = lines_of(polygon);
  index->rule = rule;
  index->border = border > 0 ? double{border} : 0;
  if (!index->lines.empty()) {
    index->measure();
    index->fill_cells();
    index->place_references();
  }
  index_ = std::move(index);
}
PointClassifier::~PointClassifier() = default;
PointClassifier::PointClassifier(PointClassifier&&) noexcept = default;
PointClassifier& PointClassifier::operator=(PointClassifier&&) noexcept = default;

PointClass PointClassifier::operator()(const glm::vec2& point) const { return index_->classify(point); }

void PointClassifier::classify(std::span<const glm::vec2> points, std::span<PointClass> results, const Run& run) const {
  parallel_for(points.size(), 16384, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = index_->classify(points[i]);
  });
}

namespace {

std::vector<Value> run_classify_points(std::span<const Value> inputs, const ClassifyPointsOptions& options,
                                       const Run& run) {
  ClassifiedPoints result = classify_points(*inputs[0].drawing(), *inputs[1].mesh(), options, run);
  std::vector<Value> results;
  results.emplace_back(std::move(result.points));
  results.emplace_back(std::move(result.report));
  return results;
}

/// The one path that is filled, else the union of all.
std::pair<Polygon, FillRule> area_of(const Drawing& drawing, float tolerance, const Run& run) {
  std::vector<PlacedPath> filled;
  for (const PlacedPath& placed : walk(drawing)) {
    if (drawing.styles[drawing.paths[placed.path].style].fill) filled.push_back(placed);
  }
  if (filled.size() != 1) return {filled_area(drawing, tolerance, run), FillRule::NonZero};
  warn_of_unfilled(drawing, run);
  const DrawingPath& path = drawing.paths[filled[0].path];
  return {polygon_of(drawing.view(path), filled[0].page_from_path, tolerance), drawing.styles[path.style].fill_rule};
}

}  // namespace

extern const Operation kClassifyPoints = with_examples(
    with_variants(
        value_operation<ClassifyPointsOptions>(
            "classify_points", "Tells which points are inside of what a drawing fills, or of a surface.",
            {{"source", "the drawing", ValueKind::Drawing},
             {"points", "a mesh, whose vertices are classified; y up, as tessellate places drawings", ValueKind::Mesh}},
            {{"mesh", "the points with an attribute class: 0 outside, 1 inside, 2 border", ValueKind::Mesh},
             {"report", "how many there are of each", ValueKind::Report}},
            {field("border", &ClassifyPointsOptions::border, {0, 1e6}, "",
                   "what is nearer to the outline than this is border"),
             field("tolerance", &ClassifyPointsOptions::tolerance, {1e-6, 1e6}, "",
                   "how far lines may be from curves")},
            run_classify_points),
        {&kClassifyInMesh}),
    {{"curve:kind=star,radii=100,100,fill=orange as:star primitive:kind=plane,size=240,segments=48,rings=48 "
      "transform:rotate_deg=90,axis=1,0,0,translate=100,-100,0 as:grid @star classify_points:points=@grid "
      "color_by:attribute=class render:view=front,width=480,height=360,background=white",
      "Points of a grid, colored by whether they are inside of a star."},
     {"primitive:kind=torus_knot as:knot primitive:kind=plane,size=4.4,segments=200,rings=200 as:grid @knot "
      "classify_points:points=@grid color_by:attribute=class render:view=top,width=480,height=360,background=white",
      "A plane through a knot: where it is inside."}});

ClassifiedPoints classify_points(const Drawing& drawing, const Mesh& points, const ClassifyPointsOptions& options,
                                 const Run& run) {
  kClassifyPoints.check(&options);
  const auto [polygon, rule] = area_of(drawing, options.tolerance, run);
  const PointClassifier classifier(polygon, rule, options.border);
  const std::size_t count = points.vertex_count();
  Array<std::uint32_t> classes;
  classes.resize(count);
  parallel_for(count, 16384, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3& position = points.positions[i];
      classes[i] = static_cast<std::uint32_t>(classifier({position.x, -position.y}));
    }
  });
  return with_classes(points, std::move(classes));
}

}  // namespace azulejo
