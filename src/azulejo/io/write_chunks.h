#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "azulejo/core/run.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// Writes [0, count) in chunks: append(text, begin, end) makes the bytes of one, on all threads; they are written in
/// order, as many at a time as there are threads.
void write_in_chunks(Output& output, std::size_t count, std::size_t chunk, const Run& run,
                     const std::function<void(std::string& text, std::size_t begin, std::size_t end)>& append);

void write_text(Output& output, const std::string& text);

/// Appends a number with the fewest digits that read back the same.
void append_number(std::string& text, float value);
void append_number(std::string& text, std::uint32_t value);

}  // namespace azulejo
