#include "azulejo/imaging/error_diffusion.h"

#include <limits>

#include "azulejo/imaging/error_diffusion_kernels.h"

namespace azulejo {

template <class T>
void ErrorDiffusion<T>::take(const ImageView<const T>& source, const Rect& rect, const AnyView& result,
                             bool reference) const {
  const std::lock_guard lock(mutex_);
  if (done_.empty()) {
    done_ = Image(info_);
    const auto padded = static_cast<std::size_t>(info_.width + 2) * static_cast<std::size_t>(info_.channels);
    above_.assign(padded, 0);
    current_.assign(padded, 0);
  }
  // Of more levels in linear light, the nearest one has to be searched for.
  const bool vectors = !reference && (!levels_.curve() || levels_.last() == 1);
  while (vectors && rows_ < rect.bottom()) {
    const int height = std::min(static_cast<int>(kernels::diffusion_rows()), info_.height - rows_);
    compute_band(source, height);
    rows_ += height;
  }
  for (; rows_ < rect.bottom(); ++rows_) {
    compute_row(source.row(rows_), done_.view<T>().row(rows_));
    above_.swap(current_);
  }
  copy_pixels(std::as_const(done_).any().crop(rect), result);
}

template <class T>
void ErrorDiffusion<T>::compute_row(const T* source, T* result) const {
  const int channels = info_.channels;
  const int colors = info_.color_channels();
  const float* above = above_.data() + channels;
  float* error = current_.data() + channels;
  for (int x = 0; x < info_.width; ++x) {
    const T alpha = colors < channels ? source[colors] : T{};
    // What would leave at the sides comes straight down.
    const float down = 5.0F + (x == 0 ? 3.0F : 0.0F) + (x == info_.width - 1 ? 8.0F : 0.0F);
    for (int c = 0; c < colors; ++c) {
      const T value = straight_color(info_, source[c], alpha);
      if (value != value) {
        result[c] = value;
        error[c] = 0;
        continue;
      }
      const bool hidden = colors < channels && alpha == T{0};
      const float received =
          (7.0F * error[c - channels] + above[c - channels]) + (down * above[c] + 3.0F * above[c + channels]);
      const float wanted = levels_.amount(value) + (hidden ? 0.0F : received * (1.0F / 16.0F));
      const std::size_t level = levels_.nearest(wanted);
      error[c] = hidden ? 0.0F : wanted - levels_.amount_of(level);
      result[c] = stored_color(info_, levels_.value(level), alpha);
    }
    if (colors < channels) result[colors] = alpha;
    source += channels;
    result += channels;
    above += channels;
    error += channels;
  }
}

template <class T>
void ErrorDiffusion<T>::compute_band(const ImageView<const T>& source, int height) const {
  const int colors = info_.color_channels();
  const int channels = info_.channels;
  const auto rows = static_cast<int>(kernels::diffusion_rows());
  const auto count = static_cast<std::size_t>(info_.width) * static_cast<std::size_t>(colors);
  const std::size_t stride = count + static_cast<std::size_t>(2 * colors * rows);
  band_.assign(stride * static_cast<std::size_t>(rows + 1), std::numeric_limits<float>::quiet_NaN());
  for (int r = 0; r < height; ++r) {
    const T* pixel = source.row(rows_ + r);
    float* amount = band_.data() + stride * static_cast<std::size_t>(r);
    for (int x = 0; x < info_.width; ++x, pixel += channels, amount += colors) {
      const T alpha = colors < channels ? pixel[colors] : T{};
      if (colors < channels && alpha == T{0}) continue;
      for (int c = 0; c < colors; ++c) {
        const T value = straight_color(info_, pixel[c], alpha);
        if (value == value) amount[c] = levels_.amount(value);
      }
    }
  }
  kernels::diffuse_band({band_.data(), stride, static_cast<std::size_t>(height), count,
                         static_cast<std::size_t>(colors), above_.data() + colors, levels_.last()});
  for (int r = 0; r < height; ++r) {
    const T* pixel = source.row(rows_ + r);
    const float* level = band_.data() + stride * static_cast<std::size_t>(r);
    T* result = done_.view<T>().row(rows_ + r);
    for (int x = 0; x < info_.width; ++x, pixel += channels, level += colors, result += channels) {
      const T alpha = colors < channels ? pixel[colors] : T{};
      for (int c = 0; c < colors; ++c) {
        if (level[c] == level[c]) {
          result[c] = stored_color(info_, levels_.value(static_cast<std::size_t>(level[c])), alpha);
          continue;
        }
        const T value = straight_color(info_, pixel[c], alpha);
        result[c] =
            value != value ? value : stored_color(info_, levels_.value(levels_.nearest(levels_.amount(value))), alpha);
      }
      if (colors < channels) result[colors] = alpha;
    }
  }
}

template class ErrorDiffusion<std::uint8_t>;
template class ErrorDiffusion<std::uint16_t>;
template class ErrorDiffusion<float>;

}  // namespace azulejo
