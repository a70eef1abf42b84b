#pragma once

#include <ImfCompression.h>

#include <memory>

#include "azulejo/io/codec.h"

namespace azulejo {

/// Reads half, float and uint channels as f32: linear light in Rec. 709 primaries, or data. Rows come as they are
/// asked for, from scan lines or from one row of tiles (level 0). The image is the display window; what the data
/// window does not cover is 0.
std::unique_ptr<Decoder> decode_exr(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);

/// Writes f32, or half where `options.type` is an integer type. Channels are R, G, B or Y, and A; data are V, or
/// X, Y, Z, W.
std::unique_ptr<Encoder> encode_exr(Output& output, const ImageInfo& info, const Metadata& metadata,
                                    const WriteOptions& options, const Run& run);

/// By the name that the options give it; empty: zip. Throws Error(Argument) for others.
Imf::Compression exr_compression(const std::string& name);

}  // namespace azulejo
