#include "azulejo/vision/height_field.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "azulejo/core/error.h"
#include "azulejo/data/image.h"
#include "azulejo/modelling/closed.h"

namespace azulejo {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();
using Options = HeightFieldOptions;

Image image_of(int width, int height, float (*at)(int x, int y)) {
  Image image(width, height, 1, PixelType::F32);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.view<float>()(x, y) = at(x, y);
  }
  return image;
}

glm::dvec3 corner_of(const Mesh& mesh, std::size_t corner) { return mesh.positions[mesh.corners[corner]]; }
glm::vec3 normal_of(const Mesh& mesh, std::size_t vertex) {
  const Array<float>& all = *mesh.find("NORMAL")->get<float>();
  return {all[3 * vertex], all[3 * vertex + 1], all[3 * vertex + 2]};
}

double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (std::size_t c = 0; c < mesh.corner_count(); c += 3) {
    volume += glm::dot(corner_of(mesh, c), glm::cross(corner_of(mesh, c + 1), corner_of(mesh, c + 2))) / 6;
  }
  return volume;
}

TEST(HeightField, ATiltedPlaneIsOne) {
  const Image image = image_of(5, 4, [](int x, int y) { return 2.0F * static_cast<float>(x) + static_cast<float>(y); });
  const Mesh mesh = height_field(image.any(), {.height = 1, .spacing = 1.0F});
  mesh.check("height_field");
  ASSERT_EQ(mesh.vertex_count(), 20U);
  ASSERT_EQ(mesh.face_count(), 2U * 4 * 3);
  EXPECT_EQ(mesh.positions[0], glm::vec3(-2, 0, -1.5F));  // the first row lies at the back
  EXPECT_EQ(mesh.positions[19], glm::vec3(2, 11, 1.5F));
  const glm::vec3 normal = glm::normalize(glm::vec3(-2, 1, -1));
  for (std::size_t v = 0; v < 20; ++v) EXPECT_LT(glm::distance(normal_of(mesh, v), normal), 1e-6F) << v;
  for (std::size_t c = 0; c < mesh.corner_count(); c += 3) {
    const glm::dvec3 across =
        glm::cross(corner_of(mesh, c + 1) - corner_of(mesh, c), corner_of(mesh, c + 2) - corner_of(mesh, c));
    EXPECT_LT(glm::distance(glm::normalize(across), glm::dvec3(normal)), 1e-6) << c;
  }
  const Array<float>& uv = *mesh.find("TEXCOORD_0")->get<float>();
  EXPECT_EQ(uv[0], 0.1F);
  EXPECT_EQ(uv[1], 0.125F);
  EXPECT_EQ(uv[38], 0.9F);
}

TEST(HeightField, TheAutomaticSpacingMakesTheLongerSideTwo) {
  const Image image = image_of(41, 21, [](int, int) { return 0.0F; });
  EXPECT_EQ(bounds(height_field(image.any())), (Box3{{-1, 0, -0.5F}, {1, 0, 0.5F}}));
}

TEST(HeightField, TakesTheChannelThatItIsTold) {
  Image image(2, 2, 4);
  const std::uint8_t pixel[4] = {255, 51, 102, 204};
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) std::copy(pixel, pixel + 4, &image.view<std::uint8_t>()(x, y));
  }
  const auto top = [&](HeightChannel channel) {
    return height_field(image.any(), {.channel = channel, .height = 1}).positions[0].y;
  };
  EXPECT_NEAR(top(HeightChannel::Luma), 0.299F + 0.587F * 0.2F + 0.114F * 0.4F, 1e-6F);
  EXPECT_NEAR(top(HeightChannel::Red), 1, 1e-6F);
  EXPECT_NEAR(top(HeightChannel::Blue), 0.4F, 1e-6F);
  EXPECT_NEAR(top(HeightChannel::Alpha), 0.8F, 1e-6F);
  EXPECT_THROW(height_field(Image(2, 2, 3).any(), {.channel = HeightChannel::Alpha}), Error);
}

