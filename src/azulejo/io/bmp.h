#pragma once

#include <memory>

#include "azulejo/io/codec.h"

namespace azulejo {

/// Reads Windows and OS/2 bitmaps of 1–32 bits, by rows; run-length encoded ones at once. A palette of grays gives
/// one channel, other images three, four where the header has an alpha mask. Decoded here, not by stb: that one
/// reads no run lengths and refuses a gap before the pixels.
std::unique_ptr<Decoder> decode_bmp(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);

}  // namespace azulejo
