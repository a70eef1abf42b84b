#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "azulejo/io/codec.h"

namespace azulejo {

/// What every PNG begins with.
inline constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

/// Reads through libpng.
std::unique_ptr<Decoder> decode_png(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);

/// Writes without libpng: strips of the image are filtered and deflated on all threads. The bytes are the same for
/// any number of them.
std::unique_ptr<Encoder> encode_png(Output& output, const ImageInfo& info, const Metadata& metadata,
                                    const WriteOptions& options, const Run& run);

}  // namespace azulejo
