#include "azulejo/io/volume_samples.h"

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/load_number.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;  ///< values of the file in one task

/// Calls f(T{}) with the C++ type.
template <class F>
decltype(auto) visit_sample(SampleType type, F&& f) {
  switch (type) {
    case SampleType::I8: return f(std::int8_t{});
    case SampleType::U16: return f(std::uint16_t{});
    case SampleType::I16: return f(std::int16_t{});
    case SampleType::U32: return f(std::uint32_t{});
    case SampleType::I32: return f(std::int32_t{});
    case SampleType::U64: return f(std::uint64_t{});
    case SampleType::I64: return f(std::int64_t{});
    case SampleType::F32: return f(float{});
    case SampleType::F64: return f(double{});
    case SampleType::U8: break;
  }
  return f(std::uint8_t{});
}

/// Whether `rounded` stands for the very number; NaN does for NaN.
template <class T>
bool same_number(T stored, float rounded) {
  if constexpr (std::is_same_v<T, double>) {
    return static_cast<double>(rounded) == stored || stored != stored;
  } else if constexpr (sizeof(T) < 4 || std::is_same_v<T, float>) {
    return true;
  } else {
    // Rounding up may leave the type's range: 2⁶⁴ and 2⁶³ are no T.
    constexpr double kEnd = std::is_signed_v<T> ? 0x1p63 : 0x1p64;
    return static_cast<double>(rounded) < kEnd && static_cast<T>(rounded) == stored;
  }
}

/// Converts values that lie `components` apart; returns how many were not exact.
template <class T>
std::size_t convert(const std::byte* bytes, const SampleLayout& layout, float* result, std::size_t count) {
  const bool scaled = layout.slope != 1.0 || layout.intercept != 0.0;
  const std::size_t step = layout.components * sizeof(T);
  std::size_t inexact = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const T stored = load_number<T>(bytes + i * step, layout.order);
    const auto rounded = static_cast<float>(stored);
    inexact += same_number(stored, rounded) ? 0 : 1;
    result[i] = scaled ? static_cast<float>(layout.slope * static_cast<double>(stored) + layout.intercept) : rounded;
  }
  return inexact;
}

void read_exactly(const Input& input, std::uint64_t begin, std::span<std::byte> bytes) {
  const std::size_t count = input.read(begin, bytes);
  if (count == bytes.size()) return;
  throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early", input.name(), begin + count));
}

}  // namespace

std::size_t size_of(SampleType type) {
  return visit_sample(type, [](auto zero) { return sizeof(zero); });
}

const char* to_string(SampleType type) {
  constexpr const char* kNames[] = {"u8", "i8", "u16", "i16", "u32", "i32", "u64", "i64", "f32", "f64"};
  return kNames[static_cast<std::size_t>(type)];
}

std::uint64_t stored_bytes(const Volume& volume, const SampleLayout& layout) {
  return static_cast<std::uint64_t>(volume.width) * static_cast<std::uint64_t>(volume.height) *
         static_cast<std::uint64_t>(volume.depth) * layout.components * size_of(layout.type);
}

void read_samples(const Input& input, const SampleLayout& layout, Volume& volume, const Run& run) {
  const std::uint64_t bytes = stored_bytes(volume, layout);
  if (layout.begin > input.size() || bytes > input.size() - layout.begin) {
    throw Error(Error::Data, fmt::format("{}: {} × {} × {} samples ({}) from byte {} take {} bytes, the file has {}",
                                         input.name(), volume.width, volume.height, volume.depth,
                                         to_string(layout.type), layout.begin, bytes, input.size()));
  }
  const std::size_t sample_bytes = layout.components * size_of(layout.type);
  const auto count = static_cast<std::size_t>(bytes / sample_bytes);
  volume.samples.resize(count);
  const std::size_t chunk = std::max<std::size_t>(kChunk / layout.components, 1);
  const std::size_t inexact = parallel_reduce(
      count, chunk, run, std::size_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::vector<std::byte> stored((end - begin) * sample_bytes);
        read_exactly(input, layout.begin + begin * sample_bytes, stored);
        return visit_sample(layout.type, [&](auto zero) {
          return convert<decltype(zero)>(stored.data(), layout, volume.samples.data() + begin, end - begin);
        });
      },
      [](std::size_t a, std::size_t b) { return a + b; });
  if (inexact > 0) {
    warn(run, fmt::format("{}: {} of {} samples ({}) have no exact 32-bit float and are rounded", input.name(), inexact,
                          count, to_string(layout.type)));
  }
}

}  // namespace azulejo
