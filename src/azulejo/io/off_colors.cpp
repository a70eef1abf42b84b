#include "azulejo/io/off_colors.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/parallel.h"

namespace azulejo {

OffColorKinds& OffColorKinds::operator|=(const OffColorKinds& other) {
  some |= other.some;
  real |= other.real;
  alpha |= other.alpha;
  indexed |= other.indexed;
  most = std::max(most, other.most);
  return *this;
}

std::optional<Attribute> off_colors(const Array<float>& values, const OffColorKinds& kinds, Domain domain,
                                    const std::string& name, const Run& run) {
  if (kinds.indexed) {
    warn(run,
         fmt::format("{}: colors of a {} that are numbers in a table are left out: the file doesn't have the table",
                     name, to_string(domain)));
  }
  if (!kinds.some) return std::nullopt;
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  const float scale = kinds.real || kinds.most <= 1 ? 255.0F : 1.0F;
  const std::size_t components = kinds.alpha ? 4 : 3;
  const std::size_t count = values.size() / 4;
  Array<std::uint8_t> result(count * components);
  parallel_for(count, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t c = 0; c < components; ++c) {
        const float value = values[i * 4 + c] * scale;
        const bool missing = !(value == value);
        result[i * components + c] =
            missing ? std::uint8_t{255} : static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
      }
    }
  });
  return Attribute{"COLOR_0", domain, static_cast<int>(components), std::move(result)};
}

}  // namespace azulejo
