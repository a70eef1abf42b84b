#include "azulejo/engine/border.h"

#include <string>

#include <gtest/gtest.h>

#include "azulejo/engine/plan.h"

namespace azulejo {
namespace {

/// The letters that stand at −6 … 9 of an image "abcd".
std::string around(Border mode, int size) {
  std::string text;
  for (int i = -6; i < 10; ++i) {
    const int index = border_index(i, size, mode);
    text += index < 0 ? '.' : static_cast<char>('a' + index);
  }
  return text;
}

TEST(Border, ShowsWhatTheHeaderDraws) {
  EXPECT_EQ(around(Border::Mirror, 4), "abcdcbabcdcbabcd");
  EXPECT_EQ(around(Border::Reflect, 4), "cddcbaabcddcbaab");
  EXPECT_EQ(around(Border::Clamp, 4), "aaaaaaabcddddddd");
  EXPECT_EQ(around(Border::Wrap, 4), "cdabcdabcdabcdab");
  EXPECT_EQ(around(Border::Constant, 4), "......abcd......");
}

TEST(Border, TakesASinglePixel) {
  for (const Border mode : {Border::Mirror, Border::Reflect, Border::Clamp, Border::Wrap}) {
    EXPECT_EQ(around(mode, 1), "aaaaaaaaaaaaaaaa");
  }
}

TEST(Border, CoveringHoldsEveryIndexAndIsInside) {
  for (const Border mode : {Border::Mirror, Border::Reflect, Border::Clamp, Border::Wrap, Border::Constant}) {
    for (int size = 1; size < 8; ++size) {
      for (int low = -20; low < 20; ++low) {
        for (int high = low; high < 22; ++high) {
          const Span1 span = covering(low, high, size, mode);
          EXPECT_LE(0, span.low);
          EXPECT_LE(span.high, size);
          for (int i = low; i < high; ++i) {
            const int index = border_index(i, size, mode);
            if (index < 0) continue;
            EXPECT_TRUE(span.low <= index && index < span.high)
                << "mode " << static_cast<int>(mode) << ", size " << size << ", [" << low << ", " << high << ")";
          }
        }
      }
    }
  }
}

TEST(Border, CoveringIsTightNearTheImage) {
  EXPECT_EQ(covering(-3, 2, 10, Border::Mirror).high, 4);
  EXPECT_EQ(covering(-3, 2, 10, Border::Reflect).high, 3);
  EXPECT_EQ(covering(8, 12, 10, Border::Mirror).low, 7);
  EXPECT_EQ(covering(8, 12, 10, Border::Clamp).low, 8);
  EXPECT_EQ(covering(-5, -1, 10, Border::Clamp).high, 1);
  EXPECT_EQ(covering(-5, -1, 10, Border::Constant).high, 0);
}

}  // namespace
}  // namespace azulejo
