#include <GL/glu.h>

#include <cmath>
#include <cstdio>
#include <deque>
#include <numbers>
#include <random>
#include <string>

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include "azulejo/modelling/classify_points.h"
#include "azulejo/modelling/polygon.h"
#include "harness.h"

namespace azulejo::bench {
namespace {

using Ring = std::vector<glm::vec2>;

Ring circle_of(std::size_t count, const std::function<double(std::size_t)>& radius, glm::dvec2 center = {0, 0}) {
  Ring ring;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = radius(i);
    ring.emplace_back(center.x + r * std::cos(angle), center.y + r * std::sin(angle));
  }
  return ring;
}

/// Every second point is far out, by chance.
Polygon star(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> radius(0.1, 1);
  Polygon polygon;
  polygon.add_ring(circle_of(count, [&](std::size_t) { return radius(random); }));
  return polygon;
}

/// A band that goes around 50 times.
Polygon spiral(std::size_t count) {
  Ring ring;
  for (const double width : {0.0, 0.5}) {
    for (std::size_t i = 0; i < count / 2; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(count / 2 - 1);
      const double turns = 50 * (width > 0 ? 1 - share : share);
      const double r = 1 + turns + width;
      ring.emplace_back(r * std::cos(2 * std::numbers::pi * turns), r * std::sin(2 * std::numbers::pi * turns));
    }
  }
  Polygon polygon;
  polygon.add_ring(ring);
  return polygon;
}

/// Islands of 1000 points, with ragged coasts and a lake each.
Polygon map(std::size_t count) {
  std::mt19937 random(2);
  std::normal_distribution<double> step(0, 1);
  Polygon polygon;
  const std::size_t islands = count / 1000;
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(islands))));
  for (std::size_t i = 0; i < islands; ++i) {
    const glm::dvec2 center(10.0 * static_cast<double>(i % side), 10.0 * static_cast<double>(i / side));
    double coast = 0;
    const auto ragged = [&](double size) {
      return [&, size](std::size_t) {
        coast = 0.95 * coast + 0.02 * step(random);
        return size * (1 + std::tanh(coast) / 2);
      };
    };
    polygon.add_ring(circle_of(800, ragged(3), center));
    Ring lake = circle_of(200, ragged(0.8), center);
    std::reverse(lake.begin(), lake.end());
    polygon.add_ring(lake);
  }
  return polygon;
}

/// A random walk, which crosses itself.
Polygon tangle(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> step(-1, 1);
  Ring ring;
  glm::vec2 at(0);
  for (std::size_t i = 0; i < count; ++i) {
    ring.push_back(at);
    at += glm::vec2(step(random), step(random));
  }
  Polygon polygon;
  polygon.add_ring(ring);
  return polygon;
}

/// The GLU tessellator (of SGI, which libtess2 and others are made of).
class Glu {
 public:
  double area = 0;
  std::vector<const double*> corners;

  void tessellate(const Polygon& polygon) {
    corners.clear();
    made_.clear();
    points_.resize(3 * polygon.points.size());
    for (std::size_t i = 0; i < polygon.points.size(); ++i) {
      points_[3 * i] = polygon.points[i].x;
      points_[3 * i + 1] = polygon.points[i].y;
      points_[3 * i + 2] = 0;
    }
    GLUtesselator* tess = gluNewTess();
    using Function = void (*)();
    gluTessCallback(tess, GLU_TESS_VERTEX_DATA, reinterpret_cast<Function>(&vertex));
    gluTessCallback(tess, GLU_TESS_COMBINE_DATA, reinterpret_cast<Function>(&combine));
    gluTessCallback(tess, GLU_TESS_EDGE_FLAG, reinterpret_cast<Function>(&edge_flag));  // triangles, no fans
    gluTessProperty(tess, GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_NONZERO);
    gluTessNormal(tess, 0, 0, 1);
    gluTessBeginPolygon(tess, this);
    for (std::size_t r = 0; r < polygon.ring_count(); ++r) {
      gluTessBeginContour(tess);
      const std::size_t first = polygon.ring_begins[r];
      for (std::size_t i = 0; i < polygon.ring(r).size(); ++i) {
        double* point = &points_[3 * (first + i)];
        gluTessVertex(tess, point, point);
      }
      gluTessEndContour(tess);
    }
    gluTessEndPolygon(tess);
    gluDeleteTess(tess);
    area = 0;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      const double* a = corners[i];
      const double* b = corners[i + 1];
      const double* c = corners[i + 2];
      area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
  }

