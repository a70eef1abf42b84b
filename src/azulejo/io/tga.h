#pragma once

#include <memory>

#include "azulejo/io/codec.h"

namespace azulejo {

/// Reads all Targa types: palette, colour and gray, plain and run-length encoded, 8–32 bits, from any corner.
/// By rows, unless run lengths start at the bottom. Alpha is there where the header counts attribute bits and the
/// extension area, if any, calls them alpha. Decoded here, not by stb: that one looks at none of this.
std::unique_ptr<Decoder> decode_tga(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);

/// The first bytes of a file.
struct TgaHeader {
  static constexpr std::size_t kBytes = 18;
  int id_bytes = 0;
  bool has_palette = false;
  int type = 0;  ///< 1 palette, 2 colour, 3 gray; run lengths: 8 more
  int palette_first = 0;
  int palette_size = 0;
  int palette_bits = 0;
  int width = 0;
  int height = 0;
  int bits = 0;  ///< a pixel, or an index
  int attribute_bits = 0;
  bool from_right = false;
  bool from_top = false;
  bool interleaved = false;

  bool runs() const { return type >= 8; }
  int kind() const { return type & 7; }
};

/// There are no magic bytes: empty if some field can't be that of a Targa file.
std::optional<TgaHeader> parse_tga_header(std::span<const std::byte> head);

}  // namespace azulejo
