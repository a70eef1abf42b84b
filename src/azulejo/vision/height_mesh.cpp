#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/vision/height_grid.h"

namespace azulejo {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

/// The cell between four samples, its corners counter-clockwise seen from above: back left, front left, front right,
/// back right.
struct Cell {
  std::array<std::array<std::size_t, 2>, 4> corner;  ///< x and y
  std::array<bool, 4> there;
  int count = 0;

  Cell(const HeightGrid& grid, std::size_t x, std::size_t y)
      : corner{{{x, y}, {x, y + 1}, {x + 1, y + 1}, {x + 1, y}}} {
    for (std::size_t k = 0; k < 4; ++k) {
      there[k] = grid.is_there(corner[k][0], corner[k][1]);
      count += there[k] ? 1 : 0;
    }
  }
  std::size_t triangles() const { return count == 4 ? 2 : count == 3 ? 1 : 0; }
  std::size_t missing() const {  ///< of three corners
    return static_cast<std::size_t>(std::find(there.begin(), there.end(), false) - there.begin());
  }
};

/// Calls take(corners a, b, c) of a cell's triangles, as indices of its corners.
template <class Take>
void for_each_triangle(const HeightGrid& grid, const Cell& cell, Take take) {
  const auto height = [&](std::size_t k) { return grid.at(cell.corner[k][0], cell.corner[k][1]); };
  if (cell.count == 3) {
    const std::size_t gone = cell.missing();
    take((gone + 1) % 4, (gone + 2) % 4, (gone + 3) % 4);
  } else if (cell.count == 4) {
    const bool other = std::abs(height(1) - height(3)) < std::abs(height(0) - height(2));
    const std::size_t from = other ? 1 : 0;
    take(from, from + 1, from + 2);
    take(from, from + 2, (from + 3) % 4);
  }
}

/// What the rows before each row made: its first vertex, cell triangle and wall; the last entry is all.
struct Counts {
  std::vector<std::size_t> vertices, triangles, walls;
};

class HeightMesh {
 public:
  HeightMesh(const HeightGrid& grid, const HeightFieldOptions& options, const Run& run)
      : grid_(grid), options_(options), run_(run) {
    const auto longest = static_cast<float>(std::max<std::size_t>(std::max(grid.columns, grid.rows), 2) - 1);
    spacing_ = options.spacing.value_or(2 / longest);
    check_base();
    count();
  }

