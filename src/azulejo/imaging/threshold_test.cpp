#include "azulejo/imaging/threshold.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

TEST(Threshold, MarksEveryByteAboveTheLevel) {
  Image source(256, 1, 1);
  for (int v = 0; v < 256; ++v) source.view<std::uint8_t>()(v, 0) = static_cast<std::uint8_t>(v);
  for (const float level : {0.0F, 0.25F, 0.5F, 100.0F / 255.0F, 0.999F, 1.0F}) {
    const Image mask = threshold(source, {.level = level});
    const Image inverse = threshold(source, {.level = level, .invert = true});
    for (int v = 0; v < 256; ++v) {
      const bool above = static_cast<float>(v) > level * 255.0F;
      EXPECT_EQ(mask.view<std::uint8_t>()(v, 0), above ? 255 : 0) << v << " against " << level;
      EXPECT_EQ(inverse.view<std::uint8_t>()(v, 0), above ? 0 : 255) << v << " against " << level;
    }
  }
}

TEST(Threshold, NaNIsNotAboveAnyLevelAndInfinityIs) {
  Image source(3, 1, 1, PixelType::F32);
  const float values[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.0F};
  std::copy_n(values, 3, source.view<float>().row(0));
  const Image mask = threshold(source, {.level = 0});
  EXPECT_EQ(mask.view<float>()(0, 0), 0.0F);
  EXPECT_EQ(mask.view<float>()(1, 0), 1.0F);
  EXPECT_EQ(mask.view<float>()(2, 0), 0.0F);
}

TEST(Threshold, CopiesAlpha) {
  Image source(50, 1, 4, PixelType::U16);
  std::fill_n(source.view<std::uint16_t>().row(0), 200, std::uint16_t{40000});
  const Image mask = threshold(source);
  for (int x = 0; x < 50; ++x) {
    EXPECT_EQ(mask.view<std::uint16_t>()(x, 0, 0), 65535);
    EXPECT_EQ(mask.view<std::uint16_t>()(x, 0, 3), 40000);
  }
}

TEST(Threshold, OfAMaskIsTheMaskAndWorksInPlace) {
  const unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  Image source(203, 31, 3);
  for (int y = 0; y < 31; ++y) {
    for (int i = 0; i < 609; ++i) source.view<std::uint8_t>().row(y)[i] = static_cast<std::uint8_t>(random());
  }
  const Image once = threshold(source, {.level = 0.3F});
  const Image twice = threshold(once, {.level = 0.6F});
  threshold(source.any(), source.any(), {.level = 0.3F});
  for (int y = 0; y < 31; ++y) {
    for (int i = 0; i < 609; ++i) {
      const int expected = once.view<std::uint8_t>().row(y)[i];
      ASSERT_EQ(twice.view<std::uint8_t>().row(y)[i], expected);
      ASSERT_EQ(source.view<std::uint8_t>().row(y)[i], expected);
    }
  }
}

TEST(Threshold, RefusesALevelOutsideTheRange) {
  const Image source(1, 1, 1);
  EXPECT_THROW(threshold(source, {.level = 1.5F}), Error);
  EXPECT_THROW(threshold(source, {.level = std::nanf("")}), Error);
}

}  // namespace
}  // namespace azulejo
