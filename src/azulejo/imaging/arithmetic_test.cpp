// What add, subtract, difference, multiply and divide are: one test for all of their values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/add.h"
#include "azulejo/imaging/difference.h"
#include "azulejo/imaging/divide.h"
#include "azulejo/imaging/multiply.h"
#include "azulejo/imaging/subtract.h"

namespace azulejo {
namespace {

Image sum(const Image& a, const Image& b) { return add(a, b); }
Image signed_difference(const Image& a, const Image& b) { return subtract(a, b); }
Image distance(const Image& a, const Image& b) { return difference(a, b); }
Image product(const Image& a, const Image& b) { return multiply(a, b); }
Image quotient(const Image& a, const Image& b) { return divide(a, b); }

using TwoImages = Image (*)(const Image&, const Image&);
using Exact = double (*)(double a, double b);

struct Known {
  const char* name;
  TwoImages operation;
  Exact exact;
  bool real;  ///< gives f32
};
const Known kAll[] = {
    {"add", sum, [](double a, double b) { return a + b; }, false},
    {"subtract", signed_difference, [](double a, double b) { return a - b; }, true},
    {"difference", distance, [](double a, double b) { return std::abs(a - b); }, false},
    {"multiply", product, [](double a, double b) { return a * b; }, false},
    {"divide", quotient, [](double a, double b) { return b == 0 ? 0 : a / b; }, true},
};

double intensity(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) {
    return static_cast<double>(view(x, y, c)) / static_cast<double>(full_range(image.type()));
  });
}

/// Every pair of bytes.
std::pair<Image, Image> every_pair() {
  std::pair<Image, Image> pair{Image(256, 256, 1), Image(256, 256, 1)};
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      pair.first.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(x);
      pair.second.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(y);
    }
  }
  return pair;
}

TEST(Arithmetic, OfEveryPairOfBytesIsTheNearestToTheDefinition) {
  const auto [a, b] = every_pair();
  for (const Known& each : kAll) {
    const Image result = each.operation(a, b);
    ASSERT_EQ(result.type(), each.real ? PixelType::F32 : PixelType::U8);
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        const double exact = each.exact(x / 255.0, y / 255.0);
        if (each.real) {
          // One rounding of the result, after exact integers.
          ASSERT_EQ(result.view<float>()(x, y), static_cast<float>(exact)) << each.name << " " << x << " " << y;
        } else {
          const int whole = static_cast<int>(std::min(exact, 1.0) * 255 + 0.5);
          ASSERT_EQ(result.view<std::uint8_t>()(x, y), whole) << each.name << " " << x << " " << y;
        }
      }
    }
  }
}

TEST(Arithmetic, OfOtherTypesIsTheDefinition) {
  for (const PixelType type : {PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 3}) {
      const unsigned seed = 21;
      SCOPED_TRACE(seed);
      const ImageInfo info{211, 37, channels, type};
      const Image a = random_image(info, seed);
      const Image b = random_image(info, seed + 1);
      for (const Known& each : kAll) {
        const Image result = each.operation(a, b);
        for (int y = 0; y < info.height; ++y) {
          for (int x = 0; x < info.width; ++x) {
            for (int c = 0; c < channels; ++c) {
              const double exact = each.exact(intensity(a, x, y, c), intensity(b, x, y, c));
              const bool whole = type == PixelType::U16 && !each.real;
              const double wanted = whole ? std::floor(std::min(exact, 1.0) * 65535 + 0.5) / 65535 : exact;
              ASSERT_NEAR(intensity(result, x, y, c), wanted, 1e-7 * std::abs(wanted)) << each.name;
            }
          }
        }
      }
    }
  }
}

TEST(Arithmetic, OfExtremeWordsDoesNotOverflow) {
  Image a(256, 256, 1, PixelType::U16);
  Image b(256, 256, 1, PixelType::U16);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      a.view<std::uint16_t>()(x, y) = static_cast<std::uint16_t>(65535 - x);
      b.view<std::uint16_t>()(x, y) = static_cast<std::uint16_t>(y % 2 == 0 ? 65535 - y : 32768 - 64 + y);
    }
  }
  const Image result = multiply(a, b);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const std::uint64_t exact = std::uint64_t{a.view<std::uint16_t>()(x, y)} * b.view<std::uint16_t>()(x, y);
      ASSERT_EQ(result.view<std::uint16_t>()(x, y), (2 * exact + 65535) / (2 * 65535));
    }
  }
}

