// INRIMAGE-4: a header of text in blocks of 256 bytes, then the samples.
// Source: "The INRIMAGE-4 format", as CGAL's documentation of ImageIO describes it.

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <map>
#include <span>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/volume_grid.h"
#include "azulejo/io/volume_samples.h"

namespace azulejo {
namespace {

constexpr std::string_view kMagic = "#INRIMAGE-4#{";
constexpr std::string_view kEnd = "##}";
constexpr std::size_t kBlock = 256;
constexpr std::size_t kLongest = 256 * kBlock;

using Fields = std::map<std::string, std::string, std::less<>>;

struct Header {
  Fields fields;
  std::size_t bytes = 0;
};

Header read_header(const Input& input) {
  std::string text(std::min<std::uint64_t>(kLongest, input.size()), '\0');
  text.resize(input.read(0, std::as_writable_bytes(std::span(text))));
  const std::size_t end = text.find(kEnd);
  if (!text.starts_with(kMagic) || end == std::string::npos) {
    throw Error(Error::Data, fmt::format("{}: a header from {} to {} expected", input.name(), kMagic, kEnd));
  }
  Header header;
  header.bytes = (end + kEnd.size() + kBlock - 1) / kBlock * kBlock;
  for (std::size_t begin = kMagic.size(); begin < end;) {
    const std::size_t stop = std::min(text.find('\n', begin), end);
    const std::size_t equals = std::min(text.find('=', begin), stop);
    const bool comment = text[begin] == '#';
    if (equals < stop && !comment) {
      const std::size_t last = text.find_last_not_of(" \r", stop - 1);
      header.fields[text.substr(begin, equals - begin)] = text.substr(equals + 1, last - equals);
    }
    begin = stop + 1;
  }
  return header;
}

template <class T>
T number(const Fields& fields, const char* name, T otherwise, const std::string& file) {
  const auto field = fields.find(name);
  if (field == fields.end()) return otherwise;
  T value = {};
  const char* const end = field->second.data() + field->second.size();
  const auto [rest, failure] = std::from_chars(field->second.data(), end, value);
  if (failure == std::errc() && rest == end) return value;
  throw Error(Error::Data, fmt::format("{}: {}={}, a number expected", file, name, field->second));
}

std::string text(const Fields& fields, const char* name) {
  const auto field = fields.find(name);
  return field == fields.end() ? std::string() : field->second;
}

SampleType sample_type(const Fields& fields, const std::string& file) {
  static const std::map<std::string, SampleType, std::less<>> kTypes = {
      {"float 32 bits", SampleType::F32},          {"float 64 bits", SampleType::F64},
      {"unsigned fixed 8 bits", SampleType::U8},   {"signed fixed 8 bits", SampleType::I8},
      {"unsigned fixed 16 bits", SampleType::U16}, {"signed fixed 16 bits", SampleType::I16},
      {"unsigned fixed 32 bits", SampleType::U32}, {"signed fixed 32 bits", SampleType::I32},
  };
  const std::string type = text(fields, "TYPE") + " " + text(fields, "PIXSIZE");
  const auto found = kTypes.find(type);
  if (found != kTypes.end()) return found->second;
  throw Error(Error::Unsupported, fmt::format("{}: samples '{}', expected floats or fixed numbers", file, type));
}

Model read_inrimage(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  const std::string& name = file.input->name();
  const Header header = read_header(*file.input);
  const Fields& fields = header.fields;
  SampleLayout layout{.type = sample_type(fields, name), .begin = header.bytes};
  const std::string processor = text(fields, "CPU");
  if (processor == "sun" || processor == "sgi") layout.order = std::endian::big;
  const auto values = number<std::int64_t>(fields, "VDIM", 1, name);
  if (values < 1 || values > kMostComponents) {
    throw Error(Error::Data, fmt::format("{}: VDIM={}, 1–{} expected", name, values, kMostComponents));
  }
  layout.components = static_cast<std::uint32_t>(values);
  if (values > 1) warn(run, fmt::format("{}: the first of its {} values a sample is read", name, values));
  Volume volume;
  const auto size = [&](const char* field) { return number<std::int64_t>(fields, field, 1, name); };
  set_size(volume, {size("XDIM"), size("YDIM"), size("ZDIM")}, name, run);
  GridPlacement placement;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr const char* kSteps[] = {"VX", "VY", "VZ"};
    constexpr const char* kOrigins[] = {"TX", "TY", "TZ"};
    placement.axes[i][i] = number<double>(fields, kSteps[i], 1, name);
    placement.origin[i] = number<double>(fields, kOrigins[i], 0, name);
  }
  set_placement(volume, placement, name, run);
  volume.metres_per_unit = options.metres_per_unit.value_or(0.0F);
  read_samples(*file.input, layout, volume, run);
  return volume;
}

bool matches(std::span<const std::byte> head, std::uint64_t, std::string_view) {
  return head.size() >= kMagic.size() && std::memcmp(head.data(), kMagic.data(), kMagic.size()) == 0;
}

}  // namespace

extern const ModelCodec kInrimage;
const ModelCodec kInrimage = {"inrimage", {"inr"}, matches, read_inrimage, nullptr, nullptr};

}  // namespace azulejo
