#include "azulejo/imaging/equalize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "azulejo/engine/stages.h"

namespace azulejo {
namespace {

/// Bytes around 90, as of a dull photograph.
Image dull(int width, int height, int channels, unsigned seed) {
  Image image(width, height, channels);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(90, 20);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i) {
      image.view<std::uint8_t>().row(y)[i] = static_cast<std::uint8_t>(std::clamp(normal(random), 0.0F, 255.0F));
    }
  }
  return image;
}

std::vector<int> bytes_of(const Image& image) {
  std::vector<int> values;
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* const row = image.view<std::uint8_t>().row(y);
    values.insert(values.end(), row, row + image.width() * image.channels());
  }
  return values;
}

/// The definition, on plain lists.
std::vector<int> equalized(const std::vector<int>& values) {
  const int lowest = *std::min_element(values.begin(), values.end());
  const auto up_to = [&](int v) { return std::count_if(values.begin(), values.end(), [&](int w) { return w <= v; }); };
  const auto first = static_cast<double>(up_to(lowest));
  const double others = static_cast<double>(values.size()) - first;
  std::map<int, int> table;
  for (int v = 0; v < 256; ++v) {
    table[v] = static_cast<int>(std::floor((static_cast<double>(up_to(v)) - first) / others * 255 + 0.5));
  }
  std::vector<int> result;
  for (const int v : values) result.push_back(table[v]);
  return result;
}

TEST(Equalize, FollowsTheDefinition) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    const Image gray = dull(97, 31, 1, seed);
    EXPECT_EQ(bytes_of(equalize(gray)), equalized(bytes_of(gray)));
    const Image colors = dull(97, 31, 3, seed);
    EXPECT_EQ(bytes_of(equalize(colors)), equalized(bytes_of(colors)));
  }
}

TEST(Equalize, PerChannelIsEachChannelByItself) {
  const Image colors = dull(97, 31, 3, 4);
  const std::vector<int> together = bytes_of(colors);
  const std::vector<int> got = bytes_of(equalize(colors, {.per_channel = true}));
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<int> values, mine;
    for (std::size_t i = c; i < together.size(); i += 3) {
      values.push_back(together[i]);
      mine.push_back(got[i]);
    }
    EXPECT_EQ(mine, equalized(values)) << c;
  }
}

TEST(Equalize, ARampOfAnyStretchBecomesTheWholeRamp) {
  // 52 values, five apart in the result: closed form.
  Image source(52, 3, 1);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 52; ++x) source.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(100 + x);
  }
  const Image result = equalize(source);
  for (int x = 0; x < 52; ++x) EXPECT_EQ(result.view<std::uint8_t>()(x, 1), 5 * x);
}

TEST(Equalize, AWholeRampStaysAsItIsIn16BitsAndFloats) {
  Image wide(65536, 1, 1, PixelType::U16);
  Image real(65536, 1, 1, PixelType::F32);
  for (int x = 0; x < 65536; ++x) {
    wide.view<std::uint16_t>()(x, 0) = static_cast<std::uint16_t>(x);
    real.view<float>()(x, 0) = static_cast<float>(x) / 65535.0F;
  }
  const Image wide_result = equalize(wide);
  const Image real_result = equalize(real);
  for (int x = 0; x < 65536; ++x) {
    ASSERT_EQ(wide_result.view<std::uint16_t>()(x, 0), x);
    ASSERT_EQ(real_result.view<float>()(x, 0), static_cast<float>(x) / 65535.0F);
  }
}

TEST(Equalize, IsMonotoneAndUsesTheWholeRange) {
  const std::vector<int> before = bytes_of(dull(211, 50, 1, 5));
  const std::vector<int> after = bytes_of(equalize(dull(211, 50, 1, 5)));
  std::map<int, int> table;
  for (std::size_t i = 0; i < before.size(); ++i) table[before[i]] = after[i];
  EXPECT_EQ(table.begin()->second, 0);
  EXPECT_EQ(table.rbegin()->second, 255);
  for (auto next = std::next(table.begin()); next != table.end(); ++next) {
    EXPECT_GE(next->second, std::prev(next)->second);
  }
}

TEST(Equalize, TwiceIsWithinALevelOfOnce) {
  for (const unsigned seed : {6U, 7U}) {
    SCOPED_TRACE(seed);
    const Image once = equalize(dull(211, 50, 1, seed));
    const std::vector<int> a = bytes_of(once);
    const std::vector<int> b = bytes_of(equalize(once));
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1);
  }
}

