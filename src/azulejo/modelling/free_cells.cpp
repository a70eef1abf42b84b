#include "azulejo/modelling/free_cells.h"

#include <algorithm>
#include <cmath>

#include "azulejo/core/parallel.h"

namespace azulejo {

FreeCells::FreeCells(std::array<std::span<const SurfaceTriangle>, 2> triangles, std::size_t points,
                     const std::function<int(const glm::vec3&)>& number, const Run& run) {
  std::vector<Box3> boxes = boxes_of(triangles[0], run);
  const std::vector<Box3> more = boxes_of(triangles[1], run);
  boxes.insert(boxes.end(), more.begin(), more.end());
  for (const Box3& each : boxes) box_ = united(box_, each);
  if (boxes.empty()) return;
  choose_count(boxes, points);
  cells_.assign(std::size_t{count_} * count_ * count_, 0);
  for (const Box3& each : boxes) {
    const Cell low = cell(each.lower);
    const Cell high = cell(each.upper);
    for (std::uint32_t z = low[2]; z <= high[2]; ++z) {
      for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
        const auto row = cells_.begin() + static_cast<std::ptrdiff_t>(at({0, y, z}));
        std::fill(row + low[0], row + high[0] + 1, kBusy);
      }
    }
  }
  parallel_for(std::size_t{count_} * count_, 16, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) number_row(static_cast<std::uint32_t>(row), number);
  });
}

void FreeCells::set_count(std::uint32_t count) {
  count_ = count;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = double{box_.upper[axis]} - box_.lower[axis];
    per_unit_[axis] = size > 0 ? count / size : 0;
  }
}

/// So many cells that filling them costs no more than the boxes and points are worth.
void FreeCells::choose_count(std::span<const Box3> boxes, std::size_t points) {
  set_count(static_cast<std::uint32_t>(std::clamp(std::cbrt(static_cast<double>(points)), 1.0, 128.0)));
  for (; count_ > 1; set_count(count_ / 2)) {
    std::size_t rows = 0;
    for (const Box3& each : boxes) {
      const Cell low = cell(each.lower);
      const Cell high = cell(each.upper);
      rows += std::size_t{high[2] - low[2] + 1} * (high[1] - low[1] + 1) * (1 + (high[0] - low[0]) / 8);
    }
    if (rows <= 4 * boxes.size() + 2 * points) return;
  }
}

/// Cells in a row with none between them that is busy have one number.
void FreeCells::number_row(std::uint32_t row, const std::function<int(const glm::vec3&)>& number) {
  std::optional<int> known;
  for (std::uint32_t x = 0; x < count_; ++x) {
    const Cell here{x, row % count_, row / count_};
    std::int32_t& each = cells_[at(here)];
    if (each == kBusy) {
      known.reset();
      continue;
    }
    if (!known) {
      glm::vec3 middle;
      for (int axis = 0; axis < 3; ++axis) {
        const double place = here[static_cast<std::size_t>(axis)] + 0.5;
        middle[axis] = static_cast<float>(box_.lower[axis] + (per_unit_[axis] > 0 ? place / per_unit_[axis] : 0.0));
      }
      if (cell(middle) != here) {  // narrower than a step of floats
        each = kBusy;
        continue;
      }
      known = number(middle);
    }
    each = *known;
  }
}

}  // namespace azulejo
