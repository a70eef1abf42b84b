#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace azulejo::kernels {

/// result[i] = table[source[i]] for `count` bytes and a table of 256. In place is allowed.
/// period  other than 0: the last byte of each period is copied (alpha). At most 4, not 3
/// Cost    bound by memory where the processor permutes bytes of 64-byte vectors; else 0.5 cycles a byte where vectors
///         have 64 bytes: 16 lookups of 16 bytes each, instead of one load a byte
void lookup_bytes(const std::uint8_t* source, std::uint8_t* result, std::size_t count, const std::uint8_t* table,
                  int period = 0);

/// The same for pixels of tables.size() channels, 1–4, with a table for each channel; where it is null, bytes are copied.
void lookup_channels(const std::uint8_t* source, std::uint8_t* result, std::size_t pixels,
                     std::span<const std::uint8_t* const> tables);

}  // namespace azulejo::kernels