TEST(Arithmetic, GrayCountsAsAColorOfEqualChannels) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const Image gray = random_image({83, 7, 1, type}, 3);
    const Image color = random_image({83, 7, 3, type}, 4);
    Image equal(color.info());
    visit(equal.any(), [&](auto view) {
      using T = std::remove_pointer_t<decltype(view.data)>;
      for (int y = 0; y < 7; ++y) {
        for (int i = 0; i < 83 * 3; ++i) view.row(y)[i] = gray.view<T>().row(y)[i / 3];
      }
    });
    for (const Known& each : kAll) {
      const Image got[] = {each.operation(gray, color), each.operation(color, gray)};
      const Image wanted[] = {each.operation(equal, color), each.operation(color, equal)};
      for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(got[i].info(), wanted[i].info());
        for (int y = 0; y < 7; ++y) {
          EXPECT_EQ(std::memcmp(got[i].any().row(y), wanted[i].any().row(y), wanted[i].info().row_bytes()), 0)
              << each.name;
        }
      }
    }
  }
}

TEST(Arithmetic, WhatIsSubtractedCanBeAddedAgain) {
  const Image a = random_image({57, 9, 3, PixelType::F32}, 5);
  const Image b = random_image({57, 9, 3, PixelType::F32}, 6);
  const Image back = add(b, subtract(a, b));  // a picture and data
  EXPECT_EQ(back.info().color, ColorState::Srgb);
  for (int y = 0; y < 9; ++y) {
    for (int i = 0; i < 57 * 3; ++i) EXPECT_NEAR(back.view<float>().row(y)[i], a.view<float>().row(y)[i], 1.2e-7F);
  }
}

TEST(Arithmetic, WorksInPlace) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const Image a = random_image({131, 5, 3, type}, 7);
    const Image b = random_image({131, 5, 3, type}, 8);
    const Image expected = difference(a, b);
    Image first = a.clone();
    Image second = b.clone();
    difference(first.any(), b.any(), first.any());
    difference(a.any(), second.any(), second.any());
    for (int y = 0; y < 5; ++y) {
      EXPECT_EQ(std::memcmp(first.any().row(y), expected.any().row(y), expected.info().row_bytes()), 0);
      EXPECT_EQ(std::memcmp(second.any().row(y), expected.any().row(y), expected.info().row_bytes()), 0);
    }
  }
}

/// One pixel of f32 with alpha as given.
Image pixel(std::initializer_list<float> values, AlphaState alpha) {
  Image image(ImageInfo{1, 1, static_cast<int>(values.size()), PixelType::F32, ColorState::Srgb, alpha});
  std::copy(values.begin(), values.end(), image.view<float>().row(0));
  return image;
}

void expect_pixel(const Image& got, std::initializer_list<float> wanted) {
  ASSERT_EQ(got.channels(), static_cast<int>(wanted.size()));
  int c = 0;
  for (const float value : wanted) EXPECT_NEAR(got.view<float>()(0, 0, c++), value, 1e-6F) << c;
}

