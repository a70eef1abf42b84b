#pragma once

#include <memory>
#include <optional>

#include "azulejo/engine/source.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// Lowest and highest colour of an image.
struct ValueRange {
  float low = 0;
  float high = 1;
};

/// Over all finite colours; 0–1 where there are none.
ValueRange value_range(const ConstAnyView& pixels);

/// A sink that writes through `codec`, converting what the format can't hold.
///
/// range     with options.normalize: what becomes 0–1, if it is known; else all rows are kept until the end
/// finish()  warns of clipped values, then commits the output
std::unique_ptr<ImageSink> make_file_sink(std::unique_ptr<Output> output, const Codec& codec, const ImageInfo& info,
                                          const Metadata& metadata, const WriteOptions& options,
                                          std::optional<ValueRange> range, const Run& run);

}  // namespace azulejo
