#include "azulejo/rendering/bin.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace azulejo {
namespace {

std::int64_t snap(float coordinate) {
  return static_cast<std::int64_t>(std::nearbyint(coordinate * static_cast<float>(kSubpixels)));
}

/// A triangle in subpixels, for those that are looked at one by one.
struct Snapped {
  std::array<std::int64_t, 3> x;
  std::array<std::int64_t, 3> y;
  explicit Snapped(const std::array<ScreenVertex, 3>& v)
      : x{snap(v[0].x), snap(v[1].x), snap(v[2].x)}, y{snap(v[0].y), snap(v[1].y), snap(v[2].y)} {}
  std::int64_t area() const { return (x[2] - x[0]) * (y[1] - y[0]) - (x[1] - x[0]) * (y[2] - y[0]); }
};

/// True if the square of tile (column, row) lies wholly outside an edge.
bool misses(const Snapped& t, bool flipped, const TileGrid& grid, int column, int row) {
  const std::int64_t size = std::int64_t{kSubpixels} << grid.tile_log2;
  const std::int64_t left = column * size;
  const std::int64_t top = row * size;
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>((i + 1) % 3);
    const auto b = static_cast<std::size_t>((i + 2) % 3);
    std::int64_t dx = t.y[b] - t.y[a];
    std::int64_t dy = t.x[a] - t.x[b];
    if (flipped) {
      dx = -dx;
      dy = -dy;
    }
    const std::int64_t x = dx > 0 ? left + size : left;
    const std::int64_t y = dy > 0 ? top + size : top;
    if (dx * (x - t.x[a]) + dy * (y - t.y[a]) < 0) return true;
  }
  return false;
}

/// Around the segment a–b with the direction (x, y), which has the length of half the width; with direction (half, 0)
/// and a = b a square.
ClippedPolygon quad_of(const ScreenVertex& a, const ScreenVertex& b, float x, float y, float half) {
  const bool point = a.x == b.x && a.y == b.y;
  const float along_x = point ? half : 0;
  ClippedPolygon quad;
  const auto add = [&](ScreenVertex v, float dx, float dy) {
    v.x += dx;
    v.y += dy;
    quad.vertices[static_cast<std::size_t>(quad.count++)] = v;
  };
  add(a, -y - along_x, x);
  add(a, y - along_x, -x);
  add(b, y + along_x, -x);
  add(b, -y + along_x, x);
  return quad;
}

template <std::size_t N>
bool all_finite(const std::array<glm::vec4, N>& corners) {
  return std::all_of(corners.begin(), corners.end(), [](const glm::vec4& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w);
  });
}

}  // namespace

Binner::Binner(const RasterScene& scene, std::span<const ScreenVertex> vertices, std::span<const glm::vec4> clip,
               const BinSettings& settings)
    : scene_(scene), vertices_(vertices), clip_(clip), settings_(settings), counts_(settings.grid.tiles(), 0) {}

BinnedChunk Binner::bin(std::uint32_t first, std::uint32_t count) {
  chunk_ = {};
  tiles_.clear();
  references_.clear();
  std::fill(counts_.begin(), counts_.end(), 0);
  const std::uint32_t end = first + count;
  for (std::uint32_t i = scene_.instance_of(first); i < scene_.instances.size(); ++i) {
    const RasterInstance& instance = scene_.instances[i];
    if (instance.first_triangle >= end) break;
    instance_ = &instance;
    mesh_ = &scene_.meshes[instance.mesh];
    clip_from_object_ = settings_.clip_from_world * instance.world_from_object;
    const std::uint32_t begin = std::max(first, instance.first_triangle);
    const std::uint32_t stop = std::min(end, instance.first_triangle + mesh_->triangle_count);
    chunk_.statistics.faces_in += stop - begin;
    if (mesh_->kind != ShapeKind::Triangles) {
      for (std::uint32_t t = begin; t < stop; ++t) widen(t);
      continue;
    }
    for (std::uint32_t t = begin; t < stop;) {
      const auto block = std::min<std::uint32_t>(stop - t, kernels::CulledBlock::kTriangles);
      bin_block(t, block);
      t += block;
    }
  }
  return finish();
}