TEST(HeightField, ABaseClosesItAndItsVolumeIsTheSumOfHeights) {
  const Image image = image_of(30, 20, [](int x, int y) { return std::sin(0.3F * static_cast<float>(x * y % 17)); });
  const Mesh mesh = height_field(image.any(), {.height = 1, .spacing = 1.0F, .base = -3.0F});
  mesh.check("height_field");
  EXPECT_TRUE(is_closed(mesh));
  // Prisms: each triangle's area ½ × the mean height of its corners above the base.
  const Mesh open = height_field(image.any(), {.height = 1, .spacing = 1.0F});
  double volume = 0;
  for (std::size_t c = 0; c < open.corner_count(); ++c) volume += 0.5 / 3 * (corner_of(open, c).y + 3);
  EXPECT_NEAR(volume_of(mesh), volume, 1e-4 * volume);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(glm::length(normal_of(mesh, v)), 1, 1e-5F);
  EXPECT_THROW(height_field(image.any(), {.height = 1, .base = 0.0F}), Error);
}

TEST(HeightField, HolesAreWhereNumbersAreMissing) {
  const Image image = image_of(6, 5, [](int x, int y) { return x == 2 && y == 2 ? kHole : 1.0F; });
  const Mesh mesh = height_field(image.any(), {.height = 1, .spacing = 1.0F});
  mesh.check("height_field");
  EXPECT_EQ(mesh.vertex_count(), 29U);
  EXPECT_EQ(mesh.face_count(), 2U * 20 - 4);  // four cells lost a half
  const EdgeCounts edges = count_edges(mesh);
  EXPECT_EQ(edges.border, 2U * (5 + 4) + 4);
  EXPECT_EQ(edges.turned + edges.crowded, 0U);
  const Mesh solid = height_field(image.any(), {.height = 1, .spacing = 1.0F, .base = 0.0F});
  EXPECT_TRUE(is_closed(solid));
  EXPECT_NEAR(volume_of(solid), 20 - 2, 1e-4);
}

/// Sparse holes of any shape: edges of the open surface are of one or two faces, walls close it where no two holes
/// touch in one sample only; nothing is left over.
TEST(HeightField, AnyHolesLeaveASurface) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Image image(1 + static_cast<int>(random() % 9), 1 + static_cast<int>(random() % 9), 1, PixelType::F32);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const bool infinite = random() % 20 == 0;
        image.view<float>()(x, y) =
            random() % 4 == 0 ? (infinite ? INFINITY : kHole) : static_cast<float>(random() % 100) / 100;
      }
    }
    const Mesh open = height_field(image.any());
    open.check("open");
    EXPECT_EQ(count_edges(open).turned + count_edges(open).crowded, 0U);
    const Mesh solid = height_field(image.any(), {.base = -1.0F});
    solid.check("solid");
    EXPECT_EQ(count_edges(solid).turned + count_edges(solid).border, 0U);
    // Threads make no difference.
    const Mesh again = height_field(image.any(), {.base = -1.0F}, {.threads = 3});
    EXPECT_EQ(solid.corners, again.corners);
    EXPECT_EQ(solid.positions, again.positions);
  }
}

TEST(HeightField, CellsAreCutWhereTheyAreFlatter) {
  const Image ridge = image_of(2, 2, [](int x, int y) { return x == y ? 1.0F : 0.0F; });
  const Mesh mesh = height_field(ridge.any());
  // Both faces have the two high corners.
  for (std::size_t f = 0; f < 2; ++f) {
    int high = 0;
    for (std::size_t c = 3 * f; c < 3 * f + 3; ++c) high += corner_of(mesh, c).y > 0 ? 1 : 0;
    EXPECT_EQ(high, 2);
  }
}

TEST(HeightField, ReadsTables) {
  const std::string path = testing::TempDir() + "/azulejo-heights.csv";
  std::ofstream(path) << "0;1,5;0\n0;;0\n0;0;0\n";
  const Mesh mesh = height_field(path, {.height = 2, .spacing = 1.0F});
  EXPECT_EQ(mesh.vertex_count(), 8U);
  EXPECT_EQ(mesh.positions[1], glm::vec3(0, 3, -1));
  std::ofstream(path) << "0,a\n0,b\n";
  EXPECT_THROW(height_field(path), Error);
  std::remove(path.c_str());
  EXPECT_THROW(height_field(path), Error);
}

TEST(HeightField, AskForMemoryFirst) {
  azulejo::Run run;
  run.limits.memory_bytes = 1 << 16;
  const Image image = image_of(100, 100, [](int, int) { return 0.0F; });
  EXPECT_THROW(height_field(image.any(), {}, run), Error);
}

}  // namespace
}  // namespace azulejo
