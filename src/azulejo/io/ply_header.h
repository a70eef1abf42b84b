#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "azulejo/io/input.h"

namespace azulejo {

enum class PlyFormat : std::uint8_t { Text, LittleEndian, BigEndian };
enum class PlyType : std::uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };

std::size_t ply_type_bytes(PlyType type);
const char* ply_type_name(PlyType type);  ///< "char", "uchar", …

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::F32;
  bool is_list = false;
  PlyType count_type = PlyType::U8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< rows
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  std::size_t least_row_bytes() const;  ///< in binary: all of a row without lists, lists empty
  /// The property of that name, or the number of properties.
  std::size_t find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Text;
  std::vector<PlyElement> elements;
  std::uint64_t body = 0;  ///< first byte behind the header
  char line_end = '\n';    ///< \r if lines end with it alone
};

/// Throws Error(Data) naming the byte; also where the elements can't fit in what follows the header.
PlyHeader read_ply_header(const std::shared_ptr<const Input>& input);

}  // namespace azulejo
