#include "azulejo/io/gzip.h"

#include <zlib.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_testing.h"

namespace azulejo {
namespace {

std::string packed(const std::string& text) {
  z_stream stream = {};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string result(deflateBound(&stream, text.size()) + 32, '\0');
  std::string source = text;
  stream.next_in = reinterpret_cast<Bytef*>(source.data());
  stream.avail_in = static_cast<uInt>(source.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

std::string unpacked(const std::string& file, std::int64_t limit = std::int64_t{1} << 30) {
  const auto input = unpack_gzip(*memory_input(bytes_of(file), "x.gz"), limit);
  EXPECT_EQ(input->name(), "x.gz");
  return text_of(input->read_all(limit));
}

std::string some_text(std::size_t size) {
  std::mt19937 random(3);
  std::string text;
  while (text.size() < size) text += std::to_string(random() % 1000) + ' ';
  text.resize(size);
  return text;
}

TEST(Gzip, GivesBackWhatWasPacked) {
  for (const std::size_t size : {0, 1, 1000, 262'143, 262'144, 262'145, 3'000'000}) {
    const std::string text = some_text(size);
    const std::string file = packed(text);
    EXPECT_TRUE(is_gzip(*memory_input(bytes_of(file), "x.gz")));
    EXPECT_TRUE(unpacked(file) == text) << size;
  }
  EXPECT_FALSE(is_gzip(*memory_input(bytes_of("\x1F"), "x.gz")));
  EXPECT_FALSE(is_gzip(*memory_input(bytes_of("ply\n"), "x.gz")));
}

TEST(Gzip, PartsAreJoinedAndPaddingIsNot) {
  const std::string text = some_text(400'000);
  EXPECT_TRUE(unpacked(packed(text) + packed("") + packed("the end")) == text + "the end");
  EXPECT_EQ(unpacked(packed("a") + std::string(100, '\0')), "a");
}

TEST(Gzip, CutOrDamagedIsSaid) {
  const std::string file = packed(some_text(5000));
  for (std::size_t length = 2; length < file.size(); ++length) {
    const std::string message = error_of([&] { unpacked(file.substr(0, length)); });
    EXPECT_EQ(message, "x.gz: byte " + std::to_string(length) + ": damaged gzip: the file ends too early");
  }
  std::string damaged = file;
  damaged[file.size() - 6] ^= 1;  // the checksum
  EXPECT_EQ(error_of([&] { unpacked(damaged); }).find("x.gz: byte "), 0U);
  EXPECT_EQ(kind_of_error([&] { unpacked(damaged); }), Error::Data);
}

TEST(Gzip, IsBounded) {
  const std::string file = packed(std::string(10'000'000, 'a'));
  EXPECT_EQ(kind_of_error([&] { unpacked(file, 9'999'999); }), Error::Resource);
  EXPECT_EQ(unpacked(file, 10'000'000).size(), 10'000'000U);
}

TEST(Gzip, LengthInTheFileIsNotTrusted) {
  const std::string text = some_text(300'000);
  std::string file = packed(text + "x");
  const std::string other = packed(text);
  // A second part that is empty says 0; zlib checks each part's own.
  EXPECT_TRUE(unpacked(other + packed("")) == text);
  file.replace(file.size() - 4, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_EQ(kind_of_error([&] { unpacked(file); }), Error::Data);
}

TEST(Gzip, Heads) {
  const std::string text = some_text(5000);
  const std::string file = packed(text);
  const auto head = [](const std::string& bytes, std::size_t count) {
    return text_of(unpack_gzip_head(*memory_input(bytes_of(bytes), "x.gz"), count));
  };
  EXPECT_EQ(head(file, 512), text.substr(0, 512));
  EXPECT_EQ(head(file, 9000), text);
  EXPECT_EQ(head("\x1F\x8Bnonsense", 512), "");
}

}  // namespace
}  // namespace azulejo
