#include "azulejo/io/gltf_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "azulejo/io/byte_reader.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;  ///< "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::uint64_t kHeader = 12;
constexpr std::uint64_t kJsonBlowUp = 32;  ///< bytes of parsed JSON for one of text, at worst

/// Extensions that a file may require: read, or without effect on what is read.
constexpr std::array<std::string_view, 9> kKnown = {
    "KHR_lights_punctual",
    "KHR_texture_transform",
    "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",
    "KHR_node_visibility",
    "EXT_texture_webp",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "EXT_meshopt_compression",  // its buffer views may have a fallback: looked at one by one
};

bool is_known(const std::string& extension) {
  return extension.starts_with("KHR_materials_") || std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

int hex_digit(char letter) {
  if (letter >= '0' && letter <= '9') return letter - '0';
  const char lower = static_cast<char>(letter | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// False where it is malformed.
bool decode_percent(std::string_view text, std::vector<std::byte>& bytes) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      bytes.push_back(static_cast<std::byte>(text[i]));
      continue;
    }
    if (i + 2 >= text.size()) return false;
    const int high = hex_digit(text[i + 1]);
    const int low = hex_digit(text[i + 2]);
    if (high < 0 || low < 0) return false;
    bytes.push_back(static_cast<std::byte>(high * 16 + low));
    i += 2;
  }
  return true;
}

constexpr std::array<std::int8_t, 256> base64_digits() {
  std::array<std::int8_t, 256> digits = {};
  digits.fill(-1);
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kLetters.size(); ++i) {
    digits[static_cast<unsigned char>(kLetters[i])] = static_cast<std::int8_t>(i);
  }
  digits['-'] = 62;  // the form for URLs
  digits['_'] = 63;
  return digits;
}

/// False where it is malformed. The padding may be missing.
bool decode_base64(std::string_view text, std::vector<std::byte>& bytes) {
  static constexpr std::array<std::int8_t, 256> kDigits = base64_digits();
  for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
  if (text.size() % 4 == 1) return false;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char letter : text) {
    const std::int8_t digit = kDigits[static_cast<unsigned char>(letter)];
    if (digit < 0) return false;
    bits = (bits << 6) | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> count));
    }
  }
  return true;
}

}  // namespace

GltfFile::GltfFile(const ModelFile& file, const ModelReadOptions& options, const Run& run)
    : file_(file), options_(options), run_(run) {
  std::array<std::byte, 4> head = {};
  const std::size_t count = file_.input->read(0, head);
  const bool binary = count == 4 && ByteReader(file_.input).le32() == kMagic;
  binary ? read_binary() : read_text();
  check_asset();
  read_views();
}

std::vector<std::byte> GltfFile::read_bytes(std::uint64_t offset, std::uint64_t count) {
  bytes_read_ += count;
  if (bytes_read_ > static_cast<std::uint64_t>(run_.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("{}: {} bytes to hold, the limit of memory is {}", name(), bytes_read_,
                                             run_.limits.memory_bytes));
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(count));
  ByteReader(file_.input, offset).read(std::span(bytes));
  return bytes;
}

void GltfFile::read_binary() {
  ByteReader reader(file_.input, 4);
  const std::uint32_t version = reader.le32();
  if (version != 2) {
    throw Error(Error::Unsupported, fmt::format("{}: GLB version {}, expected 2", name(), version));
  }
  const std::uint64_t size = reader.le32();
  if (size > reader.size()) {
    throw reader.error(Error::Data, fmt::format("{} bytes said, the file has {}", size, reader.size()));
  }
  if (size < reader.size()) warn(fmt::format("{} bytes behind its end are ignored", reader.size() - size));
  std::uint64_t place = kHeader;
  while (place + 8 <= size) {
    reader.seek(place);
    const std::uint64_t length = reader.le32();
    const std::uint32_t kind = reader.le32();
    if (length > size - place - 8) {
      throw reader.error(Error::Data, fmt::format("a chunk of {} bytes, {} are left", length, size - place - 8));
    }
    if (place == kHeader) {
      if (kind != kJsonChunk) throw reader.error(Error::Data, "the first chunk isn't JSON");
      if (length > static_cast<std::uint64_t>(run_.limits.memory_bytes) / kJsonBlowUp) {
        throw Error(Error::Resource, fmt::format("{}: {} bytes of JSON, the limit of memory is {}", name(), length,
                                                 run_.limits.memory_bytes));
      }
      const std::vector<std::byte> text = read_bytes(place + 8, length);
      text_ = std::make_unique<GltfText>(std::string_view(reinterpret_cast<const char*>(text.data()), text.size()),
                                         name(), place + 8);
    } else if (kind == kBinaryChunk && !has_binary_) {
      has_binary_ = true;
      binary_offset_ = place + 8;
      binary_size_ = length;
    }
    place += 8 + (length + 3) / 4 * 4;  // chunks begin at multiples of 4, whatever their length says
  }
  if (text_ == nullptr) throw reader.error(Error::Data, "no JSON chunk");
}

void GltfFile::read_text() {
  const std::uint64_t size = file_.input->size();
  if (size > static_cast<std::uint64_t>(run_.limits.memory_bytes) / kJsonBlowUp) {
    throw Error(Error::Resource,
                fmt::format("{}: {} bytes of JSON, the limit of memory is {}", name(), size, run_.limits.memory_bytes));
  }
  const std::vector<std::byte> text = read_bytes(0, size);
  text_ =
      std::make_unique<GltfText>(std::string_view(reinterpret_cast<const char*>(text.data()), text.size()), name(), 0);
}

