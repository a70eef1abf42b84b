#include "azulejo/imaging/channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

template <class T>
Image random_of(int channels, unsigned seed) {
  return random_image(Image(67, 19, channels, kPixelTypeOf<T>).info(), seed);
}

TEST(Channels, AreThoseThatAreNamed) {
  const Image photo = random_of<std::uint8_t>(4, 1);
  const Image depth = random_of<std::uint8_t>(1, 2);
  const Image* const images[] = {&photo, &depth};
  const Image result = channels(images, {.take = {"b", "2.r", "1.a", "one"}});
  EXPECT_EQ(result.channels(), 4);
  EXPECT_EQ(result.info().alpha, AlphaState::None);
  for (int y = 0; y < 19; ++y) {
    for (int x = 0; x < 67; ++x) {
      const std::uint8_t* const pixel = &result.view<std::uint8_t>()(x, y);
      ASSERT_EQ(pixel[0], photo.view<std::uint8_t>()(x, y, 2));
      ASSERT_EQ(pixel[1], depth.view<std::uint8_t>()(x, y));
      ASSERT_EQ(pixel[2], photo.view<std::uint8_t>()(x, y, 3));
      ASSERT_EQ(pixel[3], 255);
    }
  }
}

TEST(Channels, TakenApartAndPutTogetherAreTheImage) {
  const unsigned seed = 3;
  SCOPED_TRACE(seed);
  const Image photo = random_of<std::uint16_t>(3, seed);
  const Image red = channels(photo, {.take = {"r"}});
  const Image green = channels(photo, {.take = {"g"}});
  const Image blue = channels(photo, {.take = {"3"}});
  const Image* const images[] = {&red, &green, &blue};
  const Image merged = channels(images);
  EXPECT_EQ(merged.info(), photo.info());
  const Image twice = channels(channels(photo, {.take = {"b", "g", "r"}}), {.take = {"b", "g", "r"}});
  for (int y = 0; y < 19; ++y) {
    for (int i = 0; i < 201; ++i) {
      ASSERT_EQ(merged.view<std::uint16_t>().row(y)[i], photo.view<std::uint16_t>().row(y)[i]);
      ASSERT_EQ(twice.view<std::uint16_t>().row(y)[i], photo.view<std::uint16_t>().row(y)[i]);
    }
  }
}

TEST(Channels, WorkInPlace) {
  Image photo = random_of<float>(3, 4);
  const Image swapped = channels(photo, {.take = {"b", "g", "r"}});
  const ConstAnyView sources[] = {photo.any()};
  channels(sources, photo.any(), {.take = {"b", "g", "r"}});
  for (int y = 0; y < 19; ++y) {
    for (int i = 0; i < 201; ++i) ASSERT_EQ(photo.view<float>().row(y)[i], swapped.view<float>().row(y)[i]);
  }
}

TEST(Channels, StatesSayWhatTheResultIs) {
  Image photo = random_of<std::uint8_t>(4, 5);
  const auto info_of = [&](std::vector<std::string> take, bool alpha = false) {
    return channels(photo, {.take = std::move(take), .alpha = alpha}).info();
  };
  EXPECT_EQ(info_of({"r"}).color, ColorState::Srgb);
  EXPECT_EQ(info_of({"a"}).color, ColorState::Data);
  EXPECT_EQ(info_of({"r", "g"}).color, ColorState::Data);
  EXPECT_EQ(info_of({"r", "g", "b"}).alpha, AlphaState::None);
  EXPECT_EQ(info_of({"r", "a"}).alpha, AlphaState::Straight);
  EXPECT_EQ(info_of({"b", "g", "r", "a"}).alpha, AlphaState::Straight);
  EXPECT_EQ(info_of({"r", "g", "b", "one"}).alpha, AlphaState::None);
  EXPECT_EQ(info_of({"r", "g", "b", "one"}, true).alpha, AlphaState::Straight);
  EXPECT_EQ(info_of({"r", "g", "b", "one"}, true).color, ColorState::Srgb);
  photo.set_states(ColorState::Linear, AlphaState::Premultiplied);
  EXPECT_EQ(info_of({"b", "g", "r", "a"}).alpha, AlphaState::Premultiplied);
  EXPECT_EQ(info_of({"b", "g", "r", "a"}).color, ColorState::Linear);
  EXPECT_EQ(info_of({"b", "g", "one", "a"}).alpha, AlphaState::Straight);
}

TEST(Channels, RefusesWhatIsNotThere) {
  const Image photo(4, 4, 3);
  for (const char* name : {"a", "4", "5", "x", "", "2.r", "0.r", "1.", ".r", "1.rg", "red"}) {
    EXPECT_THROW(channels(photo, {.take = {name}}), Error) << name;
  }
  EXPECT_THROW(channels(photo, {.take = {"r", "r", "r", "r", "r"}}), Error);
  EXPECT_THROW(channels(photo, {.take = {"r"}, .alpha = true}), Error);
  const Image larger(5, 4, 3);
  const Image words(4, 4, 1, PixelType::U16);
  for (const Image* const other : {&larger, &words}) {
    const Image* const images[] = {&photo, other};
    EXPECT_THROW(channels(images, {.take = {"r"}}), Error);
  }
  EXPECT_THROW(channels(std::span<const Image* const>()), Error);
}

}  // namespace
}  // namespace azulejo