void Binner::bin_block(std::uint32_t first, std::uint32_t count) {
  const std::uint32_t local = first - instance_->first_triangle;
  kernels::cull_block(vertices_.data() + instance_->first_vertex, mesh_->vertices() + std::size_t{3} * local, count,
                      instance_->mirrored, instance_->all_single_sided, settings_.grid, block_);
  chunk_.statistics.faces_culled += block_.culled;
  chunk_.statistics.faces_empty += block_.empty;
  chunk_.statistics.faces_outside += block_.outside;
  const bool mixed = !instance_->all_single_sided && !instance_->all_double_sided;
  for (std::size_t i = 0; i < block_.count; ++i) {
    const std::uint32_t triangle = first + block_.triangle[i];
    const std::uint32_t from = block_.first_tile[i];
    if (from == kernels::CulledBlock::kByHand) {
      bin_by_hand(triangle);
      continue;
    }
    if (mixed && (from & kernels::CulledBlock::kBackFacing) != 0 && !double_sided(triangle)) {
      ++chunk_.statistics.faces_culled;
      continue;
    }
    ++chunk_.statistics.faces_drawn;
    const std::uint32_t to = block_.last_tile[i];
    const std::uint32_t columns = static_cast<std::uint32_t>(settings_.grid.columns);
    const std::uint32_t c0 = from & 0xFFF;
    const std::uint32_t r0 = (from >> 12) & 0xFFF;
    const std::uint32_t c1 = to & 0xFFF;
    const std::uint32_t r1 = to >> 12;
    for (std::uint32_t r = r0; r <= r1; ++r) {
      for (std::uint32_t c = c0; c <= c1; ++c) push(r * columns + c, triangle);
    }
  }
}

bool Binner::double_sided(std::uint32_t triangle) const {
  return scene_.materials[mesh_->material(triangle - instance_->first_triangle)].material.double_sided;
}

/// A triangle that is large, or must be clipped, or isn't finite.
void Binner::bin_by_hand(std::uint32_t triangle) {
  const std::uint32_t* const corners = mesh_->vertices() + std::size_t{3} * (triangle - instance_->first_triangle);
  std::array<ScreenVertex, 3> vertices;
  bool valid = true;
  for (std::size_t i = 0; i < 3; ++i) {
    vertices[i] = vertices_[instance_->first_vertex + corners[i]];
    valid = valid && !std::isnan(vertices[i].x);
  }
  if (valid) return count(bin_large(vertices, triangle, triangle));
  std::array<glm::vec4, 3> clip;
  for (std::size_t i = 0; i < 3; ++i) clip[i] = clip_of(corners[i]);
  const ClippedPolygon polygon = clip_triangle(clip, settings_.transform);
  if (polygon.count < 3) return count(all_finite(clip) ? Fate::Outside : Fate::Empty);
  ++chunk_.statistics.faces_clipped;
  count(bin_polygon(polygon, triangle));
}

void Binner::count(Fate fate) {
  switch (fate) {
    case Fate::Empty: ++chunk_.statistics.faces_empty; break;
    case Fate::Outside: ++chunk_.statistics.faces_outside; break;
    case Fate::Culled: ++chunk_.statistics.faces_culled; break;
    case Fate::Drawn: ++chunk_.statistics.faces_drawn; break;
  }
}

/// The pieces of a polygon as a fan.
Binner::Fate Binner::bin_polygon(const ClippedPolygon& polygon, std::uint32_t triangle) {
  Fate fate = Fate::Empty;
  for (std::size_t i = 2; i < static_cast<std::size_t>(polygon.count); ++i) {
    const ClippedTriangle piece{{polygon.vertices[0], polygon.vertices[i - 1], polygon.vertices[i]}, triangle};
    chunk_.clipped.push_back(piece);
    const auto number = static_cast<std::uint32_t>(chunk_.clipped.size() - 1);
    fate = std::max(fate, bin_large(piece.vertices, triangle, kClippedReference | number));
  }
  return fate;
}

