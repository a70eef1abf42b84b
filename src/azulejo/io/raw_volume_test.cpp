// Raw samples, INRIMAGE and the grids of Mitsuba.

#include <cstring>
#include <string>

#include "azulejo/io/volume_testing.h"

namespace azulejo {
namespace {

ModelReadOptions raw(const RawVolume& layout) { return {.raw = layout}; }

TEST(RawVolume, TakesSizeTypeAndOrderFromTheOptions) {
  const std::string bytes("??\x01\x02\x03\x04", 6);
  const Volume big = read_volume(as_bytes(bytes), "v.raw",
                                 raw({.width = 1,
                                      .height = 2,
                                      .depth = 1,
                                      .type = SampleType::U16,
                                      .big_endian = true,
                                      .skip_bytes = 2,
                                      .spacing = {1, 2, 3}}));
  EXPECT_EQ(samples_of(big), (std::vector<float>{258, 772}));
  EXPECT_EQ(big.spacing, glm::vec3(1, 2, 3));
  const Volume little =
      read_volume(as_bytes(bytes), "any name",
                  raw({.width = 2, .height = 1, .depth = 1, .type = SampleType::U16, .skip_bytes = 2}));
  EXPECT_EQ(samples_of(little), (std::vector<float>{513, 1027}));
}

TEST(RawVolume, ComparesWithTheFile) {
  const std::string bytes(8, 'x');
  Warnings heard;
  read_volume(as_bytes(bytes), "v.raw", raw({.width = 2, .height = 2, .depth = 2}), heard.run());
  EXPECT_TRUE(heard.lines.empty());
  read_volume(as_bytes(bytes), "v.raw", raw({.width = 2, .height = 2, .depth = 1}), heard.run());
  EXPECT_EQ(heard.lines.size(), 1U);
  const auto kind = [&](const RawVolume& layout) {
    return kind_of_error([&] { read_volume(as_bytes(bytes), "v.raw", raw(layout)); });
  };
  EXPECT_EQ(kind({.width = 3, .height = 3, .depth = 1}), Error::Data);
  EXPECT_EQ(kind({.width = 8, .height = 1, .depth = 1, .skip_bytes = 9}), Error::Data);
  EXPECT_EQ(kind({.width = 0, .height = 1, .depth = 1}), Error::Argument);
  EXPECT_EQ(kind({.width = 1, .height = 1, .depth = 1, .skip_bytes = -1}), Error::Argument);
  EXPECT_EQ(kind({.width = 2000000000, .height = 2000000000, .depth = 2000000000}), Error::Resource);
  EXPECT_EQ(kind_of_error([&] { read_volume(as_bytes(bytes), "v.raw"); }), Error::Argument) << "no size";
}

TEST(RawVolume, SameForAnyNumberOfThreads) {
  std::string bytes;
  for (std::uint32_t i = 0; i < 300000; ++i) bytes += static_cast<char>(i * 2654435761U >> 24);
  const RawVolume layout{.width = 100, .height = 50, .depth = 15, .type = SampleType::F32};
  const auto read = [&](int threads) {
    azulejo::Run run;
    run.threads = threads;
    return read_volume(as_bytes(bytes), "v.raw", raw(layout), run);
  };
  const Volume one = read(1);
  for (const int threads : {2, 7}) {
    const Volume other = read(threads);
    EXPECT_EQ(std::memcmp(one.samples.data(), other.samples.data(), bytes.size()), 0);
  }
}

TEST(RawVolume, NumpyIsRefusedWithAWayOut) {
  const std::string npy = "\x93NUMPY\x01";
  EXPECT_EQ(kind_of_error([&] { read_volume(as_bytes(npy), "a.npy"); }), Error::Unsupported);
  const std::string npz("PK\x03\x04rest", 8);
  EXPECT_EQ(kind_of_error([&] { read_volume(as_bytes(npz), "a.npz"); }), Error::Unsupported);
}

std::string inrimage(const std::string& fields, const std::string& samples) {
  std::string text = "#INRIMAGE-4#{\n" + fields;
  return text + std::string(252 - text.size(), '\n') + "##}\n" + samples;
}

TEST(Inrimage, ReadsFixedAndFloatingSamples) {
  const std::string shorts =
      "XDIM=2\nYDIM=1\nZDIM=1\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=16 bits\nVX=0.5\nVZ=2\nTX=4\n";
  const std::string samples("\x01\x02\x03\x04", 4);
  Volume volume = read_volume(as_bytes(inrimage(shorts + "CPU=decm\n", samples)));
  EXPECT_EQ(samples_of(volume), (std::vector<float>{513, 1027}));
  EXPECT_EQ(volume.spacing, glm::vec3(0.5F, 1, 2));
  EXPECT_EQ(volume.origin, glm::vec3(4, 0, 0));
  volume = read_volume(as_bytes(inrimage(shorts + "CPU=sun\r\n", samples)));
  EXPECT_EQ(samples_of(volume), (std::vector<float>{258, 772}));
  Warnings heard;
  volume = read_volume(
      as_bytes(inrimage("XDIM=2\nVDIM=2\nTYPE=signed fixed\nPIXSIZE=8 bits\n# VDIM=1\n", "\x01\x02\xFF\x04")), "v", {},
      heard.run());
  EXPECT_EQ(samples_of(volume), (std::vector<float>{1, -1}));
  EXPECT_EQ(heard.lines.size(), 1U);
}

TEST(Inrimage, RefusesBadHeaders) {
  const auto kind = [](const std::string& fields) {
    return kind_of_error([&] { read_volume(as_bytes(inrimage(fields, "x"))); });
  };
  EXPECT_EQ(kind("XDIM=1\nTYPE=packed\nPIXSIZE=8 bits\n"), Error::Unsupported);
  EXPECT_EQ(kind("XDIM=many\nTYPE=unsigned fixed\nPIXSIZE=8 bits\n"), Error::Data);
  EXPECT_EQ(kind("XDIM=2\nTYPE=unsigned fixed\nPIXSIZE=8 bits\n"), Error::Data);
  EXPECT_EQ(kind("VDIM=0\nTYPE=unsigned fixed\nPIXSIZE=8 bits\n"), Error::Data);
  expect_volume_cuts_refused(as_bytes(inrimage("XDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\n", "x")));
}

BytesWriter mitsuba(std::array<std::int32_t, 5> numbers) {
  BytesWriter writer;
  writer.add("VOL\x03");
  for (const std::int32_t each : numbers) writer.add(each);
  for (const float each : {-1.0F, -1.0F, 0.0F, 1.0F, 1.0F, 4.0F}) writer.add(each);
  return writer;
}

TEST(MitsubaVolume, ReadsFloatsAndBytesInABox) {
  BytesWriter floats = mitsuba({1, 3, 1, 1, 1});
  for (const float each : {0.5F, -7.0F, 1e9F}) floats.add(each);
  const Volume volume = read_volume(floats.bytes);
  EXPECT_EQ(samples_of(volume), (std::vector<float>{0.5F, -7.0F, 1e9F}));
  EXPECT_EQ(volume.spacing, glm::vec3(1, 1, 1));
  EXPECT_EQ(volume.origin, glm::vec3(-1, -1, 0));
  expect_volume_cuts_refused(floats.bytes);
  BytesWriter pairs = mitsuba({3, 2, 1, 1, 2});
  pairs.add(std::string_view("\xFF\x01\x33\x04", 4));
  const Volume scaled = read_volume(pairs.bytes);
  EXPECT_EQ(samples_of(scaled), (std::vector<float>{1, 0.2F}));
  EXPECT_EQ(scaled.spacing.x, 2);
}

TEST(MitsubaVolume, RefusesBadHeaders) {
  const auto kind = [](std::array<std::int32_t, 5> numbers) {
    return kind_of_error([&] { read_volume(mitsuba(numbers).bytes); });
  };
  EXPECT_EQ(kind({2, 1, 1, 1, 1}), Error::Unsupported);
  EXPECT_EQ(kind({1, 0, 1, 1, 1}), Error::Data);
  EXPECT_EQ(kind({1, 1, 1, 1, 0}), Error::Data);
  EXPECT_EQ(kind({1, 1, 1, 1, 2000000000}), Error::Data);
  EXPECT_EQ(kind({1, 2000000000, 2000000000, 2000000000, 1}), Error::Resource);
}

}  // namespace
}  // namespace azulejo
