#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <random>
#include <utility>
#include <vector>

#include "azulejo/modelling/flat_path.h"
#include "azulejo/rendering/coverage_band.h"

namespace azulejo {

using Contours = std::vector<std::vector<glm::vec2>>;

inline FlatPath flat_path(const Contours& contours) {
  FlatPath path;
  for (const std::vector<glm::vec2>& contour : contours) {
    path.begin();
    path.points.insert(path.points.end(), contour.begin(), contour.end());
  }
  return path;
}

inline Array<OutlineEdge> edges_of(const Contours& contours, int width, int height) {
  Array<OutlineEdge> edges;
  EdgeGatherer gatherer(width, height, edges);
  for (const std::vector<glm::vec2>& contour : contours) gatherer.add_contour(contour);
  return edges;
}

/// A picture's coverage, in bands of `rows`.
inline std::vector<float> coverage_of(const Contours& contours, int width, int height, FillRule rule,
                                      Antialias antialias = Antialias::Area, int rows = 4) {
  const Array<OutlineEdge> edges = edges_of(contours, width, height);
  CoverageBand band(width, rows);
  std::vector<float> result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  for (int top = 0; top < height; top += rows) {
    band.move_to(top, std::min(rows, height - top));
    band.add(edges, antialias);
    if (band.wants_gathering()) band.gather(edges);
    for (int y = band.first_row(); y <= band.last_row(); ++y) {
      for (const CoverageRun& run : band.row(y, rule)) {
        for (int x = run.first * kBlock; x < std::min(run.last * kBlock, width); ++x) {
          result[static_cast<std::size_t>((top + y) * width + x)] = run.mixed ? band.coverage()[x] : run.value;
        }
      }
    }
    band.finish();
  }
  return result;
}

/// Brute force in double precision: `lines` lines a pixel, along each the exact part that is inside.
inline std::vector<double> sampled_coverage(const Contours& contours, int width, int height, FillRule rule, int lines) {
  std::vector<double> result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0);
  std::vector<std::pair<double, int>> crossings;
  for (int line = 0; line < height * lines; ++line) {
    const double y = (line + 0.5) / lines;
    crossings.clear();
    for (const std::vector<glm::vec2>& contour : contours) {
      for (std::size_t i = 0; i < contour.size(); ++i) {
        const glm::dvec2 a = contour[i];
        const glm::dvec2 b = contour[(i + 1) % contour.size()];
        if ((a.y <= y) == (b.y <= y)) continue;
        crossings.emplace_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), b.y > a.y ? 1 : -1);
      }
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
      winding += crossings[i].second;
      if (rule == FillRule::NonZero ? winding == 0 : winding % 2 == 0) continue;
      const double from = std::clamp(crossings[i].first, 0.0, static_cast<double>(width));
      const double to = std::clamp(crossings[i + 1].first, 0.0, static_cast<double>(width));
      for (int x = static_cast<int>(from); x < width && x < to; ++x) {
        const double part = std::min(to, x + 1.0) - std::max(from, static_cast<double>(x));
        result[static_cast<std::size_t>(line / lines * width + x)] += std::max(part, 0.0) / lines;
      }
    }
  }
  return result;
}

}  // namespace azulejo
