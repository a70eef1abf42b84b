#include "azulejo/imaging/test_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

const double kPi = std::acos(-1.0);

TestPatternOptions floats(Pattern kind, int width, int height) {
  TestPatternOptions options;
  options.kind = kind;
  options.width = width;
  options.height = height;
  options.type = PixelType::F32;
  return options;
}

TEST(TestPattern, ZonePlateHasItsFrequencies) {
  for (const auto& [width, height] : {std::pair{64, 64}, {101, 37}}) {
    const Image rings = test_pattern(floats(Pattern::ZonePlate, width, height));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double dx = x + 0.5 - width / 2.0;
        const double dy = y + 0.5 - height / 2.0;
        const double radius = std::min(width, height) / 2.0;
        const double exact = 0.5 + 0.5 * std::cos(2 * kPi * 0.5 * (dx * dx + dy * dy) / (2 * radius));
        ASSERT_NEAR(rings.view<float>()(x, y), exact, 5e-7);  // of the cosine: 2·10⁻⁷, and its argument in f32
      }
    }
  }
}

TEST(TestPattern, RampGoesFromEndToEndInEachDirection) {
  TestPatternOptions options = floats(Pattern::Ramp, 33, 9);
  const Image right = test_pattern(options);
  options.angle_deg = 90;
  const Image up = test_pattern(options);
  options.angle_deg = 180;
  const Image left = test_pattern(options);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 33; ++x) {
      EXPECT_NEAR(right.view<float>()(x, y), x / 32.0, 1e-7);
      EXPECT_NEAR(left.view<float>()(x, y), 1 - x / 32.0, 1e-7);
      EXPECT_NEAR(up.view<float>()(x, y), 1 - y / 8.0, 1e-7);
    }
  }
  EXPECT_EQ(test_pattern(floats(Pattern::Ramp, 1, 1)).view<float>()(0, 0), 0);
}

TEST(TestPattern, ARampOf256BytesHasEachOnce) {
  TestPatternOptions options;
  options.kind = Pattern::Ramp;
  options.width = 256;
  options.height = 1;
  const Image ramp = test_pattern(options);
  for (int x = 0; x < 256; ++x) EXPECT_EQ(ramp.view<std::uint8_t>()(x, 0), x);
}

TEST(TestPattern, CheckerHasItsFields) {
  TestPatternOptions options;
  options.kind = Pattern::Checker;
  options.width = 40;
  options.height = 24;
  options.period = 8;
  options.channels = 3;
  options.low = 0.2F;
  options.high = 0.6F;
  const Image board = test_pattern(options);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(board.view<std::uint8_t>()(x, y, c), (x / 4 + y / 4) % 2 == 0 ? 51 : 153) << x << ", " << y;
    }
  }
}

TEST(TestPattern, StripesAreASine) {
  TestPatternOptions options = floats(Pattern::Stripes, 50, 40);
  options.period = 7;
  options.angle_deg = 30;
  const Image stripes = test_pattern(options);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 50; ++x) {
      const double along = (x + 0.5 - 25) * std::cos(kPi / 6) - (y + 0.5 - 20) * std::sin(kPi / 6);
      // The direction is known to 2·10⁻⁷, the argument is up to 5 turns.
      ASSERT_NEAR(stripes.view<float>()(x, y), 0.5 + 0.5 * std::cos(2 * kPi * along / 7), 2e-5);
    }
  }
}

TEST(TestPattern, EdgesAreIdealOrSoft) {
  TestPatternOptions options = floats(Pattern::Edge, 21, 3);
  const Image ideal = test_pattern(options);
  options.softness = 4;
  const Image soft = test_pattern(options);
  for (int x = 0; x < 21; ++x) {
    EXPECT_EQ(ideal.view<float>()(x, 1), x < 10 ? 0.0F : x > 10 ? 1.0F : 0.5F);
    EXPECT_EQ(soft.view<float>()(x, 1), static_cast<float>(std::clamp(0.5 + (x - 10) / 4.0, 0.0, 1.0)));
  }
}

TEST(TestPattern, StarHasItsSpokes) {
  TestPatternOptions options = floats(Pattern::SiemensStar, 401, 401);
  options.spokes = 12;
  const Image star = test_pattern(options);
  int changes = 0;
  float last = star.view<float>()(200 + 150, 200 - 1);
  for (int i = 0; i < 3600; ++i) {
    const double angle = (i + 30.5) / 3600 * 2 * kPi;
    const float now = star.view<float>()(static_cast<int>(200.5 + 150 * std::cos(angle)),
                                         static_cast<int>(200.5 - 150 * std::sin(angle)));
    changes += now != last ? 1 : 0;
    last = now;
  }
  EXPECT_EQ(changes, 24);
  EXPECT_EQ(star.view<float>()(390, 190), 1);  // just above the axis
  EXPECT_EQ(star.view<float>()(390, 210), 0);
}

TEST(TestPattern, RefusesTwoChannels) {
  TestPatternOptions options;
  options.channels = 2;
  EXPECT_THROW(test_pattern(options), Error);
}

}  // namespace
}  // namespace azulejo
