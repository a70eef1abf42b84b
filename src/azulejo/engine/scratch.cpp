#include "azulejo/engine/scratch.h"

#include <algorithm>

namespace azulejo {

std::byte* Scratch::take_bytes(std::size_t bytes) {
  constexpr std::size_t kMargin = 128;
  constexpr std::size_t kBlock = std::size_t{256} << 10;
  const std::size_t whole = (bytes + 63) / 64 * 64 + 2 * kMargin;
  while (block_ < blocks_.size() && used_ + whole > blocks_[block_].size()) {
    ++block_;
    used_ = 0;
  }
  if (block_ == blocks_.size()) {
    blocks_.emplace_back(std::max(whole, kBlock));
    used_ = 0;
  }
  std::byte* const place = blocks_[block_].data() + used_ + kMargin;
  used_ += whole;
  return place;
}

}  // namespace azulejo
