#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <zlib.h>

#include "azulejo/io/volume_testing.h"

namespace azulejo {
namespace {

Volume read(const std::string& text, const Run& run = {}) { return read_volume(as_bytes(text), "v.nrrd", {}, run); }

std::string gzipped(const std::string& text) {
  z_stream stream = {};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string result(deflateBound(&stream, text.size()), '\0');
  std::string copy = text;
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

const std::string kShort = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 1 2\n";
const std::string kLittle = kShort + "endian: little\n";
const std::vector<float> kWanted = {1, 2, 258, -1};
const std::string kSamples("\x01\x00\x02\x00\x02\x01\xFF\xFF", 8);
const std::string kSwapped("\x00\x01\x00\x02\x01\x02\xFF\xFF", 8);

TEST(Nrrd, ReadsAllEncodings) {
  EXPECT_EQ(samples_of(read(kLittle + "encoding: raw\n\n" + kSamples)), kWanted);
  EXPECT_EQ(samples_of(read(kShort + "endian: big\nencoding: raw\n\n" + kSwapped)), kWanted);
  EXPECT_EQ(samples_of(read(kLittle + "encoding: gzip\n\n" + gzipped(kSamples))), kWanted);
  EXPECT_EQ(samples_of(read(kLittle + "encoding: hex\n\n01000200\n0201 ffFF\n")), kWanted);
  EXPECT_EQ(samples_of(read(kShort + "encoding: ascii\n\n1 2\n+258,-1")), kWanted);
  EXPECT_EQ(samples_of(read(kShort + "encoding: txt\n\n1 2 258 -1\n")), kWanted);
  EXPECT_EQ(kind_of_error([] { read(kLittle + "encoding: bzip2\n\n" + kSamples); }), Error::Unsupported);
}

TEST(Nrrd, ReadsWindowsLinesCommentsAndKeys) {
  std::string header =
      "NRRD0005\n# made by hand\nType: SHORT\ndimension: 3\nmood:=fine: really\nsizes: 2 1 2\nendian: little\n"
      "encoding: raw\ncontent: a thing\nthicknesses: NaN NaN NaN\n\n";
  std::string windows;
  for (const char each : header) windows += each == '\n' ? std::string("\r\n") : std::string(1, each);
  for (const std::string& text : {header, windows}) {
    const Volume volume = read(text + kSamples);
    EXPECT_EQ(samples_of(volume), kWanted);
    EXPECT_EQ(volume.name, "a thing");
  }
}

TEST(Nrrd, KnowsEveryNameOfAType) {
  const std::map<std::string, std::vector<std::string>> names = {
      {"\xFE", {"signed char", "int8", "int8_t"}},
      {std::string("\xFE\xFF", 2), {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {std::string("\xFE\xFF\xFF\xFF", 4), {"int", "signed int", "int32", "int32_t"}},
      {std::string(1, '\xFE') + std::string(7, '\xFF'),
       {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"}},
      {std::string("\x00\x00\x00\xC0", 4), {"float"}},
      {std::string("\x00\x00\x00\x00\x00\x00\x00\xC0", 8), {"double"}},
  };
  for (const auto& [bytes, list] : names) {
    for (const std::string& name : list) {
      SCOPED_TRACE(name);
      EXPECT_EQ(samples_of(read("NRRD0001\ntype: " + name +
                                "\ndimension: 1\nsizes: 1\nendian: little\nencoding: raw\n\n" + bytes)),
                std::vector<float>{-2});
    }
  }
  for (const std::string name :
       {"uchar", "unsigned char", "uint8", "uint8_t", "ushort", "unsigned short", "unsigned short int", "uint16",
        "uint16_t", "uint", "unsigned int", "uint32", "uint32_t", "ulonglong", "unsigned long long",
        "unsigned long long int", "uint64", "uint64_t"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(samples_of(read(
                  "NRRD0001\ntype: " + name + "\ndimension: 1\nsizes: 1\nendian: little\nencoding: raw\n\n" + "\x81" +
                  std::string(name.find("char") != name.npos || name.find("8") != name.npos ? 0 : 7, '\0'))),
              std::vector<float>{129});
  }
  EXPECT_EQ(kind_of_error([] { read("NRRD0001\ntype: block\ndimension: 1\nsizes: 1\nencoding: raw\n\nx"); }),
            Error::Unsupported);
  EXPECT_EQ(kind_of_error([] { read("NRRD0001\ntype: half\ndimension: 1\nsizes: 1\nencoding: raw\n\nx"); }),
            Error::Data);
}

TEST(Nrrd, PlacesTheGrid) {
  const std::string raw = kLittle + "encoding: raw\n";
  Volume volume = read(raw + "spacings: 0.5 nan 2\naxis mins: 10 20 30\nunits: \"mm\" \"mm\" \"mm\"\n\n" + kSamples);
  EXPECT_EQ(volume.spacing, glm::vec3(0.5F, 1, 2));
  EXPECT_EQ(volume.origin, glm::vec3(10, 20, 30));
  EXPECT_EQ(volume.metres_per_unit, 1e-3F);
  Warnings heard;
  volume = read(raw +
                    "space: left-posterior-superior\nspace directions: (-2, 0,0) (0,3,0) (0,0,4e0)\nspace origin: "
                    "(1,2.5,-3)\nspace units: \"cm\" \"cm\" \"cm\"\n\n" +
                    kSamples,
                heard.run());
  EXPECT_EQ(volume.spacing, glm::vec3(-2, 3, 4));
  EXPECT_EQ(volume.origin, glm::vec3(1, 2.5F, -3));
  EXPECT_EQ(volume.metres_per_unit, 1e-2F);
  EXPECT_TRUE(heard.lines.empty());
  volume =
      read(raw + "space directions: (0,2,0) (3,0,0) (0,0,4)\nunits: \"mm\" \"cm\" \"mm\"\n\n" + kSamples, heard.run());
  EXPECT_EQ(volume.spacing, glm::vec3(2, 3, 4));
  EXPECT_EQ(volume.metres_per_unit, 0);
  EXPECT_EQ(heard.lines.size(), 1U) << "turned axes are told";
}

TEST(Nrrd, ReadsTheFirstOfAList) {
  const std::string uchar = "NRRD0004\ntype: uchar\nencoding: raw\n";
  Warnings heard;
  const auto check = [&](const std::string& fields, const std::vector<float>& wanted) {
    SCOPED_TRACE(fields);
    heard.lines.clear();
    EXPECT_EQ(samples_of(read(uchar + fields + "\n\x01\x02\x03\x04\x05\x06", heard.run())), wanted);
    EXPECT_EQ(heard.lines.size(), 1U);
  };
  check("dimension: 4\nsizes: 3 2 1 1\nkinds: vector domain domain domain\n", {1, 4});
  check("dimension: 4\nsizes: 3 2 1 1\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n", {1, 4});
  check("dimension: 4\nsizes: 3 1 1 2\nkinds: space space space list\n", {1, 2, 3});
  check("dimension: 4\nsizes: 3 1 1 2\n", {1, 2, 3});
  check("dimension: 3\nsizes: 2 3 1\nkinds: 2-vector domain domain\n", {1, 3, 5});
  const std::string text = "NRRD0004\ntype: float\nencoding: text\ndimension: 2\nsizes: 3 2\nkinds: list domain\n\n";
  EXPECT_EQ(samples_of(read(text + "0.1 2 3 4 5 6")), (std::vector<float>{0.1F, 4}));
  EXPECT_EQ(kind_of_error([&] { read(uchar + "dimension: 5\nsizes: 1 1 1 1 1\n\nx"); }), Error::Unsupported);
  EXPECT_EQ(kind_of_error([&] { read(uchar + "dimension: 2\nsizes: 1 1\nkinds: list list\n\nx"); }),
            Error::Unsupported);
}

TEST(Nrrd, SkipsLinesAndBytes) {
  EXPECT_EQ(samples_of(read(kLittle + "encoding: raw\nline skip: 2\nbyte skip: 3\n\na\nbcd\nxyz" + kSamples)), kWanted);
  EXPECT_EQ(samples_of(read(kLittle + "encoding: raw\nbyteskip: -1\n\nany bytes at all" + kSamples)), kWanted);
  EXPECT_EQ(samples_of(read(kLittle + "encoding: gz\nline skip: 1\nbyte skip: 4\n\nl\n" + gzipped("abcd" + kSamples))),
            kWanted);
  EXPECT_EQ(kind_of_error([] { read(kLittle + "encoding: raw\nbyte skip: -2\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read(kLittle + "encoding: raw\nline skip: 9000000000\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read(kLittle + "encoding: raw\nbyte skip: 9223372036854775807\n\n" + kSamples); }),
            Error::Data);
}

TEST(Nrrd, FindsDetachedSamples) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "nrrd-detached";
  fs::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("v.nhdr", kLittle + "encoding: raw\nbyte skip: 1\ndata file: v.raw\n");
  EXPECT_EQ(kind_of_error([&] { read_model((folder / "v.nhdr").string()); }), Error::Data) << "nothing beside it";
  write("v.raw", "x" + kSamples);
  EXPECT_EQ(samples_of(std::get<Volume>(read_model((folder / "v.nhdr").string()))), kWanted);
  write("v.nhdr", kLittle + "encoding: raw\ndatafile: ../v.raw\n");
  EXPECT_EQ(kind_of_error([&] { read_model((folder / "v.nhdr").string()); }), Error::Data) << "leaves the folder";
  for (const std::string several : {"LIST", "v%03d.raw 1 3 1"}) {
    write("v.nhdr", kLittle + "encoding: raw\ndata file: " + several + "\n");
    EXPECT_EQ(kind_of_error([&] { read_model((folder / "v.nhdr").string()); }), Error::Unsupported);
  }
  fs::remove_all(folder);
}

TEST(Nrrd, RefusesBadHeaders) {
  const std::string good = kLittle + "encoding: raw\n";
  EXPECT_EQ(kind_of_error([] { read("NRRD0006\n\n"); }), Error::Unsupported);
  EXPECT_EQ(kind_of_error([&] { read(good + "nonsense\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([&] { read(good + "spacings: 1 2\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([&] { read(good + "sizes: 2 -1 2\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([&] { read(good + "sizes: 2 x 2\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([&] { read(good + "sizes: 99999 99999 99999\n\n" + kSamples); }), Error::Resource);
  EXPECT_EQ(kind_of_error([&] { read(good + "sizes: 9999 9999 9\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([&] { read(good + "space directions: (1,0,0) (0,1,0,0) (0,0,1)\n\n" + kSamples); }),
            Error::Unsupported);
  EXPECT_EQ(kind_of_error([&] { read(good + "dimension: 1000000\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([&] { read(kShort + "encoding: raw\n\n" + kSamples); }), Error::Data) << "no endian";
  EXPECT_EQ(kind_of_error([&] { read(good + std::string(5000, 'x') + "\n\n" + kSamples); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read(kShort + "encoding: text\n\n1 2 3"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read(kShort + "encoding: text\n\n1 2 3 q"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read(kLittle + "encoding: hex\n\n01000200020xffff"); }), Error::Data);
}

TEST(Nrrd, NoticesCuts) {
  for (const std::string& whole :
       {kLittle + "encoding: raw\n\n" + kSamples, kLittle + "encoding: hex\n\n010002000201ffff",
        kLittle + "encoding: gzip\n\n" + gzipped(kSamples)}) {
    expect_volume_cuts_refused(as_bytes(whole), 0);
  }
}

}  // namespace
}  // namespace azulejo
