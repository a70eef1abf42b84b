#include "azulejo/imaging/exposure.h"

#include <array>
#include <map>

#include "azulejo/core/error.h"
#include "azulejo/engine/stages.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

double decoded(double v) {
  const double x = std::abs(v);
  return std::copysign(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4), v);
}
double encoded(double light) {
  const double x = std::abs(light);
  return std::copysign(x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055, light);
}

PointOperation with(float stops) {
  return [stops](const Image& source) { return exposure(source, {.stops = stops}); };
}

TEST(Exposure, MultipliesTheLightOfSrgb) {
  for (const float stops : {-4.0F, -0.3F, 0.0F, 1.0F, 2.5F}) {
    const auto exact = [&](double v) { return encoded(decoded(v) * std::exp2(static_cast<double>(stops))); };
    // Both curves are within 10⁻⁶; so is the power. At their joints the two parts differ by 3·10⁻⁸.
    expect_rounded(with(stops), exact, PixelType::U8, 1e-3);
    expect_rounded(with(stops), exact, PixelType::U16, 0.2);
    expect_real(with(stops), exact, 1e-7, 3e-6);
  }
  EXPECT_TRUE(std::isnan(of_one(with(1), kNaN)));
}

TEST(Exposure, MultipliesLinearValuesAsTheyAre) {
  const auto linear = [](const Image& source) {
    Image copy = source.clone();
    copy.set_states(ColorState::Linear, AlphaState::None);
    return exposure(copy, {.stops = 1.5F});
  };
  const auto exact = [](double v) { return v * std::exp2(1.5); };
  expect_rounded(linear, exact, PixelType::U16, 0.05);
  expect_real(linear, exact, 0, 4e-7);
}

TEST(Exposure, ThereAndBackIsTheSourceWhereNothingWasClipped) {
  const Image source = every_value(PixelType::U16);
  const Image back = exposure(exposure(source, {.stops = -1}), {.stops = 1});
  // A rounding to half a level, times the derivative of the way back: 2 at most.
  for (int x = 0; x < 65536; ++x) EXPECT_NEAR(back.view<std::uint16_t>()(x, 0), x, 2) << x;
}

TEST(Exposure, LeavesAlphaAlone) { expect_alpha_is_left_alone(with(0.8F)); }

std::array<std::uint64_t, 256> counts_of(std::initializer_list<std::pair<int, std::uint64_t>> values) {
  std::array<std::uint64_t, 256> counts{};
  for (const auto& [value, count] : values) counts[static_cast<std::size_t>(value)] = count;
  return counts;
}

TEST(Exposure, JudgesHistograms) {
  // Light of 46 is 0.0273, of 118 0.181: 2.72 stops from middle gray, and white 2.49 stops from 120.
  const auto dark = counts_of({{10, 40}, {46, 50}, {120, 10}});
  const ExposureVerdict under = judge_exposure(dark, ColorState::Srgb);
  EXPECT_EQ(under.exposure, Exposure::Under);
  EXPECT_EQ(under.contrast, Contrast::Low);
  EXPECT_EQ(under.low, 10 / 255.0F);
  EXPECT_EQ(under.median, 46 / 255.0F);
  EXPECT_EQ(under.high, 120 / 255.0F);
  EXPECT_NEAR(under.stops, -std::log2(decoded(120 / 255.0)), 1e-5);

  const ExposureVerdict good = judge_exposure(counts_of({{5, 10}, {118, 80}, {250, 10}}), ColorState::Srgb);
  EXPECT_EQ(good.exposure, Exposure::Good);
  EXPECT_EQ(good.contrast, Contrast::Good);
  EXPECT_NEAR(good.stops, std::log2(0.18 / decoded(118 / 255.0)), 1e-5);

  const ExposureVerdict over = judge_exposure(counts_of({{0, 2}, {230, 60}, {255, 38}}), ColorState::Srgb);
  EXPECT_EQ(over.exposure, Exposure::Over);
  EXPECT_EQ(over.contrast, Contrast::High);
  EXPECT_EQ(over.black, 0.02);
  EXPECT_EQ(over.white, 0.38);
  EXPECT_NEAR(over.stops, std::log2(0.18 / decoded(230 / 255.0)), 1e-5);

  // As light, 46/255 is middle gray.
  EXPECT_NEAR(judge_exposure(dark, ColorState::Linear).stops, std::log2(0.18 * 255 / 46), 1e-5);
  EXPECT_EQ(judge_exposure(counts_of({}), ColorState::Srgb).stops, 0);
  EXPECT_EQ(judge_exposure(counts_of({{0, 5}}), ColorState::Srgb).stops, 8);
}

TEST(Exposure, CorrectsByTheVerdict) {
  Image source(10, 10, 1);
  std::array<std::uint64_t, 256> counts{};
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      source.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(x * y);
      ++counts[static_cast<std::size_t>(x * y)];
    }
  }
  struct Seen final : Stages {
    void image(const std::string&, const std::string&, const Image&) override {}
    void report(const std::string&, const std::string& name, const Json& report) override { reports[name] = report; }
    std::map<std::string, Json> reports;
  } seen;
  const float stops = judge_exposure(counts, ColorState::Srgb).stops;
  EXPECT_GT(stops, 2);
  const Image automatic = exposure(source, {}, {.stages = &seen});
  const Image given = exposure(source, {.stops = stops});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) EXPECT_EQ(automatic.view<std::uint8_t>()(x, y), given.view<std::uint8_t>()(x, y));
  }
  EXPECT_EQ(seen.reports["verdict"]["exposure"].text(), "under");
  EXPECT_EQ(static_cast<float>(seen.reports["verdict"]["stops"].number()), stops);
}

TEST(Exposure, RefusesStopsOutOfRange) {
  const Image source(1, 1, 1);
  EXPECT_THROW(exposure(source, {.stops = 17.0F}), Error);
  EXPECT_THROW(exposure(source, {.stops = kNaN}), Error);
}

}  // namespace
}  // namespace azulejo
