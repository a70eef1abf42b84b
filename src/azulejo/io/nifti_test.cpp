#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <zlib.h>

#include "azulejo/io/volume_testing.h"

namespace azulejo {
namespace {

/// A header of either version; tests change what they are about.
struct Nifti {
  BytesWriter writer;
  bool second;

  explicit Nifti(bool version_2 = false, bool big_endian = false) : second(version_2) {
    writer.big_endian = big_endian;
    writer.bytes.resize(second ? 544 : 352);
    writer.put<std::int32_t>(0, second ? 540 : 348);
    const std::string_view magic = second ? std::string_view("n+2\0\r\n\x1A\n", 8) : std::string_view("n+1\0", 4);
    for (std::size_t i = 0; i < magic.size(); ++i)
      writer.bytes[(second ? 4U : 344U) + i] = static_cast<std::byte>(magic[i]);
    for (int i = 0; i < 8; ++i) dim(i, i == 0 ? 3 : 1);
    for (int i = 0; i < 8; ++i) pixdim(i, 1);
    real(second ? 168 : 108, second ? 0.0 : 352.0);
    if (second) writer.put<std::int64_t>(168, 544);
  }
  void real(std::size_t at, double value) {
    second ? writer.put<double>(at, value) : writer.put<float>(at, static_cast<float>(value));
  }
  void dim(int i, int value) {
    const auto at = static_cast<std::size_t>(i);
    second ? writer.put<std::int64_t>(16 + 8 * at, value)
           : writer.put<std::int16_t>(40 + 2 * at, static_cast<std::int16_t>(value));
  }
  void size(int width, int height, int depth) {
    dim(1, width);
    dim(2, height);
    dim(3, depth);
  }
  void pixdim(int i, double value) {
    real(second ? 104 + 8 * static_cast<std::size_t>(i) : 76 + 4 * static_cast<std::size_t>(i), value);
  }
  void type(int code) { writer.put<std::int16_t>(second ? 12 : 70, static_cast<std::int16_t>(code)); }
  void scale(double slope, double intercept) {
    real(second ? 176 : 112, slope);
    real(second ? 184 : 116, intercept);
  }
  void units(int code) {
    second ? writer.put<std::int32_t>(500, code) : writer.put<std::uint8_t>(123, static_cast<std::uint8_t>(code));
  }
  void codes(int qform, int sform) {
    second ? writer.put<std::int32_t>(344, qform) : writer.put<std::int16_t>(252, static_cast<std::int16_t>(qform));
    second ? writer.put<std::int32_t>(348, sform) : writer.put<std::int16_t>(254, static_cast<std::int16_t>(sform));
  }
  void quaternion(std::array<double, 6> values) {
    for (std::size_t i = 0; i < 6; ++i) real(second ? 352 + 8 * i : 256 + 4 * i, values[i]);
  }
  void rows(std::array<double, 12> values) {
    for (std::size_t i = 0; i < 12; ++i) real(second ? 400 + 8 * i : 280 + 4 * i, values[i]);
  }
  template <class T>
  void samples(std::initializer_list<T> values) {
    for (const T each : values) writer.add(each);
  }
  Volume read(const Run& run = {}) const { return read_volume(writer.bytes, "n.nii", {}, run); }
};

template <class T>
void expect_type(int code, T low, T high, std::size_t warnings) {
  for (const bool version_2 : {false, true}) {
    for (const bool big : {false, true}) {
      SCOPED_TRACE(code);
      Nifti file(version_2, big);
      file.size(3, 1, 1);
      file.type(code);
      file.samples<T>({low, T{7}, high});
      Warnings heard;
      const Volume volume = file.read(heard.run());
      EXPECT_EQ(samples_of(volume), (std::vector<float>{static_cast<float>(low), 7.0F, static_cast<float>(high)}));
      EXPECT_EQ(heard.lines.size(), warnings);
    }
  }
}

template <class T>
void expect_whole_type(int code, std::size_t warnings) {
  expect_type<T>(code, std::numeric_limits<T>::min(), std::numeric_limits<T>::max(), warnings);
}

TEST(Nifti, ReadsEveryScalarTypeInBothOrdersAndVersions) {
  expect_whole_type<std::uint8_t>(2, 0);
  expect_whole_type<std::int8_t>(256, 0);
  expect_whole_type<std::uint16_t>(512, 0);
  expect_whole_type<std::int16_t>(4, 0);
  expect_whole_type<std::uint32_t>(768, 1);  // 2³² − 1 has no f32
  expect_whole_type<std::int32_t>(8, 1);
  expect_whole_type<std::uint64_t>(1280, 1);
  expect_whole_type<std::int64_t>(1024, 1);
  expect_type<std::int32_t>(8, -(1 << 24), 1 << 24, 0);
  expect_type<float>(16, -1e30F, 1e-30F, 0);
  expect_type<double>(64, -0.5, 0.1, 1);
  expect_type<double>(64, -0.5, 0.25, 0);
}

TEST(Nifti, KeepsTheOrderOfSamples) {
  Nifti file;
  file.size(2, 3, 2);
  file.type(2);
  for (std::uint8_t i = 0; i < 12; ++i) file.samples<std::uint8_t>({i});
  const Volume volume = file.read();
  EXPECT_EQ(volume.width, 2);
  EXPECT_EQ(volume.height, 3);
  EXPECT_EQ(volume.depth, 2);
  EXPECT_EQ(volume.at(1, 2, 1), 11.0F);
  EXPECT_EQ(volume.at(0, 1, 0), 2.0F);
}

TEST(Nifti, ScalesWhereTheSlopeIsNotZero) {
  Nifti file;
  file.size(2, 1, 1);
  file.type(4);
  file.scale(0.5, -3);
  file.samples<std::int16_t>({-10, 9});
  EXPECT_EQ(samples_of(file.read()), (std::vector<float>{-8.0F, 1.5F}));
  file.scale(0, -3);
  EXPECT_EQ(samples_of(file.read()), (std::vector<float>{-10.0F, 9.0F}));
  file.scale(std::nan(""), 1);
  EXPECT_EQ(samples_of(file.read()), (std::vector<float>{-10.0F, 9.0F}));
}

TEST(Nifti, TakesUnitsAndSteps) {
  for (const bool version_2 : {false, true}) {
    Nifti file(version_2);
    file.type(2);
    file.samples<std::uint8_t>({1});
    file.pixdim(1, 0.5);
    file.pixdim(2, 2);
    file.pixdim(3, 3);
    file.units(2 | 8);  // millimetres, seconds
    const Volume volume = file.read();
    EXPECT_EQ(volume.spacing, glm::vec3(0.5F, 2, 3));
    EXPECT_EQ(volume.origin, glm::vec3(0, 0, 0));
    EXPECT_EQ(volume.metres_per_unit, 1e-3F);
    EXPECT_EQ(read_volume(file.writer.bytes, "n", {.metres_per_unit = 0.0254F}).metres_per_unit, 0.0254F);
  }
}

TEST(Nifti, SformGivesOriginAndSigns) {
  for (const bool version_2 : {false, true}) {
    Nifti file(version_2, true);
    file.type(2);
    file.samples<std::uint8_t>({1});
    file.codes(1, 1);
    file.quaternion({1, 0, 0, 9, 9, 9});
    file.rows({-2, 0, 0, 90, 0, 3, 0, -126, 0, 0, 4, -72});
    Warnings heard;
    const Volume volume = file.read(heard.run());
    EXPECT_EQ(volume.spacing, glm::vec3(-2, 3, 4));
    EXPECT_EQ(volume.origin, glm::vec3(90, -126, -72));
    EXPECT_TRUE(heard.lines.empty());
  }
}

TEST(Nifti, QformTurnsAndMirrors) {
  Nifti file;
  file.type(2);
  file.samples<std::uint8_t>({1});
  file.codes(1, 0);
  file.pixdim(0, -1);
  file.pixdim(1, 2);
  file.pixdim(2, 3);
  file.pixdim(3, 4);
  file.quaternion({0, 1, 0, 5, 6, 7});  // half a turn about y: x and z change sign, and z once more for pixdim[0]
  Warnings heard;
  const Volume volume = file.read(heard.run());
  EXPECT_EQ(volume.spacing, glm::vec3(-2, 3, 4));
  EXPECT_EQ(volume.origin, glm::vec3(5, 6, 7));
  EXPECT_TRUE(heard.lines.empty());
}

TEST(Nifti, SaysThatObliqueAxesAreLeftOut) {
  Nifti file;
  file.type(2);
  file.samples<std::uint8_t>({1});
  file.codes(0, 1);
  file.rows({3, 4, 0, 1, -4, 3, 0, 2, 0, 0, 1, 3});
  Warnings heard;
  const Volume volume = file.read(heard.run());
  EXPECT_EQ(volume.spacing, glm::vec3(5, 5, 1));
  EXPECT_EQ(heard.lines.size(), 1U);
  file.rows({std::nan(""), 0, 0, 1, 0, 0, 0, 2, 0, 0, 1, INFINITY});
  EXPECT_EQ(file.read().spacing, glm::vec3(1, 1, 1));
}

TEST(Nifti, ReadsTheFirstOfSeveralVolumes) {
  Nifti file;
  file.dim(0, 5);
  file.size(2, 1, 1);
  file.dim(4, 1);
  file.dim(5, 3);
  file.type(2);
  file.samples<std::uint8_t>({1, 2, 3, 4, 5, 6});
  Warnings heard;
  EXPECT_EQ(samples_of(file.read(heard.run())), (std::vector<float>{1, 2}));
  EXPECT_EQ(heard.lines.size(), 1U);
}

TEST(Nifti, RefusesWhatItCannotHold) {
  const auto kind = [](const auto& change) {
    Nifti file;
    file.type(2);
    file.samples<std::uint8_t>({1, 2, 3});
    change(file);
    return kind_of_error([&] { file.read(); });
  };
  EXPECT_EQ(kind([](Nifti& file) { file.type(128); }), Error::Unsupported);
  EXPECT_EQ(kind([](Nifti& file) { file.type(32); }), Error::Unsupported);
  EXPECT_EQ(kind([](Nifti& file) { file.type(3); }), Error::Data);
  EXPECT_EQ(kind([](Nifti& file) { file.dim(0, 8); }), Error::Data);
  EXPECT_EQ(kind([](Nifti& file) { file.dim(1, -2); }), Error::Data);
  EXPECT_EQ(kind([](Nifti& file) { file.dim(1, 4); }), Error::Data);
  EXPECT_EQ(kind([](Nifti& file) { file.real(108, -1); }), Error::Data);
  EXPECT_EQ(kind([](Nifti& file) { file.real(108, 1e30); }), Error::Data);
  EXPECT_EQ(kind([](Nifti& file) { file.size(32767, 32767, 32767); }), Error::Resource);
  EXPECT_EQ(kind([](Nifti& file) { file.size(32767, 32767, 1); }), Error::Data) << "fits memory, not the file";
}

TEST(Nifti, NoticesCuts) {
  Nifti file;
  file.size(3, 2, 1);
  file.type(4);
  file.samples<std::int16_t>({1, 2, 3, 4, 5, 6});
  expect_volume_cuts_refused(file.writer.bytes);
  Nifti second(true, true);
  second.type(64);
  second.samples<double>({0.5});
  expect_volume_cuts_refused(second.writer.bytes);
}

TEST(Nifti, FindsTheSamplesOfAPairAndUnpacks) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "nifti-pair";
  fs::create_directories(folder);
  Nifti file;
  file.size(2, 1, 1);
  file.type(2);
  file.real(108, 1);
  file.writer.bytes[345] = std::byte{'i'};
  const auto write = [&](const char* name, std::span<const std::byte> bytes) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  const auto write_packed = [&](const char* name, std::span<const std::byte> bytes) {
    const gzFile packed = gzopen((folder / name).c_str(), "wb");
    gzwrite(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(packed);
  };
  write("pair.hdr", file.writer.bytes);
  const std::string path = (folder / "pair.hdr").string();
  EXPECT_EQ(kind_of_error([&] { read_model(path); }), Error::Data) << "nothing beside it";
  const std::array<std::byte, 3> samples = {std::byte{9}, std::byte{5}, std::byte{6}};
  write("pair.img", samples);
  EXPECT_EQ(samples_of(std::get<Volume>(read_model(path))), (std::vector<float>{5, 6}));
  fs::remove(folder / "pair.img");
  write_packed("pair.img.gz", samples);
  EXPECT_EQ(samples_of(std::get<Volume>(read_model(path))), (std::vector<float>{5, 6}));
  EXPECT_TRUE(is_model_file(path));
  Nifti single;
  single.type(2);
  single.samples<std::uint8_t>({77});
  write_packed("one.nii.gz", single.writer.bytes);
  EXPECT_EQ(samples_of(std::get<Volume>(read_model((folder / "one.nii.gz").string()))), (std::vector<float>{77}));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace azulejo