TEST(Arithmetic, ColorCountsAsFarAsItIsSeen) {
  // Half-seen 0.8, 0.4, 0.2 and quarter-seen 0.4, 0.4, 1.
  const Image a = pixel({0.8F, 0.4F, 0.2F, 0.5F}, AlphaState::Straight);
  const Image b = pixel({0.4F, 0.4F, 1, 0.25F}, AlphaState::Straight);
  expect_pixel(add(a, b), {0.5F / 0.75F, 0.3F / 0.75F, 0.35F / 0.75F, 0.75F});
  expect_pixel(subtract(a, b), {0.3F, 0.1F, -0.15F});
  expect_pixel(difference(a, b), {0.3F, 0.1F, 0.15F});
  expect_pixel(multiply(a, b), {0.8F * 0.85F, 0.4F * 0.85F, 0.2F, 0.5F});
  expect_pixel(divide(a, b), {0.8F / 0.85F, 0.4F / 0.85F, 0.2F, 0.5F});
  // The same, premultiplied.
  const Image c = pixel({0.1F, 0.1F, 0.25F, 0.25F}, AlphaState::Premultiplied);
  expect_pixel(add(a, c), {0.5F / 0.75F, 0.3F / 0.75F, 0.35F / 0.75F, 0.75F});
  expect_pixel(add(c, a), {0.5F, 0.3F, 0.35F, 0.75F});
  expect_pixel(multiply(c, a), {0.1F * 0.9F, 0.1F * 0.7F, 0.25F * 0.6F, 0.25F});
  // Beside an opaque gray.
  const Image gray = pixel({0.5F}, AlphaState::None);
  expect_pixel(add(gray, b), {0.6F, 0.6F, 0.75F, 1});
  expect_pixel(multiply(gray, b), {0.425F, 0.425F, 0.5F});
  expect_pixel(multiply(b, gray), {0.2F, 0.2F, 0.5F, 0.25F});
}

TEST(Arithmetic, HiddenColorsDontBleed) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Image hidden = pixel({nan, 7, -3, 0}, AlphaState::Straight);
  const Image seen = pixel({0.25F, 0.5F, 0.75F, 1}, AlphaState::Straight);
  expect_pixel(add(seen, hidden), {0.25F, 0.5F, 0.75F, 1});
  expect_pixel(add(hidden, seen), {0.25F, 0.5F, 0.75F, 1});
  expect_pixel(difference(seen, hidden), {0.25F, 0.5F, 0.75F});
  expect_pixel(subtract(hidden, seen), {-0.25F, -0.5F, -0.75F});
  expect_pixel(multiply(seen, hidden), {0.25F, 0.5F, 0.75F, 1});
  expect_pixel(divide(seen, hidden), {0.25F, 0.5F, 0.75F, 1});
  expect_pixel(multiply(hidden, seen), {0, 0, 0, 0});
}

TEST(Arithmetic, AnImageAndItselfDifferByNothing) {
  for (const AlphaState alpha : {AlphaState::None, AlphaState::Straight, AlphaState::Premultiplied}) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
      const Image image = random_image({57, 9, 4, type, ColorState::Srgb, alpha}, 9);
      const Image none = difference(image, image);
      EXPECT_EQ(none.channels(), alpha == AlphaState::None ? 4 : 3);
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 57; ++x) {
          for (int c = 0; c < 3; ++c) EXPECT_EQ(intensity(none, x, y, c), 0);
        }
      }
    }
  }
}

TEST(Arithmetic, AQuotientByZeroIsAsAsked) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    Image a(40, 1, 1, type);
    Image b(40, 1, 1, type);
    visit(a.any(), [&](auto view) { std::fill_n(view.row(0), 40, std::remove_pointer_t<decltype(view.data)>{3}); });
    visit(b.any(), [&](auto view) { std::fill_n(view.row(0), 40, std::remove_pointer_t<decltype(view.data)>{0}); });
    EXPECT_EQ(divide(a, b).view<float>()(0, 0), 0.0F);
    EXPECT_EQ(divide(a, b, {.by_zero = -7}).view<float>()(0, 0), -7.0F);
    EXPECT_EQ(divide(a, b, {.by_zero = -7}).view<float>()(39, 0), -7.0F);
    EXPECT_EQ(divide(a, a).view<float>()(39, 0), 1.0F);
  }
  expect_pixel(divide(pixel({0.5F, 0.5F}, AlphaState::Straight), pixel({0}, AlphaState::None), {.by_zero = 2}),
               {2, 0.5F});
}

TEST(Arithmetic, RefusesImagesThatDontFit) {
  const Image image(4, 4, 3);
  for (const Known& each : kAll) {
    EXPECT_THROW(each.operation(image, Image(5, 4, 3)), Error) << each.name;
    EXPECT_THROW(each.operation(image, Image(4, 4, 3, PixelType::U16)), Error) << each.name;
    EXPECT_THROW(each.operation(Image(ImageInfo{4, 4, 2}), image), Error) << each.name;
  }
}

}  // namespace
}  // namespace azulejo
