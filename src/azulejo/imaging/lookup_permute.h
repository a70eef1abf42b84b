#pragma once

#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// True where the processor permutes bytes of whole 64-byte vectors (AVX-512 VBMI), which no vector target of the other
/// kernels asks for.
bool permutes_bytes();

/// lookup_bytes for the whole vectors of 64 bytes that `count` has. Returns how many bytes that were.
std::size_t lookup_by_permutation(const std::uint8_t* source, std::uint8_t* result, std::size_t count,
                                  const std::uint8_t* table, int period);

}  // namespace azulejo::kernels