void GltfFile::check_asset() const {
  const GltfValue asset = root()["asset"];
  if (!asset) throw root().error("no asset: not a glTF file");
  const std::string version = asset.need("version").text();
  const std::string least = asset["minVersion"] ? asset["minVersion"].text() : "2.0";
  if (!version.starts_with("2.") || least != "2.0") {
    throw Error(Error::Unsupported,
                fmt::format("{}: glTF {}, expected 2.0", name(), printable(least != "2.0" ? least : version)));
  }
  const GltfValue required = root()["extensionsRequired"];
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string extension = required.at(i).text();
    if (!is_known(extension))
      throw required.error(Error::Unsupported, fmt::format("{} isn't read", printable(extension)));
  }
}

void GltfFile::read_views() {
  const GltfValue buffers = root()["buffers"];
  buffers_.resize(buffers.size());
  for (std::size_t b = 0; b < buffers_.size(); ++b) buffers_[b].size = buffers.at(b).need("byteLength").count(0);
  const GltfValue views = root()["bufferViews"];
  views_.resize(views.size());
  for (std::size_t v = 0; v < views_.size(); ++v) {
    const GltfValue value = views.at(v);
    View& view = views_[v];
    view.buffer = value.need("buffer").index(buffers_.size());
    view.offset = value["byteOffset"].count(0);
    view.size = value.need("byteLength").count(0);
    view.stride = value["byteStride"].count(0);
    view.packed = static_cast<bool>(value["extensions"]["EXT_meshopt_compression"]);
    const std::uint64_t size = buffers_[view.buffer].size;
    if (view.offset > size || view.size > size - view.offset) {
      throw value.error(fmt::format("bytes {} to {} of a buffer of {}", view.offset, view.offset + view.size, size));
    }
    if (view.stride > 255) throw value.error(fmt::format("byteStride {}, expected at most 252", view.stride));
  }
}

std::span<const std::byte> GltfFile::view(std::size_t index) {
  const View& view = views_[index];
  const GltfValue buffer_value = root()["buffers"].at(view.buffer);
  if (view.packed && !buffer_value["uri"] && (view.buffer > 0 || !has_binary_)) {
    throw root()["bufferViews"].at(index).error(Error::Unsupported, "EXT_meshopt_compression isn't read");
  }
  return std::span(buffer(view.buffer))
      .subspan(static_cast<std::size_t>(view.offset), static_cast<std::size_t>(view.size));
}

const std::vector<std::byte>& GltfFile::buffer(std::size_t index) {
  Buffer& buffer = buffers_[index];
  if (buffer.read) return buffer.bytes;
  const GltfValue value = root()["buffers"].at(index);
  buffer.bytes = bytes_of(value, index);
  if (buffer.bytes.size() < buffer.size) {
    throw value.error(fmt::format("byteLength {}, there are {} bytes", buffer.size, buffer.bytes.size()));
  }
  buffer.read = true;
  return buffer.bytes;
}

std::vector<std::byte> GltfFile::bytes_of(const GltfValue& value, std::size_t index) {
  const std::string uri = value["uri"].text();
  if (uri.empty()) {
    if (index > 0 || !has_binary_) throw value.error("neither a uri nor a binary chunk");
    return read_bytes(binary_offset_, binary_size_);
  }
  std::optional<std::vector<std::byte>> bytes = fetch(uri);
  if (!bytes) throw value.error(fmt::format("no file {}", printable(uri)));
  bytes_read_ += bytes->size();
  if (bytes_read_ > static_cast<std::uint64_t>(run_.limits.memory_bytes)) {
    throw value.error(Error::Resource, fmt::format("{} bytes to hold, the limit of memory is {}", bytes_read_,
                                                   run_.limits.memory_bytes));
  }
  return std::move(*bytes);
}

std::optional<std::vector<std::byte>> GltfFile::fetch(const std::string& uri) const {
  if (!uri.starts_with("data:")) {
    if (std::any_of(uri.begin(), uri.end(), [](char each) { return static_cast<unsigned char>(each) < 0x20; })) {
      throw Error(Error::Data, fmt::format("{}: a URI with control characters: {}", name(), printable(uri)));
    }
    const std::shared_ptr<const Input> input = open_beside(file_, uri, options_, run_);
    if (input == nullptr) return std::nullopt;
    return input->read_all(run_.limits.memory_bytes);
  }
  const std::size_t comma = uri.find(',');
  std::vector<std::byte> bytes;
  const bool base64 = comma != std::string::npos && std::string_view(uri).substr(0, comma).ends_with(";base64");
  const bool good =
      comma != std::string::npos && (base64 ? decode_base64(std::string_view(uri).substr(comma + 1), bytes)
                                            : decode_percent(std::string_view(uri).substr(comma + 1), bytes));
  if (!good) throw Error(Error::Data, fmt::format("{}: a malformed data: URI", name()));
  return bytes;
}

void GltfFile::claim(std::uint64_t count, std::uint64_t bytes_each) {
  const std::uint64_t most =
      std::min(static_cast<std::uint64_t>(run_.limits.memory_bytes), (std::uint64_t{256} << 20) + 64 * bytes_read_);
  const std::uint64_t left = most - bytes_claimed_;
  if (count > left / bytes_each) {
    throw Error(Error::Resource, fmt::format("{}: {} elements of {} bytes to make, memory for {} bytes is left", name(),
                                             count, bytes_each, left));
  }
  bytes_claimed_ += count * bytes_each;
}

}  // namespace azulejo
