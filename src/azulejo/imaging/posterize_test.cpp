#include "azulejo/imaging/posterize.h"

#include <set>

#include "azulejo/core/error.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

PointOperation with(int levels) {
  return [levels](const Image& source) { return posterize(source, {.levels = levels}); };
}

TEST(Posterize, TakesTheNearestLevel) {
  for (const int levels : {2, 3, 4, 7, 256}) {
    const auto exact = [&](double v) {
      return std::floor(std::clamp(v, 0.0, 1.0) * (levels - 1) + 0.5) / (levels - 1);
    };
    expect_rounded(with(levels), exact, PixelType::U8, 1e-4);
    expect_real(with(levels), exact, 0, 0x1p-23);
  }
}

TEST(Posterize, LeavesSoManyLevelsAndOnceIsEnough) {
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    for (const int levels : {2, 5, 16, 255}) {
      const Image once = posterize(every_value(type), {.levels = levels});
      const Image twice = posterize(once, {.levels = levels});
      visit(once.any(), [&](auto view) {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
        std::set<T> seen;
        for (int x = 0; x < view.width; ++x) {
          seen.insert(view(x, 0));
          EXPECT_EQ(twice.any().as<T>()(x, 0), view(x, 0));
        }
        EXPECT_EQ(seen.size(), static_cast<std::size_t>(levels));
        EXPECT_EQ(*seen.begin(), 0);
        EXPECT_EQ(*seen.rbegin(), std::numeric_limits<T>::max());
      });
    }
  }
}

TEST(Posterize, WithAllLevelsChangesNothing) {
  expect_rounded(
      with(256), [](double v) { return v; }, PixelType::U8, 1e-4);
  expect_rounded(
      with(65536), [](double v) { return v; }, PixelType::U16, 0.02);
}

TEST(Posterize, OfSpecialValues) {
  EXPECT_TRUE(std::isnan(of_one(with(4), kNaN)));
  EXPECT_EQ(of_one(with(4), kInfinity), 1.0F);
  EXPECT_EQ(of_one(with(4), -3), 0.0F);
}

TEST(Posterize, LeavesAlphaAlone) { expect_alpha_is_left_alone(with(5)); }

TEST(Posterize, RefusesLevelsOutOfRange) {
  const Image source(1, 1, 1);
  EXPECT_THROW(posterize(source, {.levels = 1}), Error);
  EXPECT_THROW(posterize(source, {.levels = 65537}), Error);
}

}  // namespace
}  // namespace azulejo
