#include "azulejo/imaging/invert.h"

#include <cstring>

#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

Image negative(const Image& source) { return invert(source); }

TEST(Invert, IsTheRangeMinusEachValue) {
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    expect_rounded(
        negative, [](double v) { return 1 - v; }, type, 1e-9);
  }
  // One subtraction of f32 in [−0.5, 1.5].
  expect_real(
      negative, [](double v) { return 1 - v; }, 0x1p-24, 0);
  EXPECT_TRUE(std::isnan(of_one(negative, kNaN)));
  EXPECT_EQ(of_one(negative, kInfinity), -kInfinity);
}

TEST(Invert, TwiceIsTheSource) {
  for (const AlphaState alpha : {AlphaState::None, AlphaState::Straight, AlphaState::Premultiplied}) {
    for (const PixelType type : {PixelType::U8, PixelType::U16}) {
      for (const int channels : {2, 4}) {
        const unsigned seed = 11;
        SCOPED_TRACE(seed);
        Image source = random_image({71, 5, channels, type, ColorState::Srgb, alpha}, seed);
        visit(source.any(), [&](auto view) {
          // Premultiplied color is not above its alpha.
          for (int y = 0; y < 5; ++y) {
            for (int i = 0; i < 71 * channels; ++i) {
              auto& value = view.row(y)[i];
              if (alpha == AlphaState::Premultiplied)
                value = std::min(value, view.row(y)[i / channels * channels + channels - 1]);
            }
          }
        });
        const Image twice = invert(invert(source));
        for (int y = 0; y < 5; ++y) {
          EXPECT_EQ(std::memcmp(twice.any().row(y), source.any().row(y), source.info().row_bytes()), 0)
              << describe(source.info());
        }
      }
    }
  }
}

TEST(Invert, LeavesAlphaAlone) { expect_alpha_is_left_alone(negative); }

}  // namespace
}  // namespace azulejo
