#include "azulejo/imaging/median_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace azulejo::kernels {
namespace {

/// What a network that is fed whole vectors computes.
template <class Net>
void apply(const Net& net, std::vector<int>& values) {
  for (int s = 0; s < net.count; ++s) {
    const Exchange& step = net.steps[static_cast<std::size_t>(s)];
    int& a = values[static_cast<std::size_t>(step.a)];
    int& b = values[static_cast<std::size_t>(step.b)];
    const auto [low, high] = std::minmax({a, b});
    if (step.low) a = low;
    if (step.high) b = high;
  }
}

/// Whether zeros and ones in columns are sorted right; columns[j] is the number of ones in column j.
template <int kSide>
bool finds_median(const std::vector<int>& columns) {
  static constexpr auto kNet = median_network<kSide>();
  std::vector<int> values(kSide * kSide);
  int ones = 0;
  for (int j = 0; j < kSide; ++j) {
    ones += columns[static_cast<std::size_t>(j)];
    for (int i = 0; i < kSide; ++i) {
      values[static_cast<std::size_t>(i * kSide + j)] = i >= kSide - columns[static_cast<std::size_t>(j)] ? 1 : 0;
    }
  }
  apply(kNet, values);
  return values[static_cast<std::size_t>(kNet.result)] == (ones > kSide * kSide / 2 ? 1 : 0);
}

// A network of exchanges that is right for all zeros and ones is right for all values: Knuth, The Art of Computer
// Programming 3, 5.3.4, theorem Z.
template <int kSide>
void try_all_columns() {
  std::vector<int> columns(kSide, 0);
  for (;;) {
    ASSERT_TRUE(finds_median<kSide>(columns)) << testing::PrintToString(columns);
    std::size_t j = 0;
    while (j < kSide && columns[j] == kSide) columns[j++] = 0;
    if (j == kSide) return;
    ++columns[j];
  }
}

TEST(MedianNetwork, IsRightForAllZerosAndOnes) {
  try_all_columns<3>();
  try_all_columns<5>();
  try_all_columns<7>();
}

TEST(MedianNetwork, OfNineIsRightForManyZerosAndOnes) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200'000; ++trial) {
    std::vector<int> columns(9);
    int ones = 0;
    for (int& each : columns) ones += each = static_cast<int>(random() % 10);
    // Where it matters: 40 or 41 ones of 81.
    while (ones > 41 || ones < 40) {
      int& each = columns[random() % 9];
      if (ones > 41 && each > 0) --each, --ones;
      if (ones < 40 && each < 9) ++each, ++ones;
    }
    ASSERT_TRUE(finds_median<9>(columns)) << testing::PrintToString(columns);
  }
}

template <int kCount>
void try_sorting() {
  static constexpr auto kSorting = sorting_network<kCount>();
  for (unsigned bits = 0; bits < 1U << kCount; ++bits) {
    std::vector<int> values;
    for (int i = 0; i < kCount; ++i) values.push_back(static_cast<int>(bits >> i & 1));
    apply(kSorting.net, values);
    for (int i = 1; i < kCount; ++i) {
      ASSERT_LE(values[static_cast<std::size_t>(kSorting.order[i - 1])],
                values[static_cast<std::size_t>(kSorting.order[i])]);
    }
  }
}

TEST(MedianNetwork, SortsAllZerosAndOnes) {
  try_sorting<3>();
  try_sorting<5>();
  try_sorting<7>();
  try_sorting<9>();
}

/// Speed depends on it.
TEST(MedianNetwork, HasFewSteps) {
  EXPECT_LE(network::operations(median_network<3>()), 12);
  EXPECT_LE(network::operations(median_network<5>()), 114);
  EXPECT_LE(network::operations(median_network<7>()), 368);
  EXPECT_LE(network::operations(median_network<9>()), 780);
}

}  // namespace
}  // namespace azulejo::kernels