 private:
  static void vertex(void* point, void* self) {
    static_cast<Glu*>(self)->corners.push_back(static_cast<const double*>(point));
  }
  static void combine(double place[3], void**, float*, void** result, void* self) {
    auto& made = static_cast<Glu*>(self)->made_;
    made.push_back({place[0], place[1], place[2]});
    *result = made.back().data();
  }
  static void edge_flag(GLboolean) {}

  std::vector<double> points_;
  std::deque<std::array<double, 3>> made_;
};

double area_of(const TriangulatedPolygon& triangles) {
  double area = 0;
  for (std::size_t i = 0; i < triangles.corners.size(); i += 3) {
    const glm::dvec2 a = triangles.points[triangles.corners[i]];
    const glm::dvec2 b = triangles.points[triangles.corners[i + 1]];
    const glm::dvec2 c = triangles.points[triangles.corners[i + 2]];
    area += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  return area;
}

Row tessellation(Polygon made, double aim_seconds, bool with_peer = true) {
  const auto polygon = std::make_shared<Polygon>(std::move(made));
  const auto ours = std::make_shared<TriangulatedPolygon>();
  const auto peer = std::make_shared<Glu>();
  Row row;
  row.work = static_cast<double>(polygon->points.size());
  row.unit = "Mpoint/s";
  row.threads = {1};
  row.aim_seconds = aim_seconds;
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *ours = tessellate(*polygon, FillRule::NonZero, run);
  };
  row.peer_name = "GLU";
  if (with_peer) row.peer = [=](int) { peer->tessellate(*polygon); };
  row.check = [=] {
    const double area = area_of(*ours);
    const double apart = std::abs(area - (with_peer ? peer->area : signed_area(*polygon))) / area;
    return Check{apart < 1e-5, fmt::format("areas {:.1e} apart", apart)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  for (const std::size_t count : {10000U, 100000U, 1000000U}) {
    const double aim = count == 1000000 ? 1 : 0;
    const std::string size = fmt::format("{} points", count);
    bench.row("tessellate spiral, " + size, [=] { return tessellation(spiral(count), aim); });
    // GLU takes the square of the number of points for these.
    bench.row("tessellate star, " + size, [=] { return tessellation(star(count), aim, count < 100000); });
    bench.row("tessellate map, " + size, [=] { return tessellation(map(count), aim, count <= 100000); });
  }
  bench.row("tessellate tangle, 30000 points", [] { return tessellation(tangle(30000), 0); });
  bench.row("classify 20000 points, polygon of 10000 edges", [] {
    const auto polygon = std::make_shared<Polygon>(star(10000));
    const auto points = std::make_shared<std::vector<glm::vec2>>();
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-1, 1);
    for (int i = 0; i < 20000; ++i) points->emplace_back(place(random), place(random));
    const auto ours = std::make_shared<std::vector<PointClass>>(points->size());
    const auto peer = std::make_shared<std::vector<PointClass>>(points->size());
    Row row;
    row.work = static_cast<double>(points->size());
    row.unit = "Mpoint/s";
    row.ours = [=](int threads) {
      Run run;
      run.threads = threads;
      PointClassifier(*polygon, FillRule::EvenOdd).classify(*points, *ours, run);
    };
    row.peer = [=](int) {
      std::vector<cv::Point2f> outline;
      for (const glm::vec2& p : polygon->points) outline.emplace_back(p.x, p.y);
      for (std::size_t i = 0; i < points->size(); ++i) {
        const double side = cv::pointPolygonTest(outline, {(*points)[i].x, (*points)[i].y}, false);
        (*peer)[i] = side > 0 ? PointClass::Inside : side < 0 ? PointClass::Outside : PointClass::Border;
      }
    };
    row.peer_name = "OpenCV";
    row.check = [=] {
      std::size_t apart = 0;
      for (std::size_t i = 0; i < points->size(); ++i) apart += (*ours)[i] != (*peer)[i];
      return Check{apart == 0, fmt::format("{} differ", apart)};
    };
    return row;
  });
});

}  // namespace
}  // namespace azulejo::bench
