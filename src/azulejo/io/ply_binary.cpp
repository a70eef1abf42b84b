#include <algorithm>
#include <bit>
#include <limits>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/ply_rows.h"

namespace azulejo {
namespace {

constexpr std::size_t kWindow = std::size_t{1} << 18;

double load_value(const std::byte* bytes, PlyType type, std::endian order) {
  switch (type) {
    case PlyType::I8: return load_number<std::int8_t>(bytes, order);
    case PlyType::U8: return load_number<std::uint8_t>(bytes, order);
    case PlyType::I16: return load_number<std::int16_t>(bytes, order);
    case PlyType::U16: return load_number<std::uint16_t>(bytes, order);
    case PlyType::I32: return load_number<std::int32_t>(bytes, order);
    case PlyType::U32: return load_number<std::uint32_t>(bytes, order);
    case PlyType::F32: return static_cast<double>(load_number<float>(bytes, order));
    case PlyType::F64: return load_number<double>(bytes, order);
  }
  return 0;
}

/// Rows that are read together.
struct RowRun {
  std::size_t first_row;
  std::uint64_t begin;  ///< bytes in the file
};

Error cut(const Input& input, const PlyElement& element, std::uint64_t row) {
  return Error(Error::Data, fmt::format("{}: byte {}: the file ends too early: in row {} of {} of element {}",
                                        input.name(), input.size(), row, element.count, element.name));
}

/// A part of the file that moves along.
class Window {
 public:
  explicit Window(const Input& input) : input_(input), bytes_(kWindow) {}
  /// `count` bytes (few) at a place; null if the file has not so many.
  const std::byte* at(std::uint64_t place, std::size_t count) {
    if (place < begin_ || place + count > begin_ + filled_) {
      begin_ = place;
      filled_ = input_.read(place, bytes_);
      if (filled_ < count) return nullptr;
    }
    return bytes_.data() + (place - begin_);
  }

 private:
  const Input& input_;
  Array<std::byte> bytes_;
  std::uint64_t begin_ = 0;
  std::size_t filled_ = 0;
};

/// Divides rows without lists evenly.
std::vector<RowRun> even_runs(const Input& input, const PlyElement& element, std::uint64_t begin) {
  const std::uint64_t row = element.least_row_bytes();
  if (row > 0 && element.count > (input.size() - begin) / row) throw cut(input, element, (input.size() - begin) / row);
  const std::uint64_t rows = row == 0 ? element.count : std::max<std::uint64_t>(1, kWindow / row);
  std::vector<RowRun> runs;
  if (row > 0) {
    for (std::uint64_t first = 0; first < element.count; first += rows) {
      runs.push_back({static_cast<std::size_t>(first), begin + first * row});
    }
  }
  runs.push_back({static_cast<std::size_t>(element.count), begin + element.count * row});
  return runs;
}

/// Follows the lengths of lists from row to row. Bounded by the file's size: a row with a list has at least a byte.
std::vector<RowRun> scanned_runs(const Input& input, const PlyElement& element, std::uint64_t begin,
                                 std::endian order) {
  Window window(input);
  std::vector<RowRun> runs = {{0, begin}};
  std::uint64_t place = begin;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    if (place - runs.back().begin >= kWindow) runs.push_back({static_cast<std::size_t>(row), place});
    for (const PlyProperty& property : element.properties) {
      if (!property.is_list) {
        place += ply_type_bytes(property.type);
        continue;
      }
      const std::size_t count_bytes = ply_type_bytes(property.count_type);
      const std::byte* const bytes = window.at(place, count_bytes);
      if (bytes == nullptr) throw cut(input, element, row);
      const double count = load_value(bytes, property.count_type, order);
      if (count < 0) {
        throw Error(Error::Data, fmt::format("{}: byte {}: a list of {} values in row {} of element {}", input.name(),
                                             place, count, row, element.name));
      }
      place += count_bytes + static_cast<std::uint64_t>(count) * ply_type_bytes(property.type);
    }
    if (place > input.size()) throw cut(input, element, row);
  }
  runs.push_back({static_cast<std::size_t>(element.count), place});
  return runs;
}

class RunParser {
 public:
  RunParser(const PlyRows& rows, std::endian order, PlyPiece& piece) : rows_(rows), order_(order), piece_(piece) {
    piece_.lost.assign(rows.sinks.size(), false);
  }

