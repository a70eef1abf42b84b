#include "azulejo/imaging/rows.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace azulejo {
namespace {

double decode(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

TEST(Rows, ByteCurveIsCorrectlyRounded) {
  for (int k = 0; k < 256; ++k) EXPECT_EQ(byte_curve().linear[k], static_cast<float>(decode(k / 255.0))) << k;
}

TEST(Rows, EncodedBytesChangeExactlyAtTheThresholds) {
  for (int k = 1; k < 256; ++k) {
    const double threshold = decode((k - 0.5) / 255);
    auto above = static_cast<float>(threshold);
    if (static_cast<double>(above) < threshold) above = std::nextafter(above, 2.0F);
    EXPECT_EQ(encode_byte(byte_curve(), above), k);
    EXPECT_EQ(encode_byte(byte_curve(), std::nextafter(above, 0.0F)), k - 1);
    EXPECT_EQ(encode_byte(byte_curve(), byte_curve().linear[k]), k);
  }
  // Between thresholds the value never falls: all buckets, at both ends and in the middle.
  int last = 0;
  for (std::uint32_t bits = ByteCurve::kLowest; bits < 0x3F800000; bits += 0x7FFF) {
    const int now = encode_byte(byte_curve(), std::bit_cast<float>(bits));
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(Rows, EncodedBytesSaturate) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float low : {0.0F, -0.0F, -1.0F, -infinity, 1e-30F, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(encode_byte(byte_curve(), low), 0);
  }
  for (const float high : {1.0F, 1.5F, infinity}) EXPECT_EQ(encode_byte(byte_curve(), high), 255);
}

std::vector<RowFormat> formats() {
  std::vector<RowFormat> list;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const bool curve : {false, true}) {
      for (int channels = 1; channels <= 4; ++channels) list.push_back({type, channels, curve, RowAlpha::Plain});
      for (const int channels : {2, 4}) list.push_back({type, channels, curve, RowAlpha::Weigh});
    }
    for (const int channels : {2, 4}) list.push_back({type, channels, true, RowAlpha::Unweigh});
  }
  return list;
}

/// Calls f for each vector target, then lets the machine choose again.
template <class F>
void for_each_target(F f) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    SCOPED_TRACE(hwy::TargetName(target));
    f();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

std::vector<std::byte> random_row(const RowFormat& format, int pixels, std::mt19937& random) {
  std::vector<std::byte> row(format.values(pixels) * size_of(format.type));
  for (std::size_t i = 0; i < format.values(pixels); ++i) {
    if (format.type == PixelType::F32) {
      const float specials[] = {0.0F, -0.0F, 1.0F, std::numeric_limits<float>::quiet_NaN(),
                                std::numeric_limits<float>::infinity()};
      float value = std::uniform_real_distribution<float>(-0.5F, 1.5F)(random);
      if (random() % 8 == 0) value = specials[random() % 5];
      std::memcpy(row.data() + 4 * i, &value, 4);
    } else {
      const auto value = static_cast<std::uint16_t>(random() % 4 == 0 ? 0 : random());
      std::memcpy(row.data() + size_of(format.type) * i, &value, size_of(format.type));
    }
  }
  return row;
}

bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}

TEST(Rows, VectorsGiveTheBytesOfTheScalarDefinition) {
  const unsigned seed = 77;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const RowFormat& format : formats()) {
    for (int pixels = 0; pixels <= 37; ++pixels) {
      const std::vector<std::byte> source = random_row(format, pixels, random);
      const std::size_t values = format.values(pixels);
      std::vector<float> expected(values + 1, -7);
      load_row_reference(format, source.data(), pixels, expected.data());
      std::vector<float> sums = expected;  // something like weighted sums: overshoot, small and negative alphas
      for (float& each : sums) each = each * std::uniform_real_distribution<float>(-0.2F, 1.3F)(random) + 0.01F;
      std::vector<std::byte> expected_bytes(source.size() + 1, std::byte{0x5A});
      store_row_reference(format, sums.data(), pixels, expected_bytes.data());
      for_each_target([&] {
        std::vector<float> row(values + 1, -7);
        load_row(format, source.data(), pixels, row.data());
        for (std::size_t i = 0; i <= values; ++i)
          ASSERT_TRUE(same(row[i], expected[i])) << i << ": " << row[i] << " and " << expected[i];
        std::vector<std::byte> bytes(source.size() + 1, std::byte{0x5A});
        store_row(format, sums.data(), pixels, bytes.data());
        if (format.type != PixelType::F32) {
          ASSERT_EQ(bytes, expected_bytes);
          return;
        }
        for (std::size_t i = 0; i < values; ++i) {
          float a, b;
          std::memcpy(&a, bytes.data() + 4 * i, 4);
          std::memcpy(&b, expected_bytes.data() + 4 * i, 4);
          ASSERT_TRUE(same(a, b)) << i << ": " << a << " and " << b;
        }
      });
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Rows, IntegersComeBackAsTheyWere) {
  for (const RowFormat& format : formats()) {
    if (format.type == PixelType::F32) continue;
    const int top = format.type == PixelType::U8 ? 255 : 65535;
    const int last = format.channels - 1;
    std::vector<std::byte> pixel(format.values(1) * size_of(format.type));
    std::vector<std::byte> back(pixel.size());
    std::vector<float> row(format.values(1));
    for (int level = 0; level <= top; ++level) {
      for (const int alpha : {top, top / 2}) {
        const bool has_alpha = format.alpha != RowAlpha::Plain;
        // Colors of a premultiplied pixel aren't above its alpha.
        if (format.alpha == RowAlpha::Unweigh && level > alpha) continue;
        for (int c = 0; c < format.channels; ++c) {
          const auto value = static_cast<std::uint16_t>(has_alpha && c == last ? alpha : level);
          std::memcpy(pixel.data() + size_of(format.type) * static_cast<std::size_t>(c), &value, size_of(format.type));
        }
        load_row(format, pixel.data(), 1, row.data());
        store_row(format, row.data(), 1, back.data());
        ASSERT_EQ(back, pixel) << level << ", alpha " << alpha;
      }
    }
  }
}

TEST(Rows, FormatsFollowTheImage) {
  const auto format = [](ColorState color, AlphaState alpha, Light light) {
    return row_format({1, 1, 4, PixelType::U16, color, alpha}, light);
  };
  EXPECT_TRUE(format(ColorState::Srgb, AlphaState::None, Light::Linear).curve);
  EXPECT_FALSE(format(ColorState::Srgb, AlphaState::None, Light::Encoded).curve);
  EXPECT_FALSE(format(ColorState::Linear, AlphaState::None, Light::Linear).curve);
  EXPECT_FALSE(format(ColorState::Data, AlphaState::None, Light::Linear).curve);
  EXPECT_EQ(format(ColorState::Srgb, AlphaState::Straight, Light::Encoded).alpha, RowAlpha::Weigh);
  EXPECT_EQ(format(ColorState::Srgb, AlphaState::Premultiplied, Light::Linear).alpha, RowAlpha::Unweigh);
  EXPECT_EQ(format(ColorState::Linear, AlphaState::Premultiplied, Light::Linear).alpha, RowAlpha::Plain);
}

}  // namespace
}  // namespace azulejo
