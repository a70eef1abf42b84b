#include "azulejo/modelling/surface.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/bspline.h"
#include "azulejo/modelling/closed.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/scene_testing.h"

namespace azulejo {
namespace {

using Kind = SurfaceKind;

/// A profile from axis to axis.
SurfaceOptions turned(float tolerance) {
  const float w = std::sqrt(0.5F);
  return {.kind = Kind::Revolution,
          .points = {0, 1, 1, 1, 1, 0, 1, -1, 0, -1},
          .weights = {1, w, 1, w, 1},
          .degree_v = 2,
          .tolerance = tolerance};
}

/// Half a circle of five points, from the top down.
NurbsSurface exact_sphere() {
  const double w = std::sqrt(0.5);
  return revolved({{0, 1, 1}, {w, w, w}, {1, 0, 1}, {w, -w, w}, {0, -1, 1}}, {0, 0, 0, 0.5, 0.5, 1, 1, 1}, 2);
}

TEST(Surface, ASphereIsClosedAndWithinTheTolerance) {
  std::size_t before = 0;
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const Mesh mesh = tessellate_surface(exact_sphere(), tolerance);
    mesh.check("sphere");
    EXPECT_TRUE(is_closed(mesh));
    double worst = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      glm::dvec3 middle(0);
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
        middle += glm::dvec3(mesh.positions[mesh.corners[c]]);
      }
      middle /= static_cast<double>(mesh.face_end(f) - mesh.face_begin(f));
      worst = std::max(worst, 1 - glm::length(middle));
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GT(worst, 0.01 * tolerance);
    EXPECT_GT(mesh.face_count(), before);
    before = mesh.face_count();
    const Attribute& normal = *mesh.find("NORMAL");
    for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
      const std::size_t e = normal.domain == Domain::Vertex ? mesh.corners[c] : c;
      EXPECT_LT(glm::distance(testing::vector_at(normal, e), mesh.positions[mesh.corners[c]]), 1e-3F);
    }
  }
}

TEST(Surface, EveryKindHasUnitNormalsAcrossItsFaces) {
  for (const SurfaceOptions& options :
       {SurfaceOptions{.tolerance = 0.001F}, SurfaceOptions{.kind = Kind::BSpline, .degree_v = 2, .tolerance = 0.001F},
        turned(0.001F)}) {
    const Mesh mesh = surface(options);
    mesh.check("surface");
    const Attribute& normal = *mesh.find("NORMAL");
    const Array<glm::vec3> faces = face_normals(mesh);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
        const std::size_t e = normal.domain == Domain::Vertex ? mesh.corners[c] : c;
        EXPECT_NEAR(glm::length(testing::vector_at(normal, e)), 1, 1e-5F);
        EXPECT_GT(glm::dot(testing::vector_at(normal, e), faces[f]), 0.95F);
      }
    }
    for (const float each : *mesh.find("TEXCOORD_0")->get<float>()) EXPECT_TRUE(each >= 0 && each <= 1);
  }
}

TEST(Surface, AFlatPatchIsOneFace) {
  const Mesh mesh = surface({.points = {0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1}, .columns = 2});
  EXPECT_EQ(mesh.face_count(), 1U);
  EXPECT_EQ(mesh.vertex_count(), 4U);
  EXPECT_EQ(testing::vector_at(*mesh.find("NORMAL"), 0), glm::vec3(0, 1, 0));
}

TEST(Surface, RefusesWhatDoesNotFit) {
  EXPECT_THROW(surface({.columns = 5}), Error);
  EXPECT_THROW(surface({.points = {0, 0, 0, 1}}), Error);
  EXPECT_THROW(surface({.points = {0, 0, 0, 1, 0, 0}, .columns = 2}), Error);
  EXPECT_THROW(surface({.weights = {1}}), Error);
  EXPECT_THROW(surface({.kind = Kind::BSpline, .degree_u = 4}), Error);
  EXPECT_THROW(surface({.kind = Kind::Revolution, .points = {0, 1, 1}}), Error);
  EXPECT_THROW(surface({.kind = Kind::Revolution, .points = {0, 1, 1, 1}}), Error);
  EXPECT_THROW(
      surface({.points = {-1e6F, 0, 0, 1e6F, 1e6F, 0, 0, 0, 1e6F, 1, 0, -1e6F}, .columns = 2, .tolerance = 1e-6F}),
      Error);
  azulejo::Run run;
  run.limits.memory_bytes = 10000;
  EXPECT_THROW(surface({}, run), Error);
}

}  // namespace
}  // namespace azulejo
