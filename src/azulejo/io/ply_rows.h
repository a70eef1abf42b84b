#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/io/input.h"
#include "azulejo/io/ply_header.h"

namespace azulejo {

/// Where the values of a property go.
struct PlySink {
  enum Kind : std::uint8_t {
    Skip,
    Float,      ///< a scalar into floats
    Flipped,    ///< 1 − the value
    Byte,       ///< into 0–255, clamped
    Shade,      ///< 0–65535 into 0–255
    Index,      ///< into u32; what doesn't fit becomes kNone
    Indices,    ///< a list into PlyPiece::indices
    Texcoords,  ///< a list into PlyPiece::texcoords
  };
  Kind kind = Skip;
  void* values = nullptr;  ///< of row 0; nothing for lists
  std::size_t stride = 0;  ///< values from row to row
  bool says_loss = false;  ///< a warning where a value isn't kept exactly
};

constexpr std::uint32_t kNoPlyIndex = 0xFFFFFFFF;

/// What lists give, for a run of rows: their lengths and values.
struct PlyPiece {
  Array<std::uint32_t> index_counts;
  Array<std::uint32_t> indices;
  Array<std::uint32_t> texcoord_counts;
  Array<float> texcoords;
  std::vector<bool> lost;  ///< for each property: a value was not kept exactly
};

/// An element with a sink for each property, and what its lists gave, in the order of the rows.
struct PlyRows {
  const PlyElement* element = nullptr;
  std::vector<PlySink> sinks;
  std::vector<PlyPiece> pieces;
};

/// Reads all rows, on all threads. Throws Error(Data) naming the byte.
void read_ply_text(const std::shared_ptr<const Input>& input, const PlyHeader& header, std::vector<PlyRows>& rows,
                   const Run& run);
void read_ply_binary(const std::shared_ptr<const Input>& input, const PlyHeader& header, std::vector<PlyRows>& rows,
                     const Run& run);

/// Puts a value of a file into its place. False where it isn't kept exactly.
inline bool put_ply_value(const PlySink& sink, std::size_t row, double value) {
  const std::size_t at = row * sink.stride;
  const auto clamped = [&](double most) { return value >= 0 ? (value <= most ? value : most) : 0.0; };  // NaN: 0
  switch (sink.kind) {
    case PlySink::Float: {
      const float stored = static_cast<float>(value);
      static_cast<float*>(sink.values)[at] = stored;
      return static_cast<double>(stored) == value || value != value;
    }
    case PlySink::Flipped: static_cast<float*>(sink.values)[at] = 1 - static_cast<float>(value); break;
    case PlySink::Byte:
      static_cast<std::uint8_t*>(sink.values)[at] = static_cast<std::uint8_t>(clamped(255));
      return clamped(255) == value;
    case PlySink::Shade:
      static_cast<std::uint8_t*>(sink.values)[at] = static_cast<std::uint8_t>(clamped(65535) / 257 + 0.5);
      break;
    case PlySink::Index: {
      const bool fits = value >= 0 && value <= 4294967294.0;
      static_cast<std::uint32_t*>(sink.values)[at] = fits ? static_cast<std::uint32_t>(value) : kNoPlyIndex;
      break;
    }
    default: break;
  }
  return true;
}

}  // namespace azulejo