Binner::Fate Binner::bin_large(const std::array<ScreenVertex, 3>& vertices, std::uint32_t triangle,
                               std::uint32_t reference) {
  const Snapped t(vertices);
  const std::int64_t area = t.area();
  if (area == 0) return Fate::Empty;
  const bool thin = mesh_->kind != ShapeKind::Triangles;
  if (!thin && (area > 0) == instance_->mirrored && !double_sided(triangle)) return Fate::Culled;
  const TileGrid& grid = settings_.grid;
  const auto [x_low, x_high] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [y_low, y_high] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const auto x0 = std::max<std::int64_t>((x_low + 255 - grid.sample_high) >> kSubpixelBits, grid.area.x);
  const auto y0 = std::max<std::int64_t>((y_low + 255 - grid.sample_high) >> kSubpixelBits, grid.area.y);
  const auto x1 = std::min<std::int64_t>((x_high - grid.sample_low) >> kSubpixelBits, grid.area.right() - 1);
  const auto y1 = std::min<std::int64_t>((y_high - grid.sample_low) >> kSubpixelBits, grid.area.bottom() - 1);
  if (x0 > x1 || y0 > y1) return Fate::Outside;
  for (auto row = static_cast<int>(y0 >> grid.tile_log2); row <= static_cast<int>(y1 >> grid.tile_log2); ++row) {
    for (auto column = static_cast<int>(x0 >> grid.tile_log2); column <= static_cast<int>(x1 >> grid.tile_log2);
         ++column) {
      if (!misses(t, area < 0, grid, column, row)) {
        push(static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(grid.columns) +
                 static_cast<std::uint32_t>(column),
             reference);
      }
    }
  }
  return Fate::Drawn;
}

glm::vec4 Binner::clip_of(std::uint32_t vertex) const {
  if (!clip_.empty()) return clip_[instance_->first_vertex + vertex];
  return to_clip(clip_from_object_, mesh_->mesh->positions[vertex]);
}

/// A line or a point becomes a quadrilateral of the width asked for.
void Binner::widen(std::uint32_t triangle) {
  const std::uint32_t* const corners = mesh_->vertices() + std::size_t{3} * (triangle - instance_->first_triangle);
  const std::array<glm::vec4, 2> ends = {clip_of(corners[0]), clip_of(corners[1])};
  if (!all_finite(ends)) return count(Fate::Empty);
  if (mesh_->kind == ShapeKind::Points) {
    const ScreenVertex at = to_screen(ends[0], settings_.transform);
    const float half = 0.5F * settings_.point_size;
    return count(std::isnan(at.x) ? Fate::Outside : bin_polygon(quad_of(at, at, half, 0, half), triangle));
  }
  const ClippedPolygon line = clip_segment(ends, settings_.transform);
  if (line.count < 2) return count(Fate::Outside);
  const float dx = line.vertices[1].x - line.vertices[0].x;
  const float dy = line.vertices[1].y - line.vertices[0].y;
  const float length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 0)) return count(Fate::Empty);
  const float half = 0.5F * settings_.line_width;
  count(
      bin_polygon(quad_of(line.vertices[0], line.vertices[1], half * dx / length, half * dy / length, half), triangle));
}

void Binner::push(std::uint32_t tile, std::uint32_t reference) {
  tiles_.push_back(tile);
  references_.push_back(reference);
  ++counts_[tile];
}

/// Counting sort by tile; what was pushed first stays first.
BinnedChunk Binner::finish() {
  if (tiles_.empty()) return std::move(chunk_);
  chunk_.first.resize(counts_.size() + 1);
  std::uint32_t sum = 0;
  for (std::size_t tile = 0; tile < counts_.size(); ++tile) {
    chunk_.first[tile] = sum;
    sum += std::exchange(counts_[tile], sum);
  }
  chunk_.first.back() = sum;
  chunk_.references.resize(sum);
  for (std::size_t i = 0; i < tiles_.size(); ++i) chunk_.references[counts_[tiles_[i]]++] = references_[i];
  return std::move(chunk_);
}

TileGrid tile_grid(int width, int height, const Rect& viewport, int samples) {
  TileGrid grid;
  grid.area = intersection({0, 0, width, height}, viewport);
  // One sample: depth and numbers of 64×64 pixels fill 32 KB. More samples: a quarter of the pixels.
  grid.tile_log2 = samples == 1 ? 6 : 5;
  const int size = 1 << grid.tile_log2;
  grid.columns = (width + size - 1) / size;
  grid.rows = (height + size - 1) / size;
  grid.sample_low = kSubpixels;
  for (const SamplePoint& sample : sample_pattern(samples)) {
    grid.sample_low = std::min({grid.sample_low, sample.x, sample.y});
    grid.sample_high = std::max({grid.sample_high, sample.x, sample.y});
  }
  return grid;
}

}  // namespace azulejo
