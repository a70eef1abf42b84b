#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"
#include "azulejo/io/decoded_size.h"
#include "azulejo/io/pnm.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kLargestMaximum = 65535;
constexpr std::size_t kLongestWord = 64;

bool is_space(int byte) { return byte == ' ' || (byte >= '\t' && byte <= '\r'); }

/// The next word of the header; comments go from # to the end of the line. Takes the one blank behind it.
std::string word(ByteReader& reader) {
  int byte = reader.byte();
  for (;;) {
    while (is_space(byte)) byte = reader.byte();
    if (byte != '#') break;
    while (byte != '\n' && byte != '\r') byte = reader.byte();
  }
  std::string result;
  while (!is_space(byte)) {
    if (result.size() == kLongestWord) throw reader.error(Error::Data, "a number expected in the header");
    result.push_back(static_cast<char>(byte));
    byte = reader.byte();
  }
  return result;
}

template <class T>
T parsed(const ByteReader& reader, std::string_view text, const char* what) {
  T value = {};
  const char* const end = text.data() + text.size();
  const auto [rest, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc() || rest != end) {
    throw reader.error(Error::Data, fmt::format("header: {} is '{}', a number expected", what, text));
  }
  return value;
}

template <class T>
T number(ByteReader& reader, const char* what) {
  const std::string text = word(reader);
  return parsed<T>(reader, text, what);
}

void set_maximum(const ByteReader& reader, std::uint32_t maximum, PnmHeader& header) {
  if (maximum < 1 || maximum > kLargestMaximum) {
    throw reader.error(Error::Data, fmt::format("header: the maximum is {}, 1–{} expected", maximum, kLargestMaximum));
  }
  header.maximum = maximum;
  header.info.type = maximum > 255 ? PixelType::U16 : PixelType::U8;
}

struct Size {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
};

std::string line(ByteReader& reader) {
  std::string result;
  for (int byte = reader.byte(); byte != '\n'; byte = reader.byte()) {
    if (result.size() == 1024) throw reader.error(Error::Data, "header: a line is longer than 1024 bytes");
    result.push_back(static_cast<char>(byte));
  }
  return result;
}

/// PAM's lines "NAME value" up to ENDHDR.
Size read_pam_lines(ByteReader& reader, PnmHeader& header) {
  Size size;
  std::string kind;
  std::uint32_t depth = 0;
  std::uint32_t maximum = 0;
  line(reader);  // what is left of "P7"
  for (std::string text = line(reader); !text.starts_with("ENDHDR"); text = line(reader)) {
    const std::size_t blank = text.find_first_of(" \t");
    const std::string_view name = std::string_view(text).substr(0, blank);
    std::string_view value = blank == std::string::npos ? "" : std::string_view(text).substr(blank);
    while (!value.empty() && is_space(value.front())) value.remove_prefix(1);
    while (!value.empty() && is_space(value.back())) value.remove_suffix(1);
    if (name == "WIDTH") size.width = parsed<std::uint32_t>(reader, value, "WIDTH");
    if (name == "HEIGHT") size.height = parsed<std::uint32_t>(reader, value, "HEIGHT");
    if (name == "DEPTH") depth = parsed<std::uint32_t>(reader, value, "DEPTH");
    if (name == "MAXVAL") maximum = parsed<std::uint32_t>(reader, value, "MAXVAL");
    if (name == "TUPLTYPE") kind = value;
  }
  if (depth < 1) throw reader.error(Error::Data, "header: DEPTH of 1 or more expected");
  if (depth > 4) throw reader.error(Error::Unsupported, fmt::format("header: DEPTH is {}, at most 4 are read", depth));
  header.info.channels = static_cast<int>(depth);
  if (kind.ends_with("_ALPHA") && depth % 2 == 0) header.info.alpha = AlphaState::Straight;
  set_maximum(reader, maximum, header);
  return size;
}

Size read_words(ByteReader& reader, PnmHeader& header) {
  Size size;
  size.width = number<std::uint32_t>(reader, "width");
  size.height = number<std::uint32_t>(reader, "height");
  header.info.channels = header.kind == '3' || header.kind == '6' || header.kind == 'F' ? 3 : 1;
  if (header.bits()) {
    header.maximum = 1;
  } else if (header.floats()) {
    const auto scale = number<double>(reader, "scale");
    if (scale == 0 || !std::isfinite(scale)) throw reader.error(Error::Data, "header: a scale other than 0 expected");
    header.little_endian = scale < 0;
    header.scale = std::abs(scale);
    header.info.type = PixelType::F32;
    header.info.color = ColorState::Linear;
  } else {
    set_maximum(reader, number<std::uint32_t>(reader, "maximum"), header);
  }
  return size;
}

}  // namespace

std::uint64_t PnmHeader::raw_row_bytes() const {
  const auto width = static_cast<std::uint64_t>(info.width);
  return bits() ? (width + 7) / 8 : static_cast<std::uint64_t>(info.row_bytes());
}

PnmHeader read_pnm_header(const std::shared_ptr<const Input>& input, const Run& run) {
  ByteReader reader(input, 1);
  PnmHeader header;
  header.kind = static_cast<char>(reader.byte());
  const Size size = header.kind == '7' ? read_pam_lines(reader, header) : read_words(reader, header);
  check_decoded_size(input->name(), size.width, size.height, run);
  header.info.width = static_cast<int>(size.width);
  header.info.height = static_cast<int>(size.height);
  header.pixels = reader.position();
  // Plain samples take a byte at least (bits need no blanks between them).
  const std::uint64_t row =
      header.plain() ? size.width * static_cast<std::uint64_t>(header.info.channels) : header.raw_row_bytes();
  const std::uint64_t there = input->size() - std::min(header.pixels, input->size());
  if (there / row < size.height) {
    throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early: {} bytes of pixels, {} expected",
                                         input->name(), input->size(), there, row * size.height));
  }
  return header;
}

}  // namespace azulejo
