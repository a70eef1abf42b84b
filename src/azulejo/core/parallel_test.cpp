#include "azulejo/core/parallel.h"

#include <atomic>
#include <numeric>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

TEST(Parallel, RunsEveryTaskOnceForAnyThreadCount) {
  for (const int threads : {1, 2, 7, 32}) {
    std::vector<std::atomic<int>> done(1000);
    parallel_tasks(done.size(), azulejo::Run{.threads = threads}, [&](std::size_t task, int) { ++done[task]; });
    for (const auto& count : done) EXPECT_EQ(count, 1);
  }
}

TEST(Parallel, WorkersAreExclusive) {
  std::vector<std::atomic<int>> busy(7);
  std::atomic<bool> shared = false;
  parallel_tasks(500, azulejo::Run{.threads = 7}, [&](std::size_t, int worker) {
    if (busy.at(static_cast<std::size_t>(worker))++ != 0) shared = true;
    std::this_thread::yield();
    --busy.at(static_cast<std::size_t>(worker));
  });
  EXPECT_FALSE(shared);
}

TEST(Parallel, ReductionHasTheSameBytesForAnyThreadCount) {
  std::mt19937 random(1);
  std::vector<float> values(100'003);
  for (float& value : values) value = std::uniform_real_distribution<float>(-1, 1)(random);
  const auto sum = [&](int threads) {
    return parallel_reduce(
        values.size(), 1000, azulejo::Run{.threads = threads}, 0.0F,
        [&](std::size_t begin, std::size_t end) { return std::accumulate(&values[begin], values.data() + end, 0.0F); },
        std::plus<>());
  };
  const float one = sum(1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(sum(threads), one);
}

TEST(Parallel, SortsStably) {
  std::mt19937 random(2);
  std::vector<std::pair<int, int>> values(200'001);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {static_cast<int>(random() % 1000), static_cast<int>(i)};
  auto expected = values;
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(expected.begin(), expected.end(), less);
  parallel_sort(values.begin(), values.end(), azulejo::Run{.threads = 4}, less);
  EXPECT_EQ(values, expected);
}

TEST(Parallel, ThrowsTheFailureOfTheLowestTask) {
  for (const int threads : {1, 4}) {
    try {
      parallel_tasks(100, azulejo::Run{.threads = threads}, [](std::size_t task, int) {
        if (task >= 10) throw Error(Error::Data, "task " + std::to_string(task));
      });
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Data);
      EXPECT_STREQ(error.what(), "task 10");
    }
  }
}

TEST(Parallel, StopsWhenCancelled) {
  const CancelToken token;
  std::atomic<int> done = 0;
  try {
    parallel_tasks(1'000'000, azulejo::Run{.threads = 2, .cancel = &token}, [&](std::size_t, int) {
      if (++done == 10) token.cancel();
    });
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Cancelled);
  }
  EXPECT_LT(done, 1000);
}

}  // namespace
}  // namespace azulejo
