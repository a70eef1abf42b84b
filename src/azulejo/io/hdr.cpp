// Radiance pictures (Ward, "Real Pixels", Graphics Gems II; Larson & Shakespeare, Rendering with Radiance, "The
// Picture File Format"). Decoded here, not by stb: that one reads neither the older run lengths nor other scan
// directions, and takes a file that ends early for a black one.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "azulejo/io/byte_reader.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/decoded_size.h"

namespace azulejo {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kMostLines = 1000;
constexpr int kExponentBias = 128;
constexpr int kMantissaBits = 8;
// Run lengths of the newer kind are for these widths only.
constexpr int kNarrowestRuns = 8;
constexpr int kWidestRuns = 32767;
constexpr int kLongestRun = 127;
constexpr int kLongestLiteral = 128;

bool matches(std::span<const std::byte> head, std::string_view) {
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

std::string read_line(ByteReader& reader) {
  std::string line;
  for (char c = static_cast<char>(reader.byte()); c != '\n'; c = static_cast<char>(reader.byte())) {
    if (line.size() == kLongestLine) throw reader.error(Error::Data, "a header line of more than 4096 characters");
    line += c;
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

/// "-Y 512 +X 1024": how many scan lines, how long, and EXIF's word for where they start and go.
struct Resolution {
  std::uint64_t lines = 0;
  std::uint64_t length = 0;
  int orientation = 1;
};

Resolution parse_resolution(const ByteReader& reader, const std::string& line) {
  constexpr std::array<std::pair<const char*, const char*>, 8> kAxes{
      {{"-Y", "+X"}, {"-Y", "-X"}, {"+Y", "-X"}, {"+Y", "+X"}, {"+X", "-Y"}, {"-X", "-Y"}, {"-X", "+Y"}, {"+X", "+Y"}}};
  const char* end = line.data() + line.size();
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    Resolution result{.orientation = static_cast<int>(i) + 1};
    if (!line.starts_with(fmt::format("{} ", kAxes[i].first))) continue;
    const auto lines = std::from_chars(line.data() + 3, end, result.lines);
    if (lines.ec != std::errc{}) continue;
    const std::string_view rest(lines.ptr, static_cast<std::size_t>(end - lines.ptr));
    if (!rest.starts_with(fmt::format(" {} ", kAxes[i].second))) continue;
    const auto length = std::from_chars(rest.data() + 4, end, result.length);
    if (length.ec == std::errc{} && length.ptr == end) return result;
  }
  throw reader.error(Error::Data, fmt::format("resolution \"{}\"; \"-Y height +X width\" expected", line));
}

/// What a mantissa of 1 stands for.
float scale_of(std::uint8_t exponent) { return std::ldexp(1.0F, exponent - (kExponentBias + kMantissaBits)); }

class HdrDecoder : public Decoder {
 public:
  HdrDecoder(std::shared_ptr<const Input> input, const Run& run);
  void read(const AnyView& rows) override;

 private:
  void read_header(const Run& run);
  void read_scan_line();
  void read_component_runs(std::size_t component);
  void read_pixels(Rgbe first);

  ByteReader reader_;
  std::vector<Rgbe> line_;
};

HdrDecoder::HdrDecoder(std::shared_ptr<const Input> input, const Run& run) : reader_(std::move(input)) {
  read_header(run);
}

void HdrDecoder::read_header(const Run& run) {
  const std::string magic = read_line(reader_);
  if (magic != "#?RADIANCE" && magic != "#?RGBE") throw reader_.error(Error::Data, "no \"#?RADIANCE\" at the start");
  ImageFile& file = header_.file;
  std::string format;
  std::size_t lines = 0;
  for (std::string line = read_line(reader_); !line.empty(); line = read_line(reader_)) {
    if (++lines > kMostLines) throw reader_.error(Error::Data, "a header of more than 1000 lines");
    const std::size_t equals = line.find('=');
    if (line[0] == '#' || equals == std::string::npos) continue;
    const std::string key = line.substr(0, equals);
    if (key == "FORMAT") {
      format = line.substr(equals + 1);
    } else {
      file.metadata.text[key] = line.substr(equals + 1);
    }
  }
  if (format != "32-bit_rle_rgbe") {
    throw reader_.error(format.empty() ? Error::Data : Error::Unsupported,
                        fmt::format("FORMAT \"{}\"; \"32-bit_rle_rgbe\" expected", format));
  }
  const Resolution resolution = parse_resolution(reader_, read_line(reader_));
  check_decoded_size(reader_.name(), resolution.length, resolution.lines, run);
  file.format = "hdr";
  file.info = {static_cast<int>(resolution.length),
               static_cast<int>(resolution.lines),
               3,
               PixelType::F32,
               ColorState::Linear,
               AlphaState::None};
  file.stored_width = file.info.width;
  file.stored_height = file.info.height;
  file.encoding = "RGBE";
  file.orientation = resolution.orientation;
  line_.resize(resolution.length);
}

void HdrDecoder::read_scan_line() {
  Rgbe start;
  reader_.read(start);
  const bool runs =
      start[0] == 2 && start[1] == 2 && start[2] < 128 && line_.size() >= kNarrowestRuns && line_.size() <= kWidestRuns;
  if (!runs) {
    read_pixels(start);
    return;
  }
  const std::size_t length = std::size_t{start[2]} << 8 | start[3];
  if (length != line_.size()) {
    throw reader_.error(Error::Data, fmt::format("a scan line of {} pixels, {} expected", length, line_.size()));
  }
  for (std::size_t component = 0; component < 4; ++component) read_component_runs(component);
}

/// Runs of one component of the scan line: n > 128: a value n − 128 times, else n values.
void HdrDecoder::read_component_runs(std::size_t component) {
  for (std::size_t x = 0; x < line_.size();) {
    const std::size_t code = reader_.byte();
    const bool repeat = code > kLongestLiteral;
    const std::size_t count = repeat ? code - kLongestLiteral : code;
    if (count == 0 || count > line_.size() - x) {
      throw reader_.error(Error::Data, fmt::format("a run of {} where {} pixels are left", count, line_.size() - x));
    }
    std::uint8_t value = repeat ? reader_.byte() : std::uint8_t{0};
    for (std::size_t i = 0; i < count; ++i) {
      if (!repeat) value = reader_.byte();
      line_[x++][component] = value;
    }
  }
}

/// Whole pixels, where 1, 1, 1, n repeats the one before n times; such pixels in a row are the bytes of one count.
void HdrDecoder::read_pixels(Rgbe first) {
  std::size_t shift = 0;
  Rgbe pixel = first;
  for (std::size_t x = 0; x < line_.size();) {
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      const std::size_t count = shift < 32 ? std::size_t{pixel[3]} << shift : line_.size();
      if (x == 0 || count > line_.size() - x) {
        throw reader_.error(Error::Data, fmt::format("a run of {} at pixel {} of {}", count, x, line_.size()));
      }
      std::fill_n(line_.begin() + static_cast<std::ptrdiff_t>(x), count, line_[x - 1]);
      x += count;
      shift += 8;
    } else {
      line_[x++] = pixel;
      shift = 0;
    }
    if (x < line_.size()) reader_.read(pixel);
  }
}

void HdrDecoder::read(const AnyView& rows) {
  for (int y = 0; y < rows.height(); ++y) {
    read_scan_line();
    float* result = rows.as<float>().row(y);
    for (const Rgbe& pixel : line_) {
      const float scale = scale_of(pixel[3]);
      for (std::size_t i = 0; i < 3; ++i) *result++ = static_cast<float>(pixel[i]) * scale;
    }
  }
}

std::unique_ptr<Decoder> decode(std::shared_ptr<const Input> input, const ReadOptions&, const Run& run) {
  return std::make_unique<HdrDecoder>(std::move(input), run);
}

ImageInfo storable(const ImageInfo& info, const WriteOptions&) {
  if (info.alpha == AlphaState::None && info.channels % 2 == 0) {
    throw Error(Error::Unsupported,
                fmt::format("Radiance HDR can't hold {} channels; TIFF and OpenEXR can", info.channels));
  }
  ImageInfo result = info;
  result.type = PixelType::F32;
  result.channels = 3;
  result.alpha = AlphaState::None;
  if (result.color == ColorState::Srgb) result.color = ColorState::Linear;
  return result;
}

class HdrEncoder : public Encoder {
 public:
  HdrEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const Run& run);
  void write(const ConstAnyView& rows) override;
  void finish() override;

 private:
  Rgbe to_rgbe(const float* rgb);
  void append_line();
  void append_runs(std::size_t component);

  Output& output_;
  Run run_;
  std::vector<Rgbe> line_;
  std::vector<std::uint8_t> bytes_;
  bool clipped_ = false;
};

HdrEncoder::HdrEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const Run& run)
    : output_(output), run_(run), line_(static_cast<std::size_t>(info.width)) {
  std::string header = "#?RADIANCE\n";
  for (const auto& [key, text] : metadata.text) {
    const std::string line = fmt::format("{}={}\n", key, text);
    const bool usable = key != "FORMAT" && !key.empty() && key[0] != '#' && key.find('=') == std::string::npos &&
                        line.find_first_of(std::string_view("\n\r\0", 3)) == line.size() - 1 &&
                        line.size() < kLongestLine;
    if (usable) header += line;
  }
  header += fmt::format("FORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", info.height, info.width);
  output_.write(std::as_bytes(std::span(header)));
}

