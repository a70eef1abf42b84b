#include "azulejo/imaging/crop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

/// Whether `part` is the part of `whole` at (left, top).
void expect_part(const Image& part, const Image& whole, const Rect& rect) {
  ASSERT_EQ(part.width(), rect.width);
  ASSERT_EQ(part.height(), rect.height);
  ASSERT_EQ(part.type(), whole.type());
  const ConstAnyView wanted = whole.any().crop(rect);
  for (int y = 0; y < rect.height; ++y) {
    EXPECT_EQ(std::memcmp(part.any().row(y), wanted.row(y), part.info().row_bytes()), 0) << y;
  }
}

TEST(Crop, TakesThePart) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 2, 3, 4}) {
      const Image whole = random_image({41, 23, channels, type}, 1);
      expect_part(crop(whole, {.rect = {{5, 3, 17, 20}}}), whole, {5, 3, 17, 20});
      expect_part(crop(whole, {.rect = {{40, 22, 1, 1}}}), whole, {40, 22, 1, 1});
      expect_part(crop(whole), whole, {0, 0, 41, 23});
    }
  }
}

TEST(Crop, EdgesAreTheNearestBetweenPixels) {
  const Image whole = random_image({40, 20, 1}, 2);
  expect_part(crop(whole, {.rect = {{0.25F, 0.5F, 0.5F, 0.5F}}, .unit = LengthUnit::Fractions}), whole,
              {10, 10, 20, 10});
  // From 4.4 to 9.6, from 2.5 to 7.4.
  expect_part(crop(whole, {.rect = {{4.4F, 2.5F, 5.2F, 4.9F}}}), whole, {4, 3, 6, 4});
  // Thirds that lie side by side have no gap and no pixel twice.
  int right = 0;
  for (int i = 0; i < 3; ++i) {
    const float third = 1.0F / 3;
    const Image part =
        crop(whole, {.rect = {{static_cast<float>(i) * third, 0, third, 1}}, .unit = LengthUnit::Fractions});
    expect_part(part, whole, {right, 0, part.width(), 20});
    right += part.width();
  }
  EXPECT_EQ(right, 40);
}

TEST(Crop, AnchorsPlaceASize) {
  const Image whole = random_image({11, 8, 1}, 3);
  const std::pair<Anchor, Rect> places[] = {
      {Anchor::TopLeft, {0, 0, 4, 3}},    {Anchor::Top, {3, 0, 4, 3}},    {Anchor::TopRight, {7, 0, 4, 3}},
      {Anchor::Left, {0, 2, 4, 3}},       {Anchor::Center, {3, 2, 4, 3}}, {Anchor::Right, {7, 2, 4, 3}},
      {Anchor::BottomLeft, {0, 5, 4, 3}}, {Anchor::Bottom, {3, 5, 4, 3}}, {Anchor::BottomRight, {7, 5, 4, 3}}};
  for (const auto& [anchor, rect] : places) {
    expect_part(crop(whole, {.size = {{4, 3}}, .anchor = anchor}), whole, rect);
  }
}

TEST(Crop, RefusesWhatIsNoPart) {
  const Image whole(10, 10, 1);
  EXPECT_THROW(crop(whole, {.rect = {{5, 5, 6, 1}}}), Error);
  EXPECT_THROW(crop(whole, {.rect = {{5, 5, 0, 1}}}), Error);
  EXPECT_THROW(crop(whole, {.rect = {{-1, 0, 5, 5}}}), Error);
  EXPECT_THROW(crop(whole, {.rect = {{0, 0, std::nanf(""), 5}}}), Error);
  EXPECT_THROW(crop(whole, {.size = {{11, 5}}}), Error);
  EXPECT_THROW(crop(whole, {.rect = {{0, 0, 5, 5}}, .size = {{5, 5}}}), Error);
}

}  // namespace
}  // namespace azulejo
