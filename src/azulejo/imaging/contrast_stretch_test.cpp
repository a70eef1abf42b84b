#include "azulejo/imaging/contrast_stretch.h"

#include <map>
#include <random>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/engine/stages.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

/// Values around a middle gray, as of a dull photograph.
Image dull(const ImageInfo& info, unsigned seed) {
  Image image(info);
  std::mt19937 random(seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    const float top = full_range(info.type);
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        const float center = 0.3F + 0.1F * static_cast<float>(i % view.channels);
        view.row(y)[i] =
            static_cast<T>(std::clamp(std::normal_distribution<float>(center, 0.08F)(random), 0.0F, 1.0F) * top);
      }
    }
  });
  return image;
}

/// The values of a channel, or of all, in order.
template <class T>
std::vector<T> sorted_values(const Image& image, int channel) {
  std::vector<T> values;
  for (int y = 0; y < image.height(); ++y) {
    for (int i = 0; i < image.width() * image.channels(); ++i) {
      if (channel < 0 || i % image.channels() == channel) values.push_back(image.view<T>().row(y)[i]);
    }
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// Each value by the definition, from sorted lists.
template <class T>
void expect_stretched(const Image& source, const ContrastStretchOptions& options, double tolerance) {
  const Image result = contrast_stretch(source, options);
  const double top = static_cast<double>(full_range(kPixelTypeOf<T>));
  for (int c = 0; c < source.channels(); ++c) {
    const std::vector<T> values = sorted_values<T>(source, options.per_channel ? c : -1);
    const auto n = static_cast<double>(values.size());
    // More than the share of all are up to the value, and more than the rest's share from it on.
    const auto black =
        static_cast<double>(values[static_cast<std::size_t>(n * static_cast<double>(options.low) / 100)]);
    const auto white = static_cast<double>(
        values[values.size() - 1 - static_cast<std::size_t>(n * (1 - static_cast<double>(options.high) / 100))]);
    for (int y = 0; y < source.height(); ++y) {
      for (int x = 0; x < source.width(); ++x) {
        const auto v = static_cast<double>(source.view<T>()(x, y, c));
        const double exact = std::clamp((v - black) / (white - black), 0.0, 1.0) * top;
        ASSERT_NEAR(static_cast<double>(result.view<T>()(x, y, c)), exact, tolerance)
            << v << " " << black << " " << white;
      }
    }
  }
}

TEST(ContrastStretch, FollowsTheDefinition) {
  for (const unsigned seed : {1U, 2U}) {
    SCOPED_TRACE(seed);
    for (const int channels : {1, 3}) {
      for (const bool per_channel : {false, true}) {
        for (const auto& [low, high] : {std::pair{0.0F, 100.0F}, {1.0F, 99.0F}, {10.0F, 75.0F}}) {
          const ContrastStretchOptions options{.low = low, .high = high, .per_channel = per_channel};
          // Rounding, and what f32 is off by.
          expect_stretched<std::uint8_t>(dull({97, 41, channels, PixelType::U8}, seed), options, 0.5001);
          expect_stretched<std::uint16_t>(dull({97, 41, channels, PixelType::U16}, seed), options, 0.55);
          // The percentiles of f32 are off by half a bin, of a range of 1/6 at least.
          expect_stretched<float>(dull({97, 41, channels, PixelType::F32}, seed), options, 6.0 / 65535);
        }
      }
    }
  }
}

TEST(ContrastStretch, UsesTheWholeRangeAndOnceIsEnough) {
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    const Image once = contrast_stretch(dull({97, 41, 1, type}, 3));
    const Image twice = contrast_stretch(once, {.low = 0, .high = 100});
    visit(once.any(), [&](auto view) {
      using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
      const auto values = sorted_values<T>(once, -1);
      EXPECT_EQ(values.front(), 0);
      EXPECT_EQ(values.back(), std::numeric_limits<T>::max());
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) ASSERT_EQ(twice.any().as<T>()(x, y), view(x, y));
      }
    });
  }
}

TEST(ContrastStretch, AConstantImageStaysAsItIs) {
  for (const float value : {0.0F, 0.25F, -3.0F, 7.0F}) {
    EXPECT_EQ(of_one([](const Image& source) { return contrast_stretch(source); }, value), value);
  }
  EXPECT_TRUE(std::isnan(of_one([](const Image& source) { return contrast_stretch(source); }, kNaN)));
}

TEST(ContrastStretch, TransparentPixelsAreNotCounted) {
  Image source(3, 1, 2);
  const std::uint8_t values[] = {100, 255, 0, 0, 120, 7};
  std::copy_n(values, 6, source.view<std::uint8_t>().row(0));
  const Image result = contrast_stretch(source, {.low = 0, .high = 100});
  const std::uint8_t expected[] = {0, 255, 0, 0, 255, 7};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(result.view<std::uint8_t>().row(0)[i], expected[i]) << i;
}

TEST(ContrastStretch, ShowsWhatBecomesBlackAndWhite) {
  struct Seen final : Stages {
    void image(const std::string&, const std::string&, const Image&) override {}
    void report(const std::string&, const std::string& name, const Json& report) override { reports[name] = report; }
    std::map<std::string, Json> reports;
  } seen;
  Image source(52, 1, 1);
  for (int x = 0; x < 52; ++x) source.view<std::uint8_t>()(x, 0) = static_cast<std::uint8_t>(51 + x);
  contrast_stretch(source, {.low = 0, .high = 100}, {.stages = &seen});
  EXPECT_EQ(seen.reports["levels"]["black"].number(), 0.2);
  EXPECT_EQ(seen.reports["levels"]["white"].number(), 0.4);
  EXPECT_EQ(seen.reports["histogram_before"]["counts"][std::size_t{60}].number(), 1);
}

TEST(ContrastStretch, RefusesPercentilesInTheWrongOrder) {
  const Image source(1, 1, 1);
  EXPECT_THROW(contrast_stretch(source, {.low = 99}), Error);
  EXPECT_THROW(contrast_stretch(source, {.low = -1}), Error);
  EXPECT_THROW(contrast_stretch(source, {.high = 101}), Error);
}

}  // namespace
}  // namespace azulejo
