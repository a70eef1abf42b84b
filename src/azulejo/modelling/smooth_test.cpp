#include "azulejo/modelling/smooth.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "azulejo/core/error.h"
#include "azulejo/modelling/subdivision_testing.h"

namespace azulejo {
namespace {

using namespace testing;

constexpr double kPi = std::numbers::pi;

/// A grid that closes in both directions, each vertex with six neighbors: its waves are what smoothing multiplies.
Mesh torus_grid(int n) {
  Mesh mesh;
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>((y + n) % n * n + (x + n) % n); };
  mesh.positions.assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), glm::vec3(0));
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      for (const std::uint32_t v : {at(x, y), at(x + 1, y), at(x + 1, y + 1)}) mesh.corners.push_back(v);
      for (const std::uint32_t v : {at(x, y), at(x + 1, y + 1), at(x, y + 1)}) mesh.corners.push_back(v);
    }
  }
  return mesh;
}

/// A sphere with noise along its radius, from the same seed always.
Mesh noisy_sphere(float by) {
  Mesh mesh = bare({.kind = PrimitiveKind::IcoSphere, .subdivisions = 5});
  std::mt19937 random(4);
  std::normal_distribution<float> noise(0, by);
  for (glm::vec3& p : mesh.positions) p *= 1 + noise(random);
  return mesh;
}

double variance_of_radius(const Mesh& mesh) {
  double sum = 0;
  double squares = 0;
  for (const glm::vec3& p : mesh.positions) {
    const double r = glm::length(glm::dvec3(p));
    sum += r;
    squares += r * r;
  }
  const auto n = static_cast<double>(mesh.vertex_count());
  return squares / n - sum / n * (sum / n);
}

TEST(Smooth, MultipliesWavesByTheirTransferFunction) {
  const int n = 24;
  for (const auto& [i, j] : {std::pair{1, 0}, {3, 2}, {7, 7}, {12, 12}}) {
    Mesh mesh = torus_grid(n);
    const double a = 2 * kPi * i / n;
    const double b = 2 * kPi * j / n;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        mesh.positions[static_cast<std::size_t>(y * n + x)] = {std::cos(a * x + b * y), std::sin(a * x + b * y), 5};
      }
    }
    const double k = 1 - (std::cos(a) + std::cos(b) + std::cos(a + b)) / 3;
    for (const auto method : {SmoothMethod::Laplacian, SmoothMethod::Taubin}) {
      for (const float lambda : {0.3F, 0.5F}) {
        const Mesh result = smooth(mesh, {.method = method, .iterations = 3, .lambda = lambda});
        const double mu = method == SmoothMethod::Taubin ? 1 / (0.1 - 1 / static_cast<double>(lambda)) : 0;
        const double factor = std::pow((1 - static_cast<double>(lambda) * k) * (1 - mu * k), 3);
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
          const glm::dvec3 expected(factor * static_cast<double>(mesh.positions[v].x),
                                    factor * static_cast<double>(mesh.positions[v].y), 5);
          // Six roundings of coordinates up to 5, each less than 3 · 10⁻⁷.
          ASSERT_LT(glm::distance(glm::dvec3(result.positions[v]), expected), 2e-6) << i << ' ' << j;
        }
      }
    }
  }
}

