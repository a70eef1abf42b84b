#include "azulejo/rendering/crisp_path.h"

#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/modelling/path_testing.h"

namespace azulejo {
namespace {

constexpr glm::mat3x2 kSame{1, 0, 0, 1, 0, 0};
constexpr Rect kWide{-100, -100, 400, 400};
using Pixel = std::pair<int, int>;

/// How often each pixel is drawn.
std::map<Pixel, int> pixels_of(const Array<CrispLine>& lines, int first_row = -100, int last_row = 299) {
  std::map<Pixel, int> pixels;
  for (const CrispLine& line : lines) {
    for_runs(line, first_row, last_row, [&](int row, int begin, int end) {
      EXPECT_LT(begin, end);
      for (int x = begin; x < end; ++x) ++pixels[{x, row}];
    });
  }
  return pixels;
}

Array<CrispLine> crisp(const Path& path, const DrawingStyle& style = {}, const Rect& window = kWide,
                       const glm::mat3x2& matrix = kSame) {
  Array<CrispLine> lines;
  FlatPath scratch;
  crisp_path(view_of(path), style, matrix, {0.1F, window}, scratch, lines);
  return lines;
}

/// As textbooks have it, with its decision variable, turned into the first octant.
std::vector<Pixel> textbook(int x0, int y0, int x1, int y1) {
  const int dx = std::abs(x1 - x0);
  const int dy = std::abs(y1 - y0);
  const bool steep = dy > dx;
  const int along = steep ? dy : dx;
  const int across = steep ? dx : dy;
  std::vector<Pixel> pixels;
  int decision = 2 * across - along;
  for (int i = 0, far = 0; i <= along; ++i) {
    const int right = steep ? far : i;
    const int down = steep ? i : far;
    pixels.emplace_back(x0 + (x1 < x0 ? -right : right), y0 + (y1 < y0 ? -down : down));
    if (decision >= 0) {
      ++far;
      decision -= 2 * along;
    }
    decision += 2 * across;
  }
  return pixels;
}

Path line_of(int x0, int y0, int x1, int y1) {
  return Path()
      .move_to({static_cast<float>(x0) + 0.3F, static_cast<float>(y0) + 0.9F})
      .line_to({static_cast<float>(x1) + 0.7F, static_cast<float>(y1) + 0.1F});
}

TEST(CrispPath, IsBresenhamsLineInAllOctants) {
  for (int y = -12; y <= 12; ++y) {
    for (int x = -12; x <= 12; ++x) {
      std::map<Pixel, int> wanted;
      for (const Pixel& pixel : textbook(3, 4, 3 + x, 4 + y)) ++wanted[pixel];
      EXPECT_EQ(pixels_of(crisp(line_of(3, 4, 3 + x, 4 + y))), wanted) << x << ", " << y;
    }
  }
}

TEST(CrispPath, WindowsAndBandsShowTheSamePixels) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(-90, 200);
  for (int i = 0; i < 300; ++i) {
    const int x0 = place(random), y0 = place(random), x1 = place(random), y1 = place(random);
    std::map<Pixel, int> wanted;
    const Rect window{place(random) / 4, place(random) / 4, 1 + i % 60, 1 + i % 37};
    for (const Pixel& pixel : textbook(x0, y0, x1, y1)) {
      if (pixel.first >= window.x && pixel.first < window.right() && pixel.second >= window.y &&
          pixel.second < window.bottom()) {
        ++wanted[pixel];
      }
    }
    const Array<CrispLine> lines = crisp(line_of(x0, y0, x1, y1), {}, window);
    EXPECT_EQ(pixels_of(lines), wanted) << i;
    std::map<Pixel, int> banded;
    for (int row = -100; row < 300; row += 7) banded.merge(pixels_of(lines, row, row + 6));
    EXPECT_EQ(banded, wanted) << i;
  }
}

TEST(CrispPath, LinesFarBeyondTheWindowAreExactThere) {
  // Around (x, y) = (0, 0), which the line passes at half of its length.
  const int far = 200000000;
  CrispLine line{-far, -far / 2 - 1, far, far / 2 + 1, 0, 2 * far};
  ASSERT_TRUE(clip(line, {-3, -3, 7, 7}));
  EXPECT_EQ(line.first, far - 3);
  EXPECT_EQ(line.last, far + 3);
  std::map<Pixel, int> wanted;
  for (int x = -3; x <= 3; ++x) {
    const std::int64_t across = (std::int64_t{2} * (far + x) * (far + 2) + 2 * far) / (std::int64_t{4} * far);
    wanted[{x, static_cast<int>(across) - far / 2 - 1}] = 1;
  }
  EXPECT_EQ(pixels_of({line}), wanted);
  EXPECT_EQ(pixels_of(crisp(Path().move_to({-1e30F, 5}).line_to({1e30F, 5}), {}, {0, 0, 10, 10})).size(), 10U);
  EXPECT_EQ(crisp(Path().move_to({-1e30F, 3e38F}).line_to({1e30F, 3e38F})).size(), 0U);
}

TEST(CrispPath, EachVertexIsDrawnOnce) {
  const Path open = Path().move_to({0.5F, 0.5F}).line_to({9.5F, 3.5F}).line_to({12.5F, 20.5F}).line_to({2.5F, 30.5F});
  Path closed = open;
  closed.close();
  for (const auto& [pixel, count] : pixels_of(crisp(open))) EXPECT_EQ(count, 1) << pixel.first << ", " << pixel.second;
  EXPECT_EQ(pixels_of(crisp(open)).size(), 9U + 17 + 10 + 1);
  for (const auto& [pixel, count] : pixels_of(crisp(closed)))
    EXPECT_EQ(count, 1) << pixel.first << ", " << pixel.second;
  EXPECT_EQ(pixels_of(crisp(closed)).size(), 9U + 17 + 10 + 30);
  EXPECT_EQ(pixels_of(crisp(Path().move_to({3.2F, 4.8F}).close())), (std::map<Pixel, int>{{{3, 4}, 1}}));
  EXPECT_EQ(pixels_of(crisp(Path().move_to({3.2F, 4.8F}).line_to({3.3F, 4.1F}))), (std::map<Pixel, int>{{{3, 4}, 1}}));
  EXPECT_EQ(crisp(Path().move_to({3.2F, 4.8F})).size(), 0U);
  EXPECT_EQ(crisp(Path().move_to({3, std::numeric_limits<float>::quiet_NaN()}).line_to({1, 1})).size(), 0U);
}

TEST(CrispPath, StippleIsCountedAlongThePolyline) {
  for (const unsigned bits : {0x00FFU, 0xAAAAU, 0x0F01U, 0x8001U, 0x7FFEU, 0x0001U}) {
    for (const int factor : {1, 3}) {
      const LineStipple stipple = line_stipple(static_cast<std::uint16_t>(bits), factor);
      DrawingStyle style;
      style.dash = stipple.dash;
      style.dash_offset = stipple.dash_offset;
      const std::vector<Pixel> corners = {{5, 5}, {60, 31}, {20, 90}, {110, 80}};
      Path path = Path().move_to({5.5F, 5.5F});
      std::map<Pixel, int> wanted;
      unsigned counter = 0;  // OpenGL: bit ⌊s / factor⌋ mod 16
      for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const auto [x0, y0] = corners[i];
        const auto [x1, y1] = corners[i + 1];
        path.line_to({static_cast<float>(x1) + 0.5F, static_cast<float>(y1) + 0.5F});
        auto pixels = textbook(x0, y0, x1, y1);
        if (i + 2 < corners.size()) pixels.pop_back();
        for (const Pixel& pixel : pixels) {
          if ((bits >> (counter++ / static_cast<unsigned>(factor) % 16) & 1) != 0) ++wanted[pixel];
        }
      }
      EXPECT_EQ(pixels_of(crisp(path, style)), wanted) << bits << " x " << factor;
      // In a part of the picture the counter goes on.
      std::erase_if(wanted, [](const auto& each) { return each.first.first < 30 || each.first.first >= 50; });
      EXPECT_EQ(pixels_of(crisp(path, style, {30, 0, 20, 200})), wanted) << bits << " x " << factor;
    }
  }
  DrawingStyle none;
  none.dash = line_stipple(0, 2).dash;
  EXPECT_EQ(crisp(line_of(0, 0, 50, 9), none).size(), 0U);
  DrawingStyle scaled;
  scaled.dash = {2, 2};
  const glm::mat3x2 twice(2, 0, 0, 2, 0, 0);
  EXPECT_EQ(pixels_of(crisp(Path().move_to({0.1F, 0.1F}).line_to({15.9F, 0.1F}), scaled, kWide, twice)).size(), 16U);
}

}  // namespace
}  // namespace azulejo
