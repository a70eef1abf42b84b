#include "azulejo/imaging/false_color.h"

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/channels.h"
#include "azulejo/imaging/contrast_stretch.h"

namespace azulejo {
namespace {

TEST(FalseColor, StretchesFromTheSmallestToTheLargestOfEachBand) {
  Image first(101, 1, 1);
  Image others(101, 1, 2);
  others.set_states(ColorState::Data, AlphaState::None);
  for (int x = 0; x <= 100; ++x) {
    first.view<std::uint8_t>()(x, 0) = static_cast<std::uint8_t>(50 + x);
    others.view<std::uint8_t>()(x, 0, 0) = static_cast<std::uint8_t>(200 - x);
    others.view<std::uint8_t>()(x, 0, 1) = static_cast<std::uint8_t>(x / 2);
  }
  const Image* const images[] = {&first, &others};
  const Image result = false_color(images, {.red = 3, .green = 1, .blue = 2, .low = 0, .high = 100});
  EXPECT_EQ(result.info().color, ColorState::Srgb);
  for (int x = 0; x <= 100; ++x) {
    const auto byte = [](double share) { return static_cast<int>(share * 255 + 0.5); };
    EXPECT_NEAR(result.view<std::uint8_t>()(x, 0, 0), byte(x / 2 / 50.0), 1);
    EXPECT_NEAR(result.view<std::uint8_t>()(x, 0, 1), byte(x / 100.0), 1);
    EXPECT_NEAR(result.view<std::uint8_t>()(x, 0, 2), byte(1 - x / 100.0), 1);
  }
}

TEST(FalseColor, IsContrastStretchOfEachChannelOfOneImage) {
  const unsigned seed = 8;
  SCOPED_TRACE(seed);
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const Image source = random_image(Image(83, 41, 3, type).info(), seed);
    const Image* const images[] = {&source};
    const Image result = false_color(images, {.red = 3, .green = 3, .blue = 1, .low = 10, .high = 80});
    const Image stretched = contrast_stretch(source, {.low = 10, .high = 80, .per_channel = true});
    const Image expected = channels(stretched, {.take = {"b", "b", "r"}});
    visit(result.any(), [&](auto view) {
      using T = std::remove_pointer_t<decltype(view.data)>;
      for (int y = 0; y < 41; ++y) {
        for (int i = 0; i < 249; ++i) ASSERT_EQ(view.row(y)[i], expected.view<std::remove_const_t<T>>().row(y)[i]);
      }
    });
  }
}

TEST(FalseColor, RefusesABandThatIsNotThere) {
  const Image source(3, 3, 3);
  const Image* const images[] = {&source};
  EXPECT_THROW(false_color(images, {.blue = 4}), Error);
  EXPECT_THROW(false_color(images, {.red = 0}), Error);
  EXPECT_THROW(false_color(images, {.low = 60, .high = 40}), Error);
  const Image larger(3, 4, 3);
  const Image* const both[] = {&source, &larger};
  EXPECT_THROW(false_color(both), Error);
}

}  // namespace
}  // namespace azulejo