/// The exponent that the largest component asks for, mantissas rounded: at most 1/256 of the largest off.
Rgbe HdrEncoder::to_rgbe(const float* rgb) {
  std::array<float, 3> value{};
  for (std::size_t i = 0; i < 3; ++i) {
    // The largest value of the format is 255 · 2^119.
    const float largest = 255 * scale_of(255);
    value[i] = rgb[i] > 0 ? std::min(rgb[i], largest) : 0.0F;
    clipped_ |= value[i] != rgb[i];
  }
  int exponent = 0;
  const float most = std::max({value[0], value[1], value[2]});
  std::frexp(most, &exponent);
  // A mantissa that rounds up to 256 takes the next exponent.
  if (std::nearbyint(std::ldexp(most, kMantissaBits - exponent)) > 255) ++exponent;
  if (most == 0 || exponent + kExponentBias < 1) return {};
  Rgbe result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(std::nearbyint(std::ldexp(value[i], kMantissaBits - exponent)));
  }
  result[3] = static_cast<std::uint8_t>(exponent + kExponentBias);
  return result;
}

void HdrEncoder::append_runs(std::size_t component) {
  const auto value = [&](std::size_t x) { return line_[x][component]; };
  const auto run_at = [&](std::size_t x) {
    std::size_t end = x + 1;
    while (end < line_.size() && end - x < kLongestRun && value(end) == value(x)) ++end;
    return end - x;
  };
  constexpr std::size_t kWorthwhile = 3;
  for (std::size_t x = 0; x < line_.size();) {
    if (const std::size_t run = run_at(x); run >= kWorthwhile) {
      bytes_.push_back(static_cast<std::uint8_t>(kLongestLiteral + run));
      bytes_.push_back(value(x));
      x += run;
      continue;
    }
    const std::size_t code = bytes_.size();
    bytes_.push_back(0);
    for (; x < line_.size() && bytes_[code] < kLongestLiteral && run_at(x) < kWorthwhile; ++x) {
      bytes_.push_back(value(x));
      ++bytes_[code];
    }
  }
}

