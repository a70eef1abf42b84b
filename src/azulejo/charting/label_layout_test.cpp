#include "azulejo/charting/label_layout.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace azulejo {
namespace {

constexpr Box2 kPage{{0, 0}, {400, 300}};

bool overlap(const Box2& a, const Box2& b) {
  return a.lower.x < b.upper.x && b.lower.x < a.upper.x && a.lower.y < b.upper.y && b.lower.y < a.upper.y;
}

bool inside(const Box2& box) {
  return box.lower.x >= 0 && box.lower.y >= 0 && box.upper.x <= 400 && box.upper.y <= 300;
}

TEST(LabelLayout, ALabelStandsBesideItsPoint) {
  const std::vector<WantedLabel> one{{{100, 100}, {60, 20}}};
  const std::vector<PlacedLabel> placed = place_labels(one, kPage, 5);
  EXPECT_EQ(placed[0].box, (Box2{{105, 90}, {165, 110}}));
  EXPECT_FALSE(placed[0].leader);
  EXPECT_EQ(leader_end(placed[0].box, {100, 100}), glm::vec2(105, 100));
}

TEST(LabelLayout, WhereThereIsRoomItStandsOnThePoint) {
  const std::vector<WantedLabel> labels{{{100, 100}, {60, 20}, {{60, 60}, {140, 140}}},
                                        {{300, 100}, {60, 20}, {{290, 60}, {310, 140}}}};
  const std::vector<PlacedLabel> placed = place_labels(labels, kPage, 5);
  EXPECT_EQ(placed[0].box, (Box2{{70, 90}, {130, 110}}));
  EXPECT_EQ(placed[1].box, (Box2{{305, 90}, {365, 110}}));
}

TEST(LabelLayout, AtTheEdgeItGoesToTheOtherSide) {
  const std::vector<WantedLabel> one{{{390, 100}, {60, 20}}};
  EXPECT_EQ(place_labels(one, kPage, 5)[0].box, (Box2{{325, 90}, {385, 110}}));
}

TEST(LabelLayout, HidesNothingWhereThereIsRoom) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    std::vector<WantedLabel> labels;
    for (int i = 0; i < 25; ++i) {
      labels.push_back({{static_cast<float>(random() % 400), static_cast<float>(random() % 300)}, {50, 12}});
    }
    const std::vector<PlacedLabel> placed = place_labels(labels, kPage, 4);
    for (std::size_t i = 0; i < placed.size(); ++i) {
      EXPECT_TRUE(inside(placed[i].box)) << "seed " << seed;
      for (std::size_t j = 0; j < placed.size(); ++j) {
        if (i != j) {
          EXPECT_FALSE(overlap(placed[i].box, placed[j].box)) << "seed " << seed;
        }
        const Box2 point{labels[j].point - 3.0F, labels[j].point + 3.0F};
        EXPECT_FALSE(overlap(placed[i].box, point)) << "seed " << seed;
      }
    }
  }
}

/// Points on top of each other: the first labels are around them, others farther away, and led to.
TEST(LabelLayout, CrowdsHaveLeaders) {
  const std::vector<WantedLabel> labels(14, WantedLabel{{200, 150}, {40, 10}});
  const std::vector<PlacedLabel> placed = place_labels(labels, kPage, 4);
  EXPECT_FALSE(placed[0].leader);
  EXPECT_TRUE(placed[12].leader);
}

TEST(LabelLayout, TakesAnything) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<WantedLabel> labels{
      {{nan, 0}, {10, 10}}, {{0, 0}, {0, 10}}, {{1e30F, 0}, {10, 10}}, {{-500, -500}, {10, 10}}, {{5, 5}, {900, 900}}};
  const std::vector<PlacedLabel> placed = place_labels(labels, kPage, 4);
  EXPECT_TRUE(placed[0].box.empty());
  EXPECT_TRUE(placed[1].box.empty());
  EXPECT_TRUE(placed[2].box.empty());
  EXPECT_FALSE(placed[4].box.empty());
  EXPECT_TRUE(place_labels(labels, Box2{}, 4)[4].box.empty());
  const std::vector<WantedLabel> many(20000, WantedLabel{{200, 150}, {40, 10}});
  EXPECT_EQ(place_labels(many, kPage, 4).size(), many.size());
}

}  // namespace
}  // namespace azulejo
