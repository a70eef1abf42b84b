#pragma once

#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// result[i] = table[source[i]] for `count` bytes and a table of 256. In place is allowed.
/// Cost  0.5 cycles a byte where vectors have 64 bytes: 16 lookups of 16 bytes each, instead of one load a byte
void lookup_bytes(const std::uint8_t* source, std::uint8_t* result, std::size_t count, const std::uint8_t* table);

}  // namespace azulejo::kernels
