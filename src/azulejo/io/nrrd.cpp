#include "azulejo/io/nrrd.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"
#include "azulejo/io/gzip.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/volume_grid.h"
#include "azulejo/io/volume_samples.h"

namespace azulejo {
namespace {

/// Which axes of the file are the volume's, and which one lists several values of a sample.
struct Axes {
  std::vector<std::size_t> space;
  std::optional<std::size_t> list;
};

bool is_list(const NrrdHeader& header, std::size_t axis) {
  if (!header.directions.empty()) return !header.directions[axis].has_value();
  if (header.kinds.empty()) return false;
  const std::string& kind = header.kinds[axis];
  return kind != "domain" && kind != "space" && kind != "none" && kind != "???" && kind != "time";
}

Axes axes_of(const NrrdHeader& header, const std::string& file) {
  Axes axes;
  const std::size_t count = header.sizes.size();
  const auto refuse = [&](const char* why) {
    throw Error(Error::Unsupported, fmt::format("{}: {} dimensions, {}", file, count, why));
  };
  for (std::size_t axis = 0; axis < count; ++axis) {
    if (!is_list(header, axis)) {
      axes.space.push_back(axis);
    } else if (std::exchange(axes.list, axis)) {
      refuse("of which several are lists, expected one at most");
    }
  }
  if (!axes.list && axes.space.size() == 4) {  // times, most likely
    axes.list = axes.space.back();
    axes.space.pop_back();
  }
  if (axes.space.empty() || axes.space.size() > 3) refuse("expected a grid of one to three");
  if (axes.list && *axes.list != 0 && *axes.list != count - 1) refuse("with a list amid those of the grid");
  return axes;
}

GridPlacement placement_of(const NrrdHeader& header, const Axes& axes) {
  GridPlacement placement;
  if (!header.directions.empty()) placement.origin = header.origin;
  for (std::size_t i = 0; i < axes.space.size(); ++i) {
    const std::size_t axis = axes.space[i];
    if (!header.directions.empty()) {
      placement.axes[i] = *header.directions[axis];
      continue;
    }
    // NaN is how a header leaves a spacing or a minimum open.
    if (!header.spacings.empty() && header.spacings[axis] == header.spacings[axis]) {
      placement.axes[i][i] = header.spacings[axis];
    }
    if (!header.mins.empty() && header.mins[axis] == header.mins[axis]) placement.origin[i] = header.mins[axis];
  }
  return placement;
}

/// The unit of all axes; 0 where they differ or say nothing.
float metres_per_unit(const NrrdHeader& header, const Axes& axes) {
  std::vector<std::string> units = header.space_units;
  if (header.directions.empty() && !header.units.empty()) {
    units.clear();
    for (const std::size_t axis : axes.space) units.push_back(header.units[axis]);
  }
  if (units.empty() || std::adjacent_find(units.begin(), units.end(), std::not_equal_to<>()) != units.end()) return 0;
  return metres_in(units[0]);
}

/// The bytes of another input from one of them on.
class Rest final : public Input {
 public:
  Rest(std::shared_ptr<const Input> input, std::uint64_t begin)
      : Input(input->name()), input_(std::move(input)), begin_(std::min(begin, input_->size())) {}
  std::uint64_t size() const override { return input_->size() - begin_; }
  std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const override {
    return offset < size() ? input_->read(begin_ + offset, bytes) : 0;
  }

 private:
  std::shared_ptr<const Input> input_;
  std::uint64_t begin_;
};

/// Bytes that were made from others.
class Unpacked final : public Input {
 public:
  Unpacked(std::string name, Array<std::byte> bytes) : Input(std::move(name)), bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const override {
    if (offset >= bytes_.size()) return 0;
    const std::size_t count = std::min(bytes.size(), bytes_.size() - static_cast<std::size_t>(offset));
    if (count > 0) std::memcpy(bytes.data(), bytes_.data() + offset, count);
    return count;
  }

