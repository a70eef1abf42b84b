#include "azulejo/imaging/error_diffusion.h"

namespace azulejo {

template <class T>
void ErrorDiffusion<T>::take(const ImageView<const T>& source, const Rect& rect, const AnyView& result) const {
  const std::lock_guard lock(mutex_);
  if (done_.empty()) {
    done_ = Image(info_);
    const auto padded = static_cast<std::size_t>(info_.width + 2) * static_cast<std::size_t>(info_.channels);
    above_.assign(padded, 0);
    current_.assign(padded, 0);
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

template class ErrorDiffusion<std::uint8_t>;
template class ErrorDiffusion<std::uint16_t>;
template class ErrorDiffusion<float>;

}  // namespace azulejo