  Mesh make() {
    const std::size_t tops = counts_.vertices.back();
    const std::size_t sides = counts_.walls.back();
    const std::size_t surfaces = options_.base ? 2 : 1;
    const std::size_t vertices = tops * surfaces + 4 * sides;
    if (vertices > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(Error::Resource, fmt::format("height_field: {} vertices, expected at most 2³² − 1", vertices));
    }
    mesh_.positions.resize(vertices);
    normals_.resize(3 * vertices);
    uvs_.resize(2 * vertices);
    mesh_.corners.resize(3 * (counts_.triangles.back() * surfaces + 2 * sides));
    parallel_for(grid_.rows, kRowsAtOnce, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) fill_vertices(y);
    });
    parallel_for(cell_rows(), kRowsAtOnce, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) fill_faces(y);
    });
    mesh_.attributes.push_back({"NORMAL", Domain::Vertex, 3, std::move(normals_)});
    mesh_.attributes.push_back({"TEXCOORD_0", Domain::Vertex, 2, std::move(uvs_)});
    mesh_.name = "height_field";
    return std::move(mesh_);
  }

 private:
  std::size_t cell_rows() const { return grid_.columns < 2 || grid_.rows < 2 ? 0 : grid_.rows - 1; }
  std::size_t cell_columns() const { return grid_.columns - 1; }

  void check_base() const {
    if (!options_.base) return;
    const float lowest = parallel_reduce(
        grid_.heights.size(), std::size_t{1} << 16, run_, std::numeric_limits<float>::infinity(),
        [&](std::size_t begin, std::size_t end) {
          float least = std::numeric_limits<float>::infinity();
          for (std::size_t i = begin; i < end; ++i) {
            if (std::isfinite(grid_.heights[i])) least = std::min(least, grid_.heights[i]);
          }
          return least;
        },
        [](float a, float b) { return std::min(a, b); });
    if (!(*options_.base < lowest)) {
      throw Error(Error::Argument,
                  fmt::format("base is {}, expected less than the lowest height, {}", *options_.base, lowest));
    }
  }

  /// Whether the cell at the other side of a cell's side has a face there; side k is from corner k to k + 1.
  bool has_neighbor(std::size_t x, std::size_t y, std::size_t side) const {
    switch (side) {
      case 0: return x > 0 && Cell(grid_, x - 1, y).count >= 3;
      case 1: return y + 1 < cell_rows() && Cell(grid_, x, y + 1).count >= 3;
      case 2: return x + 1 < cell_columns() && Cell(grid_, x + 1, y).count >= 3;
      default: return y > 0 && Cell(grid_, x, y - 1).count >= 3;
    }
  }

  /// Calls take(cell's corner a, corner b) for each edge of its faces where no other face is, in the face's direction.
  template <class Take>
  void for_each_border(const Cell& cell, std::size_t x, std::size_t y, Take take) const {
    if (cell.count < 3) return;
    for (std::size_t side = 0; side < 4; ++side) {
      const std::size_t next = (side + 1) % 4;
      if (cell.there[side] && cell.there[next] && !has_neighbor(x, y, side)) take(side, next);
    }
    if (cell.count == 3) take((cell.missing() + 3) % 4, (cell.missing() + 1) % 4);
  }

  void count() {
    counts_.vertices.assign(grid_.rows + 1, 0);
    counts_.triangles.assign(cell_rows() + 1, 0);
    counts_.walls.assign(cell_rows() + 1, 0);
    parallel_for(grid_.rows, kRowsAtOnce, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        const float* const row = grid_.heights.data() + y * grid_.columns;
        counts_.vertices[y + 1] = static_cast<std::size_t>(
            std::count_if(row, row + grid_.columns, [](float height) { return std::isfinite(height); }));
      }
    });
    for (std::size_t y = 0; y < grid_.rows; ++y) counts_.vertices[y + 1] += counts_.vertices[y];
    holes_ = counts_.vertices.back() < grid_.columns * grid_.rows;
    parallel_for(cell_rows(), kRowsAtOnce, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) count_faces(y);
    });
    for (std::size_t y = 0; y < cell_rows(); ++y) {
      counts_.triangles[y + 1] += counts_.triangles[y];
      counts_.walls[y + 1] += counts_.walls[y];
    }
    if (holes_) number_vertices();
  }

  void count_faces(std::size_t y) {
    if (!holes_ && !options_.base) {
      counts_.triangles[y + 1] = 2 * cell_columns();
      return;
    }
    for (std::size_t x = 0; x < cell_columns(); ++x) {
      const Cell cell(grid_, x, y);
      counts_.triangles[y + 1] += cell.triangles();
      if (options_.base) for_each_border(cell, x, y, [&](std::size_t, std::size_t) { ++counts_.walls[y + 1]; });
    }
  }

  void number_vertices() {
    numbers_.resize(grid_.columns * grid_.rows);
    parallel_for(grid_.rows, kRowsAtOnce, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        auto next = static_cast<std::uint32_t>(counts_.vertices[y]);
        for (std::size_t x = 0; x < grid_.columns; ++x) {
          numbers_[y * grid_.columns + x] = next;
          next += grid_.is_there(x, y) ? 1 : 0;
        }
      }
    });
  }

  std::uint32_t vertex(const std::array<std::size_t, 2>& at) const {
    const std::size_t index = at[1] * grid_.columns + at[0];
    return holes_ ? numbers_[index] : static_cast<std::uint32_t>(index);
  }

  glm::vec3 place(std::size_t x, std::size_t y, float height) const {
    const auto from_middle = [](std::size_t at, std::size_t count) {
      return static_cast<float>(at) - 0.5F * static_cast<float>(count - 1);
    };
    return {spacing_ * from_middle(x, grid_.columns), height, spacing_ * from_middle(y, grid_.rows)};
  }

  glm::vec2 texture_place(std::size_t x, std::size_t y) const {
    return {(static_cast<float>(x) + 0.5F) / static_cast<float>(grid_.columns),
            (static_cast<float>(y) + 0.5F) / static_cast<float>(grid_.rows)};
  }

  /// How much the height grows to the next sample.
  float slope(std::size_t x, std::size_t y, bool down) const {
    const std::size_t at = down ? y : x;
    const std::size_t count = down ? grid_.rows : grid_.columns;
    const auto height = [&](std::size_t i) { return down ? grid_.at(x, i) : grid_.at(i, y); };
    const float here = height(at);
    const bool before = at > 0 && std::isfinite(height(at - 1));
    const bool behind = at + 1 < count && std::isfinite(height(at + 1));
    if (before && behind) return 0.5F * (height(at + 1) - height(at - 1));
    return before ? here - height(at - 1) : behind ? height(at + 1) - here : 0.0F;
  }

  void put(std::size_t index, const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv) {
    mesh_.positions[index] = position;
    for (int k = 0; k < 3; ++k) normals_[3 * index + static_cast<std::size_t>(k)] = normal[k];
    uvs_[2 * index] = uv.x;
    uvs_[2 * index + 1] = uv.y;
  }

  void fill_vertices(std::size_t y) {
    std::size_t next = counts_.vertices[y];
    const std::size_t below = counts_.vertices.back();
    for (std::size_t x = 0; x < grid_.columns; ++x) {
      if (holes_ && !grid_.is_there(x, y)) continue;
      const glm::vec3 steep(-slope(x, y, false), spacing_, -slope(x, y, true));
      const glm::vec3 normal = steep / std::sqrt(glm::dot(steep, steep));
      put(next, place(x, y, grid_.at(x, y)), normal, texture_place(x, y));
      if (options_.base) put(below + next, place(x, y, *options_.base), {0, -1, 0}, texture_place(x, y));
      ++next;
    }
  }

  void fill_faces(std::size_t y) {
    std::size_t next = 3 * counts_.triangles[y];
    std::size_t wall = counts_.walls[y];
    const std::size_t all = counts_.triangles.back();
    const auto tops = static_cast<std::uint32_t>(counts_.vertices.back());
    for (std::size_t x = 0; x < cell_columns(); ++x) {
      const Cell cell(grid_, x, y);
      for_each_triangle(grid_, cell, [&](std::size_t a, std::size_t b, std::size_t c) {
        const std::array<std::uint32_t, 3> corner{vertex(cell.corner[a]), vertex(cell.corner[b]),
                                                  vertex(cell.corner[c])};
        for (std::size_t k = 0; k < 3; ++k) {
          mesh_.corners[next + k] = corner[k];
          if (options_.base) mesh_.corners[3 * all + next + k] = tops + corner[2 - k];
        }
        next += 3;
      });
      if (!options_.base) continue;
      for_each_border(cell, x, y,
                      [&](std::size_t a, std::size_t b) { fill_wall(wall++, cell.corner[a], cell.corner[b]); });
    }
  }

  /// Below an edge of the surface, which has its faces on the left.
  void fill_wall(std::size_t wall, const std::array<std::size_t, 2>& from, const std::array<std::size_t, 2>& to) {
    const std::size_t first = 2 * counts_.vertices.back() + 4 * wall;
    const glm::vec3 along = place(to[0], to[1], 0) - place(from[0], from[1], 0);
    const glm::vec3 normal = glm::normalize(glm::vec3(-along.z, 0, along.x));
    const auto post = [&](const std::array<std::size_t, 2>& at, std::size_t index) {
      put(index, place(at[0], at[1], grid_.at(at[0], at[1])), normal, texture_place(at[0], at[1]));
      put(index + 1, place(at[0], at[1], *options_.base), normal, texture_place(at[0], at[1]));
    };
    post(from, first);
    post(to, first + 2);
    const auto v = static_cast<std::uint32_t>(first);
    const std::array<std::uint32_t, 6> corners{v, v + 1, v + 3, v, v + 3, v + 2};
    std::copy(corners.begin(), corners.end(),
              mesh_.corners.begin() + static_cast<std::ptrdiff_t>(6 * counts_.triangles.back() + 6 * wall));
  }

  const HeightGrid& grid_;
  const HeightFieldOptions& options_;
  const Run& run_;
  float spacing_ = 1;
  bool holes_ = false;
  Counts counts_;
  Array<std::uint32_t> numbers_;  ///< of the vertices of samples, where there are holes
  Mesh mesh_;
  Array<float> normals_;
  Array<float> uvs_;
};

}  // namespace

Mesh height_mesh(const HeightGrid& grid, const HeightFieldOptions& options, const Run& run) {
  return HeightMesh(grid, options, run).make();
}

}  // namespace azulejo