/// One step by the definition: angles by arc cosines, edges in a map.
std::vector<glm::dvec3> reference(const Mesh& mesh, bool cotangent, double lambda) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> weights;
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    const auto vertex = [&](std::size_t k) { return mesh.corners[c / 3 * 3 + (c + k) % 3]; };
    const std::uint32_t a = vertex(1);
    const std::uint32_t b = vertex(2);
    const glm::dvec3 tip = mesh.positions[vertex(0)];
    const glm::dvec3 to_a = glm::normalize(glm::dvec3(mesh.positions[a]) - tip);
    const glm::dvec3 to_b = glm::normalize(glm::dvec3(mesh.positions[b]) - tip);
    double& weight = weights[{std::min(a, b), std::max(a, b)}];
    weight = cotangent ? weight + 1 / std::tan(std::acos(glm::dot(to_a, to_b))) : 1;
  }
  std::vector<glm::dvec3> sums(mesh.vertex_count(), glm::dvec3(0));
  std::vector<double> totals(mesh.vertex_count(), 0);
  for (const auto& [ends, weight] : weights) {
    const double w = std::max(weight, 0.0);
    sums[ends.first] += w * glm::dvec3(mesh.positions[ends.second]);
    sums[ends.second] += w * glm::dvec3(mesh.positions[ends.first]);
    totals[ends.first] += w;
    totals[ends.second] += w;
  }
  std::vector<glm::dvec3> result;
  for (std::size_t v = 0; v < sums.size(); ++v) {
    result.push_back(glm::mix(glm::dvec3(mesh.positions[v]), sums[v] / totals[v], lambda));
  }
  return result;
}

TEST(Smooth, WeighsNeighborsAsDefined) {
  for (const bool cotangent : {false, true}) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      Mesh mesh = seed == 0 ? sheet(5, true) : bare({.kind = PrimitiveKind::IcoSphere, .subdivisions = 2});
      scatter(mesh, 0.15F, seed);
      const auto expected = reference(mesh, cotangent, 0.75);
      const Mesh result = smooth(mesh, {.method = SmoothMethod::Laplacian,
                                        .weights = cotangent ? SmoothWeights::Cotangent : SmoothWeights::Uniform,
                                        .iterations = 1,
                                        .lambda = 0.75F,
                                        .border = SmoothBorder::Free});
      for (std::size_t v = 0; v < expected.size(); ++v) {
        ASSERT_LT(glm::distance(glm::dvec3(result.positions[v]), expected[v]), 1e-6) << "vertex " << v;
      }
    }
  }
}

TEST(Smooth, TaubinTakesNoiseAndKeepsTheVolume) {
  const Mesh noisy = noisy_sphere(0.02F);
  const double volume = volume_of(noisy);
  for (const auto weights : {SmoothWeights::Uniform, SmoothWeights::Cotangent}) {
    const Mesh taubin = smooth(noisy, {.weights = weights, .iterations = 20});
    const Mesh shrunk = smooth(noisy, {.method = SmoothMethod::Laplacian, .weights = weights, .iterations = 100});
    // At k = 1 noise is multiplied by (1 - 0.5) (1 + 0.53) = 0.77 in an iteration, 20 times. What is left are waves of k
    // below 0.2, about a twentieth of all: lengths of more than 7 edges. Cotangents of a surface as rough as this are
    // uneven, and take less.
    const double left = weights == SmoothWeights::Uniform ? 0.1 : 0.2;
    EXPECT_LT(variance_of_radius(taubin), left * variance_of_radius(noisy));
    EXPECT_LT(variance_of_radius(shrunk), left * variance_of_radius(noisy));
    // A sphere of edges h is a wave of k = h^2 / 2, here 0.0008: Taubin's step multiplies it by 1 + 0.026 k, 0.1 % of
    // the volume in 20 iterations; the noise itself holds 3 * 0.02^2 of it. Laplacian: (1 - k / 2)^300, 11 %.
    EXPECT_NEAR(volume_of(taubin), volume, 0.005 * volume);
    EXPECT_LT(volume_of(shrunk), 0.95 * volume);
  }
}

TEST(Smooth, KeepsTheMeanWhereAllHaveAsManyNeighbors) {
  Mesh mesh = torus_grid(20);
  scatter(mesh, 1, 8);
  for (const auto method : {SmoothMethod::Laplacian, SmoothMethod::Taubin}) {
    const Mesh result = smooth(mesh, {.method = method, .iterations = 25});
    glm::dvec3 moved(0);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) moved += glm::dvec3(result.positions[v] - mesh.positions[v]);
    // Sums of 400 roundings of 6 · 10⁻⁸ at each of 50 steps.
    EXPECT_LT(glm::length(moved / 400.0), 3e-6);
  }
}