  void parse(const std::byte* bytes, std::size_t first_row, std::size_t last_row) {
    const bool has_indices = std::any_of(rows_.sinks.begin(), rows_.sinks.end(),
                                         [](const PlySink& sink) { return sink.kind == PlySink::Indices; });
    if (has_indices) {
      piece_.index_counts.reserve(last_row - first_row);
      piece_.indices.reserve(3 * (last_row - first_row));
    }
    for (std::size_t row = first_row; row < last_row; ++row) {
      for (std::size_t i = 0; i < rows_.sinks.size(); ++i) {
        const PlyProperty& property = rows_.element->properties[i];
        bytes = property.is_list ? list(bytes, property, rows_.sinks[i]) : scalar(bytes, i, row);
      }
    }
  }

 private:
  const std::byte* scalar(const std::byte* bytes, std::size_t property, std::size_t row) {
    const PlyType type = rows_.element->properties[property].type;
    const PlySink& sink = rows_.sinks[property];
    if (sink.kind != PlySink::Skip && !put_ply_value(sink, row, load_value(bytes, type, order_)) && sink.says_loss) {
      piece_.lost[property] = true;
    }
    return bytes + ply_type_bytes(type);
  }

  const std::byte* list(const std::byte* bytes, const PlyProperty& property, const PlySink& sink) {
    const auto count = static_cast<std::size_t>(load_value(bytes, property.count_type, order_));
    bytes += ply_type_bytes(property.count_type);
    const std::size_t size = ply_type_bytes(property.type);
    if (sink.kind == PlySink::Indices) {
      piece_.index_counts.push_back(static_cast<std::uint32_t>(count));
      const std::size_t at = piece_.indices.size();
      piece_.indices.resize(at + count);
      if (property.type == PlyType::I32 || property.type == PlyType::U32) {
        // Negative numbers become large ones, which no mesh has.
        for (std::size_t i = 0; i < count; ++i) {
          piece_.indices[at + i] = load_number<std::uint32_t>(bytes + i * 4, order_);
        }
      } else {
        const PlySink place = {PlySink::Index, &piece_.indices[at], 1};
        for (std::size_t i = 0; i < count; ++i)
          put_ply_value(place, i, load_value(bytes + i * size, property.type, order_));
      }
    } else if (sink.kind == PlySink::Texcoords) {
      piece_.texcoord_counts.push_back(static_cast<std::uint32_t>(count));
      for (std::size_t i = 0; i < count; ++i) {
        piece_.texcoords.push_back(static_cast<float>(load_value(bytes + i * size, property.type, order_)));
      }
    }
    return bytes + count * size;
  }

  const PlyRows& rows_;
  std::endian order_;
  PlyPiece& piece_;
};

void read_runs(const Input& input, PlyRows& rows, const std::vector<RowRun>& runs, std::endian order, const Run& run) {
  rows.pieces.resize(runs.size() - 1);
  std::vector<Array<std::byte>> buffers(static_cast<std::size_t>(thread_count(run)));
  parallel_tasks(rows.pieces.size(), run, [&](std::size_t i, int worker) {
    Array<std::byte>& buffer = buffers[static_cast<std::size_t>(worker)];
    buffer.resize(static_cast<std::size_t>(runs[i + 1].begin - runs[i].begin));
    if (input.read(runs[i].begin, buffer) < buffer.size()) throw cut(input, *rows.element, runs[i].first_row);
    RunParser(rows, order, rows.pieces[i]).parse(buffer.data(), runs[i].first_row, runs[i + 1].first_row);
  });
}

}  // namespace

void read_ply_binary(const std::shared_ptr<const Input>& input, const PlyHeader& header, std::vector<PlyRows>& rows,
                     const Run& run) {
  const std::endian order = header.format == PlyFormat::BigEndian ? std::endian::big : std::endian::little;
  std::uint64_t place = header.body;
  for (PlyRows& each : rows) {
    const PlyElement& element = *each.element;
    const std::vector<RowRun> runs =
        element.has_lists() ? scanned_runs(*input, element, place, order) : even_runs(*input, element, place);
    place = runs.back().begin;
    const bool wanted = std::any_of(each.sinks.begin(), each.sinks.end(),
                                    [](const PlySink& sink) { return sink.kind != PlySink::Skip; });
    if (wanted) read_runs(*input, each, runs, order, run);
  }
  if (place < input->size()) {
    warn(run, fmt::format("{}: byte {}: {} bytes behind the last element are not read", input->name(), place,
                          input->size() - place));
  }
}

}  // namespace azulejo
