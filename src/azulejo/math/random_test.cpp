#include "azulejo/math/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "azulejo/math/normal.h"

namespace azulejo {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Known answers of Random123, the authors' own library.
TEST(Philox, GivesThePublishedWords) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(NormalDeviate, HasItsShareBelow) {
  double largest = 0;
  for (std::uint64_t bits = 0; bits < std::uint64_t{1} << 32; bits += 65'521) {
    const double z = normal_deviate(static_cast<std::uint32_t>(bits));
    const double share = (static_cast<double>(bits) + 0.5) * 0x1p-32;
    const double below = 0.5 * std::erfc(-z / std::sqrt(2.0));
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::acos(-1.0));
    // The error of z. In the upper half shares lose digits: it is the lower one's mirror image.
    if (std::fabs(z) < 5.4) largest = std::max(largest, std::fabs(below - share) / density);
  }
  EXPECT_LT(largest, 2e-6);
}

TEST(NormalDeviate, IsOddAndReachesFarInItsTails) {
  for (const std::uint32_t bits : {0U, 1U, 77U, 123'456'789U, 0x7fffffffU, 0x80000000U}) {
    EXPECT_EQ(normal_deviate(bits), -normal_deviate(~bits));
  }
  // The share of 2⁻³³: an error of 0.003 times z.
  const double z = normal_deviate(0);
  EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) * 0x1p33, 1, 0.003 * 6.4);
}

}  // namespace
}  // namespace azulejo