TEST(Smooth, APlaneStaysOneAndShapesMoveAsWholes) {
  for (const auto border : {SmoothBorder::Along, SmoothBorder::Fixed, SmoothBorder::Free}) {
    for (const auto weights : {SmoothWeights::Uniform, SmoothWeights::Cotangent}) {
      Mesh mesh = sheet(8, border != SmoothBorder::Free);
      scatter(mesh, 0.3F, 2);
      for (glm::vec3& p : mesh.positions) p.z = 0;
      const SmoothOptions options{.weights = weights, .border = border};
      const Mesh flat = smooth(mesh, options);
      for (const glm::vec3& p : flat.positions) EXPECT_EQ(p.z, 0);
      Mesh turned = mesh.clone();
      const auto turn = [](const glm::vec3& p) { return glm::vec3(p.y, 2 + p.x, 0.5F - p.z); };
      for (glm::vec3& p : turned.positions) p = turn(p);
      const Mesh result = smooth(turned, options);
      for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_LT(glm::distance(result.positions[v], turn(flat.positions[v])), 1e-4F);
      }
    }
  }
}

TEST(Smooth, BordersStayOrFollowThemselves) {
  Mesh mesh = sheet(6, true);
  scatter(mesh, 0.3F, 2);
  const auto is_border = [&](std::size_t v) { return v % 7 == 0 || v % 7 == 6 || v < 7 || v >= 42; };
  const Mesh fixed = smooth(mesh, {.border = SmoothBorder::Fixed});
  const Mesh along = smooth(mesh, {.border = SmoothBorder::Along});
  const Mesh free = smooth(mesh, {.method = SmoothMethod::Laplacian, .iterations = 1, .border = SmoothBorder::Free});
  Mesh bumpy = mesh.clone();
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) bumpy.positions[v].z += is_border(v) ? 0.0F : 3.0F;
  const Mesh along_bumpy = smooth(bumpy, {.border = SmoothBorder::Along});
  const Mesh once = smooth(mesh, {.method = SmoothMethod::Laplacian, .iterations = 1, .lambda = 1});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(fixed.positions[v] == mesh.positions[v], is_border(v));
    EXPECT_NE(along.positions[v], mesh.positions[v]);
    EXPECT_NE(free.positions[v], mesh.positions[v]);
    if (!is_border(v)) continue;
    EXPECT_EQ(along.positions[v], along_bumpy.positions[v]);
  }
  EXPECT_LT(glm::distance(once.positions[3], 0.5F * (mesh.positions[2] + mesh.positions[4])), 1e-6F);
  EXPECT_LT(glm::distance(once.positions[0], 0.5F * (mesh.positions[1] + mesh.positions[7])), 1e-6F);
}

TEST(Smooth, CotangentsHardlyMoveAlongTheSurface) {
  // A plane of triangles of all sizes, a bump of one vertex: only uniform weights even the others out.
  Mesh mesh = sheet(8, true);
  for (glm::vec3& p : mesh.positions) p.x = p.x * p.x / 8;
  const auto moved = [&](SmoothWeights weights) {
    const Mesh result = smooth(
        mesh, {.method = SmoothMethod::Laplacian, .weights = weights, .iterations = 5, .border = SmoothBorder::Fixed});
    float most = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      most = std::max(most, glm::distance(mesh.positions[v], result.positions[v]));
    }
    return most;
  };
  EXPECT_LT(moved(SmoothWeights::Cotangent), 1e-5F);
  EXPECT_GT(moved(SmoothWeights::Uniform), 0.1F);
}

