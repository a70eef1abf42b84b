#include "azulejo/imaging/value_range.h"

#include <algorithm>
#include <type_traits>

namespace azulejo {

void ValueRange::add(const ConstTile& tile, Scratch&) {
  visit(tile.pixels, [&](auto view) {
    for (int y = 0; y < view.height; ++y) add_row(view.row(y), view.width);
  });
}

void ValueRange::merge(const Analysis& other) {
  const auto& more = static_cast<const ValueRange&>(other);
  smallest_ = std::min(smallest_, more.smallest_);
  largest_ = std::max(largest_, more.largest_);
}

template <class T>
void ValueRange::add_row(const T* row, int width) {
  const float full = full_range(info_.type);
  const int channels = info_.channels;
  if constexpr (!std::is_same_v<T, float>) {
    if (info_.alpha == AlphaState::None) {
      // Minima and maxima of integers take vectors.
      T low = row[0];
      T high = row[0];
      for (int i = 0; i < width * channels; ++i) {
        low = std::min(low, row[i]);
        high = std::max(high, row[i]);
      }
      add_value(static_cast<float>(low) / full);
      return add_value(static_cast<float>(high) / full);
    }
  }
  const int colors = info_.color_channels();
  for (int x = 0; x < width; ++x) {
    const T* const pixel = row + static_cast<std::ptrdiff_t>(x) * channels;
    const float alpha = colors == channels ? full : static_cast<float>(pixel[colors]);
    if (alpha == 0) continue;
    const float whole = info_.alpha == AlphaState::Premultiplied ? alpha : full;
    for (int c = 0; c < colors; ++c) add_value(static_cast<float>(pixel[c]) / whole);
  }
}

void ValueRange::add_value(float value) {
  if (value - value != 0) return;
  smallest_ = std::min(smallest_, value);
  largest_ = std::max(largest_, value);
}

}  // namespace azulejo
