#include "azulejo/imaging/pad.h"

#include <gtest/gtest.h>

#include <cstring>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/crop.h"

namespace azulejo {
namespace {

TEST(Pad, FollowsTheBorderRule) {
  for (const Border border : {Border::Mirror, Border::Reflect, Border::Clamp, Border::Wrap}) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
      for (const int channels : {1, 3, 4}) {
        const Image source = random_image({7, 5, channels, type}, 1);
        const Image result = pad(source, {.left = 20, .right = 3, .top = 1, .bottom = 12, .border = border});
        ASSERT_EQ(result.width(), 30);
        ASSERT_EQ(result.height(), 18);
        visit(result.any(), [&](auto view) {
          using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
          for (int y = 0; y < 18; ++y) {
            for (int x = 0; x < 30; ++x) {
              for (int c = 0; c < channels; ++c) {
                ASSERT_EQ(view(x, y, c),
                          source.view<T>()(border_index(x - 20, 7, border), border_index(y - 1, 5, border), c));
              }
            }
          }
        });
      }
    }
  }
}

std::vector<int> corner(const ImageInfo& info, std::optional<Color> color) {
  Image source(info);
  visit(source.any(), [&](auto view) {
    for (int i = 0; i < view.channels; ++i) view.row(0)[i] = 1;
  });
  const Image result = pad(source, {.left = 1, .bottom = 2, .color = color});
  std::vector<int> values;
  visit(result.any(), [&](auto view) {
    for (int c = 0; c < view.channels; ++c) {
      EXPECT_EQ(view(0, 2, c), view(0, 0, c));  // every pixel outside is the same
      EXPECT_EQ(view(1, 1, c), view(0, 0, c));
      EXPECT_EQ(view(1, 0, c), 1);
      values.push_back(static_cast<int>(view(0, 0, c) * 255 / full_range(info.type) + 0.5F));
    }
  });
  return values;
}

TEST(Pad, ColorsAreStoredAsTheImageStoresThem) {
  const Color color{1, 0.4F, 0.2F, 0.5F};
  const auto kind = [](int channels, PixelType type, ColorState state, AlphaState alpha) {
    return ImageInfo{1, 1, channels, type, state, alpha};
  };
  using Values = std::vector<int>;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    EXPECT_EQ(corner(kind(4, type, ColorState::Srgb, AlphaState::Straight), color), (Values{255, 102, 51, 128}));
    EXPECT_EQ(corner(kind(4, type, ColorState::Srgb, AlphaState::Premultiplied), color), (Values{128, 51, 26, 128}));
    EXPECT_EQ(corner(kind(3, type, ColorState::Srgb, AlphaState::None), color), (Values{128, 51, 26}));
    EXPECT_EQ(corner(kind(3, type, ColorState::Srgb, AlphaState::None), Color{1, 0.4F, 0.2F, 1}),
              (Values{255, 102, 51}));
    // 0.299 + 0.587 · 0.4 + 0.114 · 0.2 = 0.5566; as light 0.2703.
    EXPECT_EQ(corner(kind(1, type, ColorState::Srgb, AlphaState::None), Color{1, 0.4F, 0.2F, 1}), (Values{142}));
    EXPECT_EQ(corner(kind(1, type, ColorState::Linear, AlphaState::None), Color{1, 0.4F, 0.2F, 1}), (Values{69}));
    EXPECT_EQ(corner(kind(2, type, ColorState::Srgb, AlphaState::Straight), {}), (Values{0, 0}));
    EXPECT_EQ(corner(kind(3, type, ColorState::Srgb, AlphaState::None), {}), (Values{0, 0, 0}));
    // 0.4 as light is 0.1329, 0.2 is 0.0331.
    EXPECT_EQ(corner(kind(3, type, ColorState::Linear, AlphaState::None), Color{1, 0.4F, 0.2F, 1}),
              (Values{255, 34, 8}));
  }
}

TEST(Pad, AnchorsPlaceTheImageAndCropGivesItBack) {
  const Image source = random_image({5, 4, 3}, 2);
  for (int a = 0; a < 9; ++a) {
    const auto anchor = static_cast<Anchor>(a);
    const Image result = pad(source, {.size = {{12, 7}}, .anchor = anchor, .border = Border::Wrap});
    const Image back = crop(result, {.size = {{5, 4}}, .anchor = anchor});
    for (int y = 0; y < 4; ++y) {
      EXPECT_EQ(std::memcmp(back.any().row(y), source.any().row(y), source.info().row_bytes()), 0) << a;
    }
  }
}

TEST(Pad, ByNothingIsTheSource) {
  const Image source = random_image({5, 4, 2, PixelType::U16}, 3);
  const Image same = pad(source);
  ASSERT_EQ(same.info(), source.info());
  for (int y = 0; y < 4; ++y)
    EXPECT_EQ(std::memcmp(same.any().row(y), source.any().row(y), source.info().row_bytes()), 0);
}

TEST(Pad, RefusesSizesThatDontHoldTheImage) {
  const Image source(10, 10, 1);
  EXPECT_THROW(pad(source, {.left = -1}), Error);
  EXPECT_THROW(pad(source, {.size = {{9, 20}}}), Error);
  EXPECT_THROW(pad(source, {.size = {{20.5F, 20}}}), Error);
  EXPECT_THROW(pad(source, {.left = 1, .size = {{20, 20}}}), Error);
}

}  // namespace
}  // namespace azulejo
