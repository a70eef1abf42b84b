#include "azulejo/rendering/edge_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace azulejo {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge sorted(std::uint32_t a, std::uint32_t b) { return std::minmax(a, b); }

TEST(EdgeChains, HaveEachEdgeOnce) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    std::mt19937 random(seed);
    std::map<Edge, int> expected;
    std::vector<Edge> edges;
    const std::uint32_t vertices = 300;
    for (int i = 0; i < 900; ++i) {
      const auto a = static_cast<std::uint32_t>(random() % vertices);
      const auto b = static_cast<std::uint32_t>(random() % vertices);
      if (a == b) continue;
      edges.emplace_back(a, b);
      ++expected[sorted(a, b)];
    }
    const std::size_t longest = seed == 4 ? 7 : 100000;
    const EdgeChains chains = edge_chains(edges, vertices, longest);
    for (std::size_t line = 0; line < chains.size(); ++line) {
      ASSERT_GE(chains[line].size(), 2U);
      ASSERT_LE(chains[line].size(), longest + 1);
      for (std::size_t i = 1; i < chains[line].size(); ++i) --expected[sorted(chains[line][i - 1], chains[line][i])];
    }
    ASSERT_TRUE(std::ranges::all_of(expected, [](const auto& each) { return each.second == 0; })) << "seed " << seed;
    // Euler: half as many lines as odd vertices, and a few rings beside.
    std::map<std::uint32_t, int> degree;
    for (const auto& [a, b] : edges) {
      ++degree[a];
      ++degree[b];
    }
    const auto odd = std::ranges::count_if(degree, [](const auto& each) { return each.second % 2 == 1; });
    if (longest > edges.size()) {
      EXPECT_LT(chains.size(), static_cast<std::size_t>(odd) / 2 + 60) << "seed " << seed;
    }
  }
}

TEST(EdgeChains, OfARingIsOneLine) {
  const std::vector<Edge> edges{{0, 1}, {2, 1}, {2, 3}, {0, 3}};
  const EdgeChains chains = edge_chains(edges, 5, 100);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].size(), 5U);
  EXPECT_EQ(chains[0].front(), chains[0].back());
  EXPECT_EQ(edge_chains({}, 0, 10).size(), 0U);
}

}  // namespace
}  // namespace azulejo
