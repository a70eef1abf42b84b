#include "azulejo/charting/label_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace azulejo {
namespace {

constexpr int kMostCells = 256;         ///< along a side of the page
constexpr std::size_t kMostBoxes = 32;  ///< of a cell: it is crowded, more make no difference
constexpr int kRings = 6;               ///< of places with leaders

float overlap(const Box2& a, const Box2& b) {
  const float x = std::min(a.upper.x, b.upper.x) - std::max(a.lower.x, b.lower.x);
  const float y = std::min(a.upper.y, b.upper.y) - std::max(a.lower.y, b.lower.y);
  return x > 0 && y > 0 ? x * y : 0;
}

bool inside(const Box2& box, const Box2& page) {
  return box.lower.x >= page.lower.x && box.lower.y >= page.lower.y && box.upper.x <= page.upper.x &&
         box.upper.y <= page.upper.y;
}

Box2 around(const glm::vec2& point, float reach) { return {point - reach, point + reach}; }

/// Boxes by the cells of the page that they touch.
class Taken {
 public:
  explicit Taken(const Box2& page) : page_(page) {
    const glm::vec2 size = page.upper - page.lower;
    const float cell = std::max({size.x / kMostCells, size.y / kMostCells, 8.0F});
    columns_ = std::clamp(static_cast<int>(size.x / cell) + 1, 1, kMostCells + 1);
    rows_ = std::clamp(static_cast<int>(size.y / cell) + 1, 1, kMostCells + 1);
    scale_ = 1 / cell;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  void add(const Box2& box) {
    for_cells(box, [&](std::vector<Box2>& cell) {
      if (cell.size() < kMostBoxes) cell.push_back(box);
    });
  }

  /// Area that is taken already; what lies in several cells counts several times.
  float in(const Box2& box) {
    float sum = 0;
    for_cells(box, [&](const std::vector<Box2>& cell) {
      for (const Box2& each : cell) sum += overlap(each, box);
    });
    return sum;
  }

 private:
  template <class F>
  void for_cells(const Box2& box, F f) {
    const auto index = [&](float x, int count) {
      return static_cast<int>(std::clamp(x * scale_, 0.0F, static_cast<float>(count - 1)));
    };
    const int x1 = index(box.upper.x - page_.lower.x, columns_);
    const int y1 = index(box.upper.y - page_.lower.y, rows_);
    for (int y = index(box.lower.y - page_.lower.y, rows_); y <= y1; ++y) {
      for (int x = index(box.lower.x - page_.lower.x, columns_); x <= x1; ++x) {
        f(cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)]);
      }
    }
  }

  Box2 page_;
  int columns_ = 1;
  int rows_ = 1;
  float scale_ = 1;
  std::vector<std::vector<Box2>> cells_;
};

/// Beside a point in a direction, its rim `distance` away.
Box2 beside(const WantedLabel& label, const glm::vec2& direction, float distance) {
  const glm::vec2 half = 0.5F * label.size;
  const glm::vec2 center = label.point + direction * (half + distance);
  return {center - half, center + half};
}

constexpr float kSlant = 0.7F;
constexpr std::array<glm::vec2, 8> kNear{glm::vec2(1, 0),        glm::vec2(-1, 0),      glm::vec2(0, -1),
                                         glm::vec2(0, 1),        glm::vec2(kSlant, -1), glm::vec2(kSlant, 1),
                                         glm::vec2(-kSlant, -1), glm::vec2(-kSlant, 1)};

bool usable(const WantedLabel& label) {
  constexpr float kFarthest = 1e7F;
  const auto fine = [](float x) { return std::abs(x) <= kFarthest; };
  return fine(label.point.x) && fine(label.point.y) && label.size.x > 0 && label.size.y > 0 && fine(label.size.x) &&
         fine(label.size.y);
}

std::optional<PlacedLabel> free_place(const WantedLabel& label, const Box2& page, float clearance, Taken& taken) {
  const Box2 centered{label.point - 0.5F * label.size, label.point + 0.5F * label.size};
  if (inside(centered, label.room) && inside(centered, page) && taken.in(centered) == 0) {
    return PlacedLabel{centered, false};
  }
  for (const glm::vec2& direction : kNear) {
    const Box2 box = beside(label, direction, clearance);
    if (inside(box, page) && taken.in(box) == 0) return PlacedLabel{box, false};
  }
  for (int ring = 1; ring <= kRings; ++ring) {
    const float distance = clearance + 1.2F * static_cast<float>(ring) * label.size.y;
    for (const glm::vec2& direction : kNear) {
      const Box2 box = beside(label, direction, distance);
      if (inside(box, page) && taken.in(box) == 0) return PlacedLabel{box, true};
    }
  }
  return std::nullopt;
}

/// Where it hides least; places that leave the page come last.
PlacedLabel least_bad_place(const WantedLabel& label, const Box2& page, float clearance, Taken& taken) {
  PlacedLabel best{beside(label, kNear[0], clearance), false};
  float least = inside(best.box, page) ? taken.in(best.box) : 1e30F;
  for (const glm::vec2& direction : kNear) {
    const Box2 box = beside(label, direction, clearance);
    if (!inside(box, page)) continue;
    const float hidden = taken.in(box);
    if (hidden < least) {
      least = hidden;
      best.box = box;
    }
  }
  return best;
}

}  // namespace

std::vector<PlacedLabel> place_labels(std::span<const WantedLabel> labels, const Box2& page, float clearance,
                                      std::span<const Box2> reserved) {
  std::vector<PlacedLabel> result(labels.size());
  if (page.empty()) return result;
  Taken taken(page);
  for (const Box2& box : reserved) taken.add(box);
  for (const WantedLabel& label : labels) {
    if (usable(label) && label.room.empty()) taken.add(around(label.point, 0.9F * clearance));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!usable(labels[i])) continue;
    const std::optional<PlacedLabel> found = free_place(labels[i], page, clearance, taken);
    result[i] = found ? *found : least_bad_place(labels[i], page, clearance, taken);
    taken.add(result[i].box);
  }
  return result;
}

glm::vec2 leader_end(const Box2& box, const glm::vec2& point) {
  return {std::clamp(point.x, box.lower.x, box.upper.x), std::clamp(point.y, box.lower.y, box.upper.y)};
}

}  // namespace azulejo
