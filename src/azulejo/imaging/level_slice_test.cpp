#include "azulejo/imaging/level_slice.h"

#include "azulejo/core/error.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

PointOperation with(const LevelSliceOptions& options) {
  return [options](const Image& source) { return level_slice(source, options); };
}

TEST(LevelSlice, MarksTheBandWithBothItsEnds) {
  // The ends are values of the image.
  const float low = 100.0F / 255.0F;
  const float high = 150.0F / 255.0F;
  const Image source = every_value(PixelType::U8);
  const Image dropped = level_slice(source, {.low = low, .high = high});
  const Image kept = level_slice(source, {.low = low, .high = high, .level = 0.2F, .keep = true});
  for (int v = 0; v < 256; ++v) {
    const bool inside = v >= 100 && v <= 150;
    EXPECT_EQ(dropped.view<std::uint8_t>()(v, 0), inside ? 255 : 0) << v;
    EXPECT_EQ(kept.view<std::uint8_t>()(v, 0), inside ? 51 : v) << v;
  }
}

TEST(LevelSlice, IsTheSameInSixteenBitsAndFloats) {
  for (const bool keep : {false, true}) {
    const LevelSliceOptions options{.low = 0.3F, .high = 0.31F, .level = 0.8F, .keep = keep};
    const auto exact = [&](double v) {
      const auto f = static_cast<float>(v);
      return f >= 0.3F && f <= 0.31F ? static_cast<double>(0.8F) : keep ? v : 0;
    };
    expect_rounded(with(options), exact, PixelType::U16, 0.01);
    expect_real(with(options), exact, 0, 0);
  }
}

TEST(LevelSlice, NaNIsOutside) {
  EXPECT_EQ(of_one(with({.low = 0, .high = 1}), kNaN), 0.0F);
  EXPECT_TRUE(std::isnan(of_one(with({.low = 0, .high = 1, .keep = true}), kNaN)));
}

TEST(LevelSlice, LeavesAlphaAlone) { expect_alpha_is_left_alone(with({.low = 0.2F, .high = 0.7F, .keep = true})); }

TEST(LevelSlice, RefusesABandThatEndsBeforeItBegins) {
  const Image source(1, 1, 1);
  EXPECT_THROW(level_slice(source, {.low = 0.7F}), Error);
  EXPECT_THROW(level_slice(source, {.high = 1.1F}), Error);
}

}  // namespace
}  // namespace azulejo
