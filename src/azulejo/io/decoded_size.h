#pragma once

#include <cstdint>
#include <string>

#include "azulejo/core/run.h"

namespace azulejo {

/// Checks the size that a file's header claims, before anything is allocated from it.
/// Throws Error(Data) for an empty image or one that no `int` can measure, Error(Resource) for more pixels than
/// `run.limits.pixels`; both name the file.
void check_decoded_size(const std::string& name, std::uint64_t width, std::uint64_t height, const Run& run);

/// Throws Error(Resource) where decoding would hold more than `run.limits.memory_bytes`; `what` says of what.
void check_decoder_memory(const std::string& name, const char* what, std::uint64_t bytes, const Run& run);

}  // namespace azulejo
