#include "azulejo/imaging/match_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

Image random_bytes(int width, int height, int channels, double mean, double deviation, unsigned seed) {
  Image image(width, height, channels);
  std::mt19937 random(seed);
  std::normal_distribution<double> value(mean, deviation);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i) {
      image.view<std::uint8_t>().row(y)[i] = static_cast<std::uint8_t>(std::clamp(value(random), 0.0, 255.0));
    }
  }
  return image;
}

std::vector<int> values_of(const Image& image, int channel) {
  std::vector<int> values;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) values.push_back(image.view<std::uint8_t>()(x, y, channel));
  }
  return values;
}

/// The definition, on plain lists of values.
std::vector<int> matched(const std::vector<int>& source, const std::vector<int>& reference) {
  std::vector<int> result;
  std::vector<int> sorted = reference;
  std::sort(sorted.begin(), sorted.end());
  for (const int v : source) {
    const auto below = std::count_if(source.begin(), source.end(), [&](int w) { return w < v; });
    const auto same = std::count(source.begin(), source.end(), v);
    // The smallest z with as many values up to it: that of this rank, counted from 1.
    const long twice = 2 * below + same;
    const long n = static_cast<long>(source.size());
    const long rank = (twice * static_cast<long>(reference.size()) + 2 * n - 1) / (2 * n);
    result.push_back(sorted[static_cast<std::size_t>(rank - 1)]);
  }
  return result;
}

TEST(MatchHistogram, FollowsTheDefinitionPerChannel) {
  for (const unsigned seed : {1U, 2U}) {
    SCOPED_TRACE(seed);
    const Image source = random_bytes(41, 31, 3, 60, 20, seed);
    const Image reference = random_bytes(57, 17, 3, 150, 45, seed + 10);
    const Image result = match_histogram(source, reference);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(values_of(result, c), matched(values_of(source, c), values_of(reference, c)));
  }
}

TEST(MatchHistogram, WithOneTableItPoolsTheChannels) {
  const Image source = random_bytes(41, 31, 3, 60, 20, 3);
  const Image reference = random_bytes(57, 17, 3, 150, 45, 4);
  const Image result = match_histogram(source, reference, {.per_channel = false});
  std::vector<int> pooled, pooled_reference, got;
  for (int c = 0; c < 3; ++c) {
    const auto append = [](std::vector<int>& to, const std::vector<int>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(pooled, values_of(source, c));
    append(pooled_reference, values_of(reference, c));
    append(got, values_of(result, c));
  }
  EXPECT_EQ(got, matched(pooled, pooled_reference));
}

TEST(MatchHistogram, WithItselfIsTheImage) {
  const Image bytes = random_bytes(83, 61, 3, 120, 60, 5);
  const Image same = match_histogram(bytes, bytes);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(values_of(same, c), values_of(bytes, c));
  Image floats(300, 20, 1, PixelType::F32);
  std::mt19937 random(6);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 300; ++x) floats.view<float>()(x, y) = static_cast<float>(random() % 100'000) / 100'000;
  }
  const Image near = match_histogram(floats, floats);
  for (int y = 0; y < 20; ++y) {
    // Half a bin, and the rounding of a quotient.
    for (int x = 0; x < 300; ++x) ASSERT_NEAR(near.view<float>()(x, y), floats.view<float>()(x, y), 0.5 / 65535 + 6e-8);
  }
}

TEST(MatchHistogram, TakesTheDistributionOver) {
  // Of a source without ties, the result's sorted values are the reference's, evenly picked.
  Image source(256, 1, 1, PixelType::U16);
  Image reference(64, 4, 1, PixelType::U16);
  std::mt19937 random(7);
  std::vector<std::uint16_t> wanted;
  for (int x = 0; x < 256; ++x) {
    source.view<std::uint16_t>()(x, 0) = static_cast<std::uint16_t>((x * 77 % 256) * 200);
    reference.view<std::uint16_t>()(x % 64, x / 64) = static_cast<std::uint16_t>(random());
    wanted.push_back(reference.view<std::uint16_t>()(x % 64, x / 64));
  }
  std::sort(wanted.begin(), wanted.end());
  const Image result = match_histogram(source, reference);
  for (int x = 0; x < 256; ++x) {
    EXPECT_EQ(result.view<std::uint16_t>()(x, 0), wanted[static_cast<std::size_t>(x * 77 % 256)]);
  }
}

TEST(MatchHistogram, OnlyValuesOfTheReferenceOccur) {
  const Image source = random_bytes(100, 100, 1, 90, 30, 8);
  Image mask(7, 1, 1);
  for (int x = 0; x < 7; ++x) mask.view<std::uint8_t>()(x, 0) = x < 3 ? 40 : 200;
  const std::vector<int> result = values_of(match_histogram(source, mask), 0);
  const auto dark = std::count(result.begin(), result.end(), 40);
  EXPECT_EQ(dark + std::count(result.begin(), result.end(), 200), 10000);
  EXPECT_NEAR(static_cast<double>(dark), 10000 * 3.0 / 7, 150);  // within the most frequent value's count
}

TEST(MatchHistogram, NothingVisibleChangesNothing) {
  Image source = random_bytes(20, 20, 4, 90, 30, 9);
  Image reference = random_bytes(20, 20, 4, 190, 30, 10);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      source.view<std::uint8_t>()(x, y, 3) = 255;
      reference.view<std::uint8_t>()(x, y, 3) = 0;
    }
  }
  const Image result = match_histogram(source, reference);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(values_of(result, c), values_of(source, c));
}

TEST(MatchHistogram, RefusesAReferenceOfAnotherKind) {
  EXPECT_THROW(match_histogram(Image(4, 4, 3), Image(4, 4, 1)), Error);
  EXPECT_THROW(match_histogram(Image(4, 4, 1), Image(4, 4, 1, PixelType::U16)), Error);
}

}  // namespace
}  // namespace azulejo
