#include "azulejo/rendering/dash.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace azulejo {

std::optional<DashPattern> DashPattern::of(const DrawingStyle& style, float scale) {
  DashPattern pattern;
  const std::size_t count = style.dash.size();
  for (std::size_t i = 0; i < count + count % 2 * count; ++i) {
    const double length = static_cast<double>(style.dash[i % count]) * scale;
    pattern.lengths_.push_back(std::isfinite(length) ? std::max(0.0, length) : 0);
    pattern.period_ += pattern.lengths_.back();
  }
  if (!(pattern.period_ > 0) || pattern.period_ > std::numeric_limits<float>::max()) return std::nullopt;
  const double offset = std::fmod(static_cast<double>(style.dash_offset) * scale, pattern.period_);
  pattern.offset_ = std::isfinite(offset) ? offset : 0;
  if (pattern.offset_ < 0) pattern.offset_ += pattern.period_;
  return pattern;
}

float DashPattern::share(double extension) const {
  double covered = 0;
  for (std::size_t i = 0; i < lengths_.size(); i += 2) covered += lengths_[i] + std::min(extension, lengths_[i + 1]);
  return static_cast<float>(covered / period_);
}

void DashPosition::restart() {
  index_ = 0;
  left_ = pattern_->lengths_[0];
  skip(pattern_->offset_);
}

void DashPosition::turn() {
  index_ = index_ + 1 == pattern_->lengths_.size() ? 0 : index_ + 1;
  left_ = pattern_->lengths_[index_];
}

void DashPosition::skip(double length) {
  if (length >= pattern_->period_) length = std::fmod(length, pattern_->period_);
  // A dash or gap that ends here is over; a whole period's rounding can't go around more than once.
  for (std::size_t i = 0; length > 0 && length >= left_ && i <= pattern_->lengths_.size(); ++i) {
    length -= left_;
    turn();
  }
  left_ = std::max(0.0, left_ - length);
}

}  // namespace azulejo
