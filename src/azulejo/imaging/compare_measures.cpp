#include "azulejo/imaging/compare_measures.h"

#include <algorithm>
#include <limits>

#include "azulejo/imaging/compare_kernels.h"

namespace azulejo {

void DifferenceMeasure::take_maximum(float value, int x, int y) {
  const bool earlier = y < maximum_y || (y == maximum_y && x < maximum_x);
  if (value > maximum || (value == maximum && value > 0 && earlier)) {
    maximum = value;
    maximum_x = x;
    maximum_y = y;
  }
}

void DifferenceMeasure::add_pixel(const float* pixel, int x, int y) {
  float largest = 0;
  bool finite = true;
  for (int c = 0; c < channels_; ++c) {
    finite = finite && pixel[c] <= std::numeric_limits<float>::max();
    largest = std::max(largest, pixel[c]);
  }
  if (!finite) {
    ++not_finite;
    return;
  }
  ++differing;
  take_maximum(largest / gain_, x, y);
  for (int c = 0; c < channels_; ++c) {
    const float value = pixel[c] / gain_;
    sum_.add(value);
    squares_.add(value * value);
  }
}

/// Whole steps, which are all finite.
void DifferenceMeasure::add_whole_row(const float* row, int x, int y, int width) {
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels_);
  const kernels::WholeSums sums = kernels::sum_whole(row, count, static_cast<float>(steps_));
  if (sums.different == 0) return;
  whole_sum_ += sums.sum;
  whole_squares_ += sums.squares;
  if (channels_ == 1) {
    differing += static_cast<std::int64_t>(sums.different);
  } else {
    for (const float* pixel = row; pixel < row + count; pixel += channels_) {
      differing += std::any_of(pixel, pixel + channels_, [](float value) { return value != 0; }) ? 1 : 0;
    }
  }
  const float largest = sums.largest;
  if (largest >= maximum) {
    take_maximum(largest, x + static_cast<int>(std::find(row, row + count, largest) - row) / channels_, y);
  }
}

void DifferenceMeasure::add(const ConstTile& tile, Scratch&) {
  const auto view = tile.pixels.as<float>();
  channels_ = view.channels;
  pixels += tile.rect.area();
  for (int y = 0; y < view.height; ++y) {
    const float* pixel = view.row(y);
    if (steps_ > 0) {
      add_whole_row(pixel, tile.rect.x, tile.rect.y + y, view.width);
      continue;
    }
    for (int x = 0; x < view.width; ++x, pixel += channels_) {
      bool equal = true;
      for (int c = 0; c < channels_; ++c) equal = equal && pixel[c] == 0;
      if (!equal) add_pixel(pixel, tile.rect.x + x, tile.rect.y + y);
    }
  }
}

void DifferenceMeasure::merge(const Analysis& partial) {
  const auto& other = static_cast<const DifferenceMeasure&>(partial);
  pixels += other.pixels;
  differing += other.differing;
  not_finite += other.not_finite;
  channels_ = std::max(channels_, other.channels_);
  take_maximum(other.maximum, other.maximum_x, other.maximum_y);
  whole_sum_ += other.whole_sum_;
  whole_squares_ += other.whole_squares_;
  sum_.merge(other.sum_);
  squares_.merge(other.squares_);
}

double DifferenceMeasure::sum() const { return steps_ > 0 ? static_cast<double>(whole_sum_) / steps_ : sum_.value(); }

double DifferenceMeasure::squares() const {
  return steps_ > 0 ? static_cast<double>(whole_squares_) / steps_ / steps_ : squares_.value();
}

void SimilarityMeasure::add(const ConstTile& tile, Scratch&) {
  const Rect common = intersection(tile.rect, part_);
  const auto view = tile.pixels.as<float>();
  for (int y = common.y; y < common.bottom(); ++y) {
    for (int x = common.x; x < common.right(); ++x) {
      const float value = view(x - tile.rect.x, y - tile.rect.y);
      if (value != value) continue;
      sum_.add(value);
      ++count_;
    }
  }
}

void SimilarityMeasure::merge(const Analysis& partial) {
  const auto& other = static_cast<const SimilarityMeasure&>(partial);
  sum_.merge(other.sum_);
  count_ += other.count_;
}

}  // namespace azulejo
