#pragma once

#include <memory>

#include "azulejo/engine/source.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// An image file as a source of rows. Every pass opens the decoder anew; a file that can't be read by rows is
/// decoded once and kept, in a temporary file if it is larger than run.limits.memory_bytes.
std::unique_ptr<ImageSource> open_file_source(std::shared_ptr<const Input> input, const ReadOptions& options,
                                              const Run& run);

}  // namespace azulejo
