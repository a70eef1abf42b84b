#include "azulejo/imaging/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

/// The definitions, from all values sorted.
void expect_definition(const ChannelStatistics& found, std::vector<double> values, const StatisticsOptions& options,
                       double percentile_error) {
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  long double sum = 0;
  for (const double value : values) sum += value;
  const long double mean = sum / count;
  long double squares = 0;
  std::vector<double> steps(256, 0);
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
    steps[std::min<std::size_t>(255, static_cast<std::size_t>(std::clamp(value, 0.0, 1.0) * 256))] += 1 / count;
  }
  double entropy = 0;
  for (const double share : steps) entropy -= share > 0 ? share * std::log2(share) : 0;
  EXPECT_EQ(found.count, static_cast<std::int64_t>(values.size()));
  EXPECT_NEAR(found.minimum, values.front(), 1e-15);
  EXPECT_NEAR(found.maximum, values.back(), 1e-15);
  EXPECT_NEAR(found.mean, static_cast<double>(mean), 1e-13);
  EXPECT_NEAR(found.standard_deviation, std::sqrt(static_cast<double>(squares) / count), 1e-9);
  EXPECT_NEAR(found.entropy, entropy, 1e-9);
  for (std::size_t p = 0; p < options.percentiles.size(); ++p) {
    const double place = std::max(1.0, std::ceil(double{options.percentiles[p]} / 100 * count));
    const double expected = values[static_cast<std::size_t>(place) - 1];
    EXPECT_NEAR(found.percentiles[p], expected, percentile_error * std::fabs(expected) + 1e-15)
        << options.percentiles[p];
  }
}

TEST(Statistics, AreTheirDefinitions) {
  const StatisticsOptions options{{0, 1, 12.5F, 50, 99, 100}};
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const ImageInfo info{37, 41, 3, type};
    const Image image = random_image(info, 3);
    const Statistics found = statistics(image, options);
    ASSERT_EQ(found.channels.size(), 3U);
    EXPECT_EQ(found.channels[1].name, "green");
    std::vector<double> all;
    for (int c = 0; c < 3; ++c) {
      std::vector<double> values;
      visit(image.any(), [&](auto view) {
        for (int y = 0; y < 41; ++y) {
          for (int x = 0; x < 37; ++x) values.push_back(static_cast<double>(view(x, y, c)) / full_range(type));
        }
      });
      // A bin of f32 is 2⁻⁷ of the value at most wide; its middle is meant.
      expect_definition(found.channels[static_cast<std::size_t>(c)], values, options,
                        type == PixelType::F32 ? 0.004 : 0);
      all.insert(all.end(), values.begin(), values.end());
    }
    expect_definition(found.all, all, options, type == PixelType::F32 ? 0.004 : 0);
  }
}

TEST(Statistics, KeepASmallDeviationFromALargeMean) {
  Image image(ImageInfo{1000, 1, 1, PixelType::F32});
  for (int x = 0; x < 1000; ++x) image.view<float>()(x, 0) = x % 2 == 0 ? 4096.0F : 4096.0F + 1.0F / 1024;
  const Statistics found = statistics(image);
  EXPECT_EQ(found.all.mean, 4096 + 1.0 / 2048);
  EXPECT_NEAR(found.all.standard_deviation, 1.0 / 2048, 1e-9);
}

TEST(Statistics, OfTheLargestFloats) {
  Image image(ImageInfo{4, 1, 1, PixelType::F32});
  const float largest = std::numeric_limits<float>::max();
  const float values[] = {largest, -largest, largest, -largest};
  std::copy_n(values, 4, image.view<float>().row(0));
  const Statistics found = statistics(image);
  EXPECT_EQ(found.all.mean, 0);
  EXPECT_NEAR(found.all.standard_deviation / double{largest}, 1, 1e-14);
}

TEST(Statistics, LeaveOutWhatCantBeSeenOrIsNoNumber) {
  Image image(ImageInfo{4, 1, 2, PixelType::F32, ColorState::Srgb, AlphaState::Premultiplied});
  const float values[] = {0.25F, 0.5F, 0.9F, 0, std::numeric_limits<float>::quiet_NaN(), 1, -2, 1};
  std::copy_n(values, 8, image.view<float>().row(0));
  const Statistics found = statistics(image);
  EXPECT_EQ(found.all.count, 2);
  EXPECT_EQ(found.all.not_finite, 1);
  EXPECT_EQ(found.all.minimum, -2);
  EXPECT_EQ(found.all.maximum, 0.5);
  Image clear(3, 3, 4);
  for (int y = 0; y < 3; ++y) std::fill_n(clear.view<std::uint8_t>().row(y), 12, std::uint8_t{0});
  EXPECT_EQ(statistics(clear).all.count, 0);
  EXPECT_EQ(statistics(clear).all.mean, 0);
}

TEST(Statistics, OfEveryByteOnce) {
  Image image(256, 1, 1);
  for (int v = 0; v < 256; ++v) image.view<std::uint8_t>()(v, 0) = static_cast<std::uint8_t>(v);
  const Statistics found = statistics(image, {{50}});
  EXPECT_EQ(found.all.mean, 0.5);
  EXPECT_DOUBLE_EQ(found.all.standard_deviation, std::sqrt((256.0 * 256 - 1) / 12) / 255);
  EXPECT_DOUBLE_EQ(found.all.entropy, 8);
  EXPECT_DOUBLE_EQ(found.all.percentiles[0], 127.0 / 255);
  EXPECT_EQ(to_json(found, {{50}})["all"]["percentiles"]["50"].number(), 127.0 / 255);
  EXPECT_THROW(statistics(image, {{101}}), Error);
}

}  // namespace
}  // namespace azulejo