TEST(Equalize, DoesNotCareWherePixelsAre) {
  const Image source = dull(128, 64, 1, 8);
  Image turned(64, 128, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) turned.view<std::uint8_t>()(y, x) = source.view<std::uint8_t>()(x, y);
  }
  const Image a = equalize(source);
  const Image b = equalize(turned);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) ASSERT_EQ(a.view<std::uint8_t>()(x, y), b.view<std::uint8_t>()(y, x));
  }
}

TEST(Equalize, AConstantImageStaysAsItIs) {
  for (const float value : {0.25F, -3.0F}) {
    Image source(9, 7, 3, PixelType::F32);
    for (int y = 0; y < 7; ++y) std::fill_n(source.view<float>().row(y), 27, value);
    EXPECT_EQ(equalize(source).view<float>()(8, 6, 2), value);
  }
  Image bytes(9, 7, 1);
  for (int y = 0; y < 7; ++y) std::fill_n(bytes.view<std::uint8_t>().row(y), 9, std::uint8_t{77});
  EXPECT_EQ(equalize(bytes).view<std::uint8_t>()(8, 6), 77);
}

TEST(Equalize, TransparentPixelsAreNotCountedAndAlphaIsCopied) {
  // Two visible values and an invisible one between them, which would have moved them.
  Image source(3, 1, 2);
  const std::uint8_t values[] = {100, 255, 110, 0, 120, 7};
  std::copy_n(values, 6, source.view<std::uint8_t>().row(0));
  EXPECT_EQ(bytes_of(equalize(source)), (std::vector<int>{0, 255, 0, 0, 255, 7}));
}

TEST(Equalize, PremultipliedColorIsEqualizedAsTheColorThatItIs) {
  Image straight(4, 1, 4, PixelType::F32);
  Image premultiplied(4, 1, 4, PixelType::F32);
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  for (int x = 0; x < 4; ++x) {
    const float alpha = x == 3 ? 0.0F : 1.0F / static_cast<float>(1 << x);
    for (int c = 0; c < 4; ++c) {
      const float color = static_cast<float>(x * 3 + c) / 16;
      straight.view<float>()(x, 0, c) = c == 3 ? alpha : color;
      premultiplied.view<float>()(x, 0, c) = c == 3 ? alpha : color * alpha;
    }
  }
  const Image a = equalize(straight);
  const Image b = equalize(premultiplied);
  for (int x = 0; x < 4; ++x) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(b.view<float>()(x, 0, c), a.view<float>()(x, 0, c) * b.view<float>()(x, 0, 3)) << x << c;
    }
  }
}

TEST(Equalize, NaNStaysNaNAndIsNotCounted) {
  Image source(4, 1, 1, PixelType::F32);
  const float values[] = {0.2F, std::numeric_limits<float>::quiet_NaN(), 0.3F, 9.0F};
  std::copy_n(values, 4, source.view<float>().row(0));
  const Image result = equalize(source);
  EXPECT_EQ(result.view<float>()(0, 0), 0.0F);
  EXPECT_TRUE(std::isnan(result.view<float>()(1, 0)));
  EXPECT_EQ(result.view<float>()(2, 0), 0.5F);
  EXPECT_EQ(result.view<float>()(3, 0), 1.0F);
}

TEST(Equalize, ShowsItsHistogramsAndItsTable) {
  struct Seen final : Stages {
    void image(const std::string&, const std::string& name, const Image& image) override {
      images[name] = image.info();
    }
    void report(const std::string&, const std::string& name, const Json& report) override { reports[name] = report; }
    std::map<std::string, ImageInfo> images;
    std::map<std::string, Json> reports;
  } seen;
  const Image source = dull(211, 50, 1, 9);
  equalize(source, {}, {.stages = &seen});
  for (const char* name : {"histogram_before", "mapping", "histogram_after"}) {
    EXPECT_EQ(seen.images[name].width, 256) << name;
  }
  const Image result = equalize(source);
  const std::vector<int> before = bytes_of(source);
  const std::vector<int> after = bytes_of(result);
  for (int v = 0; v < 256; ++v) {
    const auto index = static_cast<std::size_t>(v);
    EXPECT_EQ(seen.reports["histogram_before"]["counts"][index].number(), std::count(before.begin(), before.end(), v));
    EXPECT_EQ(seen.reports["histogram_after"]["counts"][index].number(), std::count(after.begin(), after.end(), v));
  }
}

}  // namespace
}  // namespace azulejo
