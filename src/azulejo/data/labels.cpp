#include "azulejo/data/labels.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {

Labels::Labels(int width, int height) : width_(width), height_(height) {
  if (width < 1 || height < 1) {
    throw Error(Error::Argument, fmt::format("labels: size {}×{}, expected at least 1×1", width, height));
  }
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  buffer_ = Buffer(count * sizeof(std::uint32_t));
  std::fill_n(data(), count, 0U);
}

Labels Labels::clone() const {
  if (width_ == 0) return {};
  Labels copy(width_, height_);
  std::copy_n(data(), static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), copy.data());
  return copy;
}

std::uint32_t Labels::make_dense() {
  std::unordered_map<std::uint32_t, std::uint32_t> dense;
  const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t& id = data()[i];
    if (id != 0) id = dense.try_emplace(id, static_cast<std::uint32_t>(dense.size() + 1)).first->second;
  }
  return static_cast<std::uint32_t>(dense.size());
}

}  // namespace azulejo
