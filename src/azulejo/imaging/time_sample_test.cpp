#include "azulejo/imaging/time_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

std::vector<Image> random_frames(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Image> frames;
  for (int i = 0; i < count; ++i) {
    frames.emplace_back(23, 11, 1, PixelType::F32);
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 23; ++x) frames.back().view<float>()(x, y) = static_cast<float>(random() % 4096) / 4096;
    }
  }
  return frames;
}

Image sampled(const std::vector<Image>& frames, const TimeSampleOptions& options) {
  std::vector<const Image*> pointers;
  for (const Image& frame : frames) pointers.push_back(&frame);
  return time_sample(pointers, options);
}

TEST(TimeSample, AnInstantIsOneFrame) {
  const auto frames = random_frames(4, 1);
  for (const auto& [time, frame] : {std::pair{0.0F, 0}, {0.99F, 0}, {1.0F, 1}, {3.5F, 3}}) {
    const Image result = sampled(frames, {time, 0.0F});
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 23; ++x)
        ASSERT_EQ(result.view<float>()(x, y), frames[static_cast<std::size_t>(frame)].view<float>()(x, y)) << time;
    }
  }
}

TEST(TimeSample, AnIntervalIsTheMeanWeightedByItsParts) {
  const auto frames = random_frames(40, 2);
  for (const auto& [time, shutter] : {std::pair{0.0F, 40.0F}, {0.25F, 1.5F}, {2.5F, 0.25F}, {3.0F, 35.125F}}) {
    const Image result = sampled(frames, {time, shutter, Light::Encoded});
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 23; ++x) {
        double sum = 0;
        for (int i = 0; i < 40; ++i) {
          const double part = std::min(i + 1.0, static_cast<double>(time + shutter)) - std::max<double>(i, time);
          sum += std::max(0.0, part) * static_cast<double>(frames[static_cast<std::size_t>(i)].view<float>()(x, y));
        }
        ASSERT_NEAR(result.view<float>()(x, y), sum / static_cast<double>(shutter), 1e-6);
      }
    }
  }
}

TEST(TimeSample, ByItselfTheShutterStaysOpenToTheEnd) {
  const auto frames = random_frames(3, 3);
  const Image open = sampled(frames, {1.0F, {}, Light::Encoded});
  const Image same = sampled(frames, {1.0F, 2.0F, Light::Encoded});
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 23; ++x) ASSERT_EQ(open.view<float>()(x, y), same.view<float>()(x, y));
  }
}

TEST(TimeSample, LightAddsUp) {
  std::vector<Image> frames;
  for (const int value : {0, 255}) {
    frames.emplace_back(5, 5, 1);
    for (int y = 0; y < 5; ++y)
      std::fill_n(frames.back().view<std::uint8_t>().row(y), 5, static_cast<std::uint8_t>(value));
  }
  EXPECT_EQ(sampled(frames, {}).view<std::uint8_t>()(2, 2), 188);
  EXPECT_EQ(sampled(frames, {0, {}, Light::Encoded}).view<std::uint8_t>()(2, 2), 128);
}

TEST(TimeSample, WhatDoesNotMoveStays) {
  std::vector<Image> frames;
  for (int i = 0; i < 100; ++i) {
    frames.emplace_back(256, 1, 1, PixelType::U16);
    for (int x = 0; x < 256; ++x) frames.back().view<std::uint16_t>()(x, 0) = static_cast<std::uint16_t>(x * 257);
  }
  for (const Light light : {Light::Encoded, Light::Linear}) {
    const Image result = sampled(frames, {0.3F, 98.9F, light});
    for (int x = 0; x < 256; ++x) ASSERT_EQ(result.view<std::uint16_t>()(x, 0), x * 257);
  }
}

// A dot that moves a pixel a frame leaves a streak as long as the shutter is open.
TEST(TimeSample, MovementLeavesAStreak) {
  std::vector<Image> frames;
  for (int i = 0; i < 8; ++i) {
    frames.emplace_back(10, 1, 1, PixelType::F32);
    std::fill_n(frames.back().view<float>().row(0), 10, 0.0F);
    frames.back().view<float>()(i, 0) = 1;
  }
  const Image streak = sampled(frames, {2, 4.0F, Light::Encoded});
  for (int x = 0; x < 10; ++x) EXPECT_EQ(streak.view<float>()(x, 0), x >= 2 && x < 6 ? 0.25F : 0.0F);
}

TEST(TimeSample, RefusesWhatIsNotThere) {
  const auto frames = random_frames(3, 4);
  EXPECT_THROW(sampled(frames, {3.0F}), Error);
  EXPECT_THROW(sampled(frames, {1.0F, 2.5F}), Error);
  std::vector<Image> different = random_frames(2, 5);
  different.emplace_back(5, 5, 1, PixelType::F32);
  EXPECT_THROW(sampled(different, {}), Error);
}

TEST(TimeSample, WritesIntoTheCallersMemory) {
  const Image first = random_image(Image(13, 7, 3).info(), 1);
  const Image second = random_image(Image(13, 7, 3).info(), 2);
  const Image* const frames[] = {&first, &second};
  const ConstAnyView views[] = {first.any(), second.any()};
  const Image expected = time_sample(frames);
  Image result(13, 7, 3);
  time_sample(views, result.any());
  for (int y = 0; y < 7; ++y) {
    for (int i = 0; i < 39; ++i) {
      EXPECT_EQ(result.view<std::uint8_t>().row(y)[i], expected.view<std::uint8_t>().row(y)[i]);
    }
  }
}

}  // namespace
}  // namespace azulejo
