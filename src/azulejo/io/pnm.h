#pragma once

#include <cstdint>
#include <memory>

#include "azulejo/io/codec.h"

namespace azulejo {

/// What the header of a Netpbm file or portable float map says.
/// Source: netpbm.sourceforge.net/doc, pages pbm, pgm, ppm, pam; Debevec's PFM note
struct PnmHeader {
  char kind = 0;                ///< the digit or letter behind the P: 1–7, f, F
  ImageInfo info;               ///< as it is read
  std::uint32_t maximum = 255;  ///< of a sample; 1 for bits
  bool little_endian = false;   ///< floats
  double scale = 1;             ///< of PFM, without its sign; told, not applied
  std::uint64_t pixels = 0;     ///< where in the file they begin

  bool plain() const { return kind >= '1' && kind <= '3'; }
  bool bits() const { return kind == '1' || kind == '4'; }
  bool floats() const { return kind == 'f' || kind == 'F'; }
  /// A row as raw bytes.
  std::uint64_t raw_row_bytes() const;
};

/// Throws Error(Data | Unsupported | Resource) naming the byte.
PnmHeader read_pnm_header(const std::shared_ptr<const Input>& input, const Run& run);

std::unique_ptr<Decoder> decode_pnm(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);

}  // namespace azulejo