TEST(Smooth, KeepsWhatIsOnTheMesh) {
  Mesh mesh = primitive({.kind = PrimitiveKind::Cube});
  mesh.material.assign(mesh.face_count(), 2);
  mesh.lines = {0, 7};
  mesh.morph_targets.push_back({"morph", mesh.positions, mesh.positions});
  const Mesh result = smooth(mesh, {.iterations = 3});
  EXPECT_EQ(result.corners, mesh.corners);
  EXPECT_EQ(result.face_offsets, mesh.face_offsets);
  EXPECT_EQ(result.material, mesh.material);
  EXPECT_EQ(result.lines, mesh.lines);
  EXPECT_EQ(result.find("TEXCOORD_0")->values, mesh.find("TEXCOORD_0")->values);
  ASSERT_NE(result.find("NORMAL"), nullptr);
  EXPECT_EQ(result.find("NORMAL")->domain, Domain::Vertex);
  // A target of the positions themselves stays that.
  EXPECT_EQ(result.morph_targets[0].positions, result.positions);
  EXPECT_TRUE(result.morph_targets[0].normals.empty());
  EXPECT_EQ(smooth(mesh, {.iterations = 0}).positions, mesh.positions);
  EXPECT_EQ(smooth(mesh, {.lambda = 0}).positions, mesh.positions);
  const Mesh cloud = mesh_of({{1, 2, 3}, {4, 5, 6}}, {});
  EXPECT_EQ(smooth(cloud).positions, cloud.positions);
  EXPECT_EQ(smooth(Mesh()).vertex_count(), 0U);
}

TEST(Smooth, WhatIsNotFiniteStaysAlone) {
  Mesh mesh = sheet(6, true);
  scatter(mesh, 0.3F, 2);
  mesh.positions[24].y = std::numeric_limits<float>::quiet_NaN();
  mesh.positions[10].x = std::numeric_limits<float>::infinity();
  for (const auto weights : {SmoothWeights::Uniform, SmoothWeights::Cotangent}) {
    const Mesh result = smooth(mesh, {.weights = weights, .iterations = 20});
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const glm::vec3 p = result.positions[v];
      EXPECT_EQ(std::isfinite(p.x + p.y + p.z), v != 24 && v != 10) << v;
    }
    EXPECT_EQ(result.positions[24].x, mesh.positions[24].x);
  }
}

TEST(Smooth, TakesAnySoup) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = soup(seed, seed % 2 == 0);
    for (const auto weights : {SmoothWeights::Uniform, SmoothWeights::Cotangent}) {
      for (const auto border : {SmoothBorder::Along, SmoothBorder::Fixed, SmoothBorder::Free}) {
        const Mesh result = smooth(mesh, {.method = SmoothMethod::Laplacian, .weights = weights, .border = border});
        ASSERT_NO_THROW(result.check("result"));
        for (const glm::vec3& p : result.positions) {
          for (int i = 0; i < 3; ++i) ASSERT_LE(std::abs(p[i]), 1.00001F);  // means stay in the box
        }
      }
    }
  }
}

TEST(Smooth, RefusesWhatGrows) {
  const Mesh mesh = sheet(3, true);
  EXPECT_THROW(smooth(mesh, {.lambda = 0.9F}), Error);
  EXPECT_THROW(smooth(mesh, {.lambda = 1.1F}), Error);
  EXPECT_THROW(smooth(mesh, {.lambda = 0.9F, .mu = -1.5F}), Error);
  EXPECT_THROW(smooth(mesh, {.mu = 0.5F}), Error);
  EXPECT_THROW(smooth(mesh, {.iterations = -1}), Error);
  EXPECT_NO_THROW(smooth(mesh, {.method = SmoothMethod::Laplacian, .lambda = 1}));
  EXPECT_NO_THROW(smooth(mesh, {.lambda = 0.6307F, .mu = -0.6732F}));
}

TEST(Smooth, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = noisy_sphere(0.05F);
  for (const auto weights : {SmoothWeights::Uniform, SmoothWeights::Cotangent}) {
    azulejo::Run run;
    run.threads = 1;
    const Mesh one = smooth(mesh, {.weights = weights}, run);
    for (const int threads : {2, 7}) {
      run.threads = threads;
      EXPECT_EQ(smooth(mesh, {.weights = weights}, run).positions, one.positions);
    }
  }
}

}  // namespace
}  // namespace azulejo