void HdrEncoder::append_line() {
  if (line_.size() < kNarrowestRuns || line_.size() > kWidestRuns) {
    for (const Rgbe& pixel : line_) bytes_.insert(bytes_.end(), pixel.begin(), pixel.end());
    return;
  }
  const auto width = static_cast<unsigned>(line_.size());
  for (const unsigned each : {2U, 2U, width >> 8, width & 255U}) bytes_.push_back(static_cast<std::uint8_t>(each));
  for (std::size_t component = 0; component < 4; ++component) append_runs(component);
}

void HdrEncoder::write(const ConstAnyView& rows) {
  for (int y = 0; y < rows.height(); ++y) {
    const float* source = rows.as<float>().row(y);
    for (std::size_t x = 0; x < line_.size(); ++x) line_[x] = to_rgbe(source + 3 * x);
    bytes_.clear();
    append_line();
    output_.write(std::as_bytes(std::span(bytes_)));
  }
}

void HdrEncoder::finish() {
  if (clipped_) warn(run_, fmt::format("{}: negative, infinite or NaN values were clipped", output_.name()));
}

std::unique_ptr<Encoder> encode(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions&,
                                const Run& run) {
  return std::make_unique<HdrEncoder>(output, info, metadata, run);
}

}  // namespace

extern const Codec kHdrCodec;
const Codec kHdrCodec{"hdr", {"hdr", "pic", "rgbe"}, matches, decode, storable, encode};

}  // namespace azulejo
