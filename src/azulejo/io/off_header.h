#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "azulejo/io/input.h"

namespace azulejo {

/// The first words of an OFF file: [ST][C][N][4][n]OFF [BINARY], the letters in any order, and the counts.
struct OffHeader {
  bool texcoords = false;
  bool colors = false;
  bool normals = false;
  bool binary = false;  ///< big endian
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t body = 0;  ///< the line behind the counts; in binary the first byte behind them
  char line_end = '\n';
};

/// Throws Error(Data), Error(Unsupported) for vertices of another dimension than 3; Error(Data) also where so many
/// vertices and faces can't fit in the rest of the file.
OffHeader read_off_header(const Input& input);

/// Whether a file begins with OFF's word, perhaps after comments. In a file that is `named` so the word may be left out,
/// or stand behind comments that are longer than `head`.
bool begins_like_off(std::string_view head, bool named);

}  // namespace azulejo
