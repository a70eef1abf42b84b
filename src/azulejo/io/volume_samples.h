#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "azulejo/core/run.h"
#include "azulejo/data/volume.h"
#include "azulejo/io/input.h"
#include "azulejo/io/model_io.h"

namespace azulejo {

/// Bytes of one.
std::size_t size_of(SampleType type);
const char* to_string(SampleType type);  ///< "u8", "i16", "f64", …

/// How the samples of a volume lie in a file, and what they mean: value = slope · stored + intercept.
struct SampleLayout {
  SampleType type = SampleType::U8;
  std::endian order = std::endian::little;
  std::uint64_t begin = 0;       ///< byte of the first
  std::uint32_t components = 1;  ///< values of one sample, side by side; the first is read
  double slope = 1;
  double intercept = 0;
};

/// Components that a sample may have.
inline constexpr std::uint32_t kMostComponents = 4096;

/// Bytes that the samples of a volume of this size take in the file; no overflow after `set_size`.
std::uint64_t stored_bytes(const Volume& volume, const SampleLayout& layout);

/// Fills volume.samples, in chunks on all threads. Where a stored number has no equal f32, it is rounded, with a
/// warning that says how many.
/// Throws Error(Data) where the input ends too early, before anything is allocated.
void read_samples(const Input& input, const SampleLayout& layout, Volume& volume, const Run& run);

}  // namespace azulejo