 private:
  Array<std::byte> bytes_;
};

bool is_blank(std::uint8_t byte) { return byte == ' ' || byte == ',' || (byte >= '\t' && byte <= '\r'); }

int hex_digit(std::uint8_t byte) {
  if (byte >= '0' && byte <= '9') return byte - '0';
  const int letter = byte | 0x20;
  return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

/// As many bytes as are wanted, two digits each.
std::shared_ptr<const Input> unpack_hex(const std::shared_ptr<const Input>& input, std::uint64_t wanted) {
  if (wanted > input->size() / 2) {
    throw Error(Error::Data,
                fmt::format("{}: {} bytes of digits, {} expected", input->name(), input->size(), 2 * wanted));
  }
  Array<std::byte> bytes(static_cast<std::size_t>(wanted));
  ByteReader reader(input);
  const auto digit = [&] {
    std::uint8_t byte = reader.byte();
    while (is_blank(byte)) byte = reader.byte();
    const int value = hex_digit(byte);
    if (value < 0) throw reader.error(Error::Data, "a hexadecimal digit expected");
    return static_cast<unsigned>(value);
  };
  for (std::byte& each : bytes) {
    const unsigned high = digit();
    each = static_cast<std::byte>(high << 4 | digit());
  }
  return std::make_shared<Unpacked>(input->name(), std::move(bytes));
}

/// The next number of a text, rounded to T; blanks and commas lie between them.
template <class T>
double next_number(ByteReader& reader) {
  std::array<char, 64> word = {};
  std::size_t size = 0;
  std::uint8_t byte = reader.byte();
  while (is_blank(byte)) byte = reader.byte();
  for (; !is_blank(byte); byte = reader.byte()) {
    if (size == word.size()) throw reader.error(Error::Data, "a number expected");
    word[size++] = static_cast<char>(byte);
    if (reader.at_end()) break;
  }
  const char* const begin = word.data() + (word[0] == '+' ? 1 : 0);
  T value = 0;
  const auto [end, failure] = std::from_chars(begin, word.data() + size, value);
  if (failure != std::errc() || end != word.data() + size) {
    throw reader.error(Error::Data, fmt::format("'{}', a number expected", std::string_view(word.data(), size)));
  }
  return static_cast<double>(value);
}

/// Numbers of a text, as the doubles of a file: the exactness of all types is told at one place.
std::shared_ptr<const Input> unpack_text(const std::shared_ptr<const Input>& input, SampleType type,
                                         std::uint64_t wanted, const Run& run) {
  if (wanted > input->size() / 2 + 1) {
    throw Error(Error::Data,
                fmt::format("{}: {} bytes of text, expected {} numbers", input->name(), input->size(), wanted));
  }
  const std::uint64_t size = wanted * sizeof(double);
  if (size > static_cast<std::uint64_t>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("{}: {} numbers to hold, the limit of memory is {} bytes", input->name(),
                                             wanted, run.limits.memory_bytes));
  }
  Array<std::byte> bytes(static_cast<std::size_t>(size));
  ByteReader reader(input);
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(double)) {
    if (at % (std::size_t{1} << 20) == 0) check_cancelled(run);
    const double value = type == SampleType::F32 ? next_number<float>(reader) : next_number<double>(reader);
    std::memcpy(bytes.data() + at, &value, sizeof(value));
  }
  return std::make_shared<Unpacked>(input->name(), std::move(bytes));
}

/// Where the samples lie: in this file or in another, from which byte.
Rest stored_data(const ModelFile& file, const NrrdHeader& header, const ModelReadOptions& options, const Run& run) {
  std::shared_ptr<const Input> input = file.input;
  std::uint64_t begin = header.data_begin;
  if (!header.data_file.empty()) {
    input = open_beside(file, header.data_file, options, run);
    begin = 0;
    if (input == nullptr) {
      throw Error(Error::Data, fmt::format("{}: its samples, {}, are not there", file.input->name(), header.data_file));
    }
  }
  if (header.line_skip > 0) {
    ByteReader reader(input, begin);
    for (std::int64_t line = 0; line < header.line_skip; ++line) {
      while (reader.byte() != '\n') {
      }
    }
    begin = reader.position();
  }
  return {std::move(input), begin};
}

/// Fills the samples from data of any encoding.
void read_data(const std::shared_ptr<const Input>& data, const NrrdHeader& header, SampleLayout layout, Volume& volume,
               const Run& run) {
  const std::uint64_t bytes = stored_bytes(volume, layout);
  if (header.byte_skip < 0 && header.encoding != NrrdEncoding::Raw) {
    throw Error(Error::Data, fmt::format("{}: byte skip -1 goes with raw samples only", data->name()));
  }
  const auto skip = static_cast<std::uint64_t>(std::max<std::int64_t>(header.byte_skip, 0));
  layout.begin = skip;
  switch (header.encoding) {
    case NrrdEncoding::Raw:
      if (header.byte_skip < 0) layout.begin = data->size() - std::min(data->size(), bytes);
      return read_samples(*data, layout, volume, run);
    case NrrdEncoding::Gzip: return read_samples(*unpack_gzip(*data, run.limits.memory_bytes), layout, volume, run);
    case NrrdEncoding::Hex:
      layout.begin = 0;
      return read_samples(*unpack_hex(std::make_shared<Rest>(data, skip), bytes), layout, volume, run);
    case NrrdEncoding::Text: break;
  }
  const auto numbers = unpack_text(std::make_shared<Rest>(data, skip), layout.type, bytes / size_of(layout.type), run);
  layout = {.type = SampleType::F64, .order = std::endian::native, .components = layout.components};
  read_samples(*numbers, layout, volume, run);
}

Model read_nrrd(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  const std::string& name = file.input->name();
  const NrrdHeader header = read_nrrd_header(file.input);
  const Axes axes = axes_of(header, name);
  Volume volume;
  volume.name = header.content;
  std::array<std::int64_t, 3> size = {1, 1, 1};
  for (std::size_t i = 0; i < axes.space.size(); ++i) size[i] = header.sizes[axes.space[i]];
  set_size(volume, size, name, run);
  SampleLayout layout{.type = header.type, .order = header.order};
  if (axes.list) {
    const std::int64_t values = header.sizes[*axes.list];
    if (values < 1 || (*axes.list == 0 && values > kMostComponents)) {
      throw Error(Error::Data, fmt::format("{}: {} values a sample, 1–{} expected", name, values, kMostComponents));
    }
    if (*axes.list == 0) layout.components = static_cast<std::uint32_t>(values);
    if (values > 1) warn(run, fmt::format("{}: the first of its {} values a sample is read", name, values));
  }
  set_placement(volume, placement_of(header, axes), name, run);
  volume.metres_per_unit = options.metres_per_unit.value_or(metres_per_unit(header, axes));
  read_data(std::make_shared<Rest>(stored_data(file, header, options, run)), header, layout, volume, run);
  return volume;
}

bool matches(std::span<const std::byte> head, std::uint64_t, std::string_view) {
  return head.size() >= 8 && std::memcmp(head.data(), "NRRD00", 6) == 0;
}

}  // namespace

extern const ModelCodec kNrrd;
const ModelCodec kNrrd = {"nrrd", {"nrrd", "nhdr"}, matches, read_nrrd, nullptr, nullptr};

}  // namespace azulejo
