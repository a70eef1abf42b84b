#include "azulejo/io/convert_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

float rec601(float red, float green, float blue) { return 0.299F * red + 0.587F * green + 0.114F * blue; }

bool is_gray(const ImageInfo& info) { return info.color_channels() < 3; }

/// What a color value becomes when it goes from one state to another.
float transferred(float value, ColorState from, ColorState to) {
  if (from == ColorState::Linear && to == ColorState::Srgb) return linear_to_srgb(value);
  if (from == ColorState::Srgb && to == ColorState::Linear) return srgb_to_linear(value);
  return value;
}

}  // namespace

RowConverter::RowConverter(const ImageInfo& source, const ImageInfo& result, const std::array<float, 3>& background)
    : source_(source), result_(result) {
  same_ = source.type == result.type && source.channels == result.channels && source.alpha == result.alpha &&
          (source.color == result.color || source.color == ColorState::Data || result.color == ColorState::Data);
  for (std::size_t i = 0; i < 3; ++i) {
    background_[i] = transferred(background[i], ColorState::Srgb, result.color);
  }
  if (is_gray(result)) background_[0] = rec601(background_[0], background_[1], background_[2]);
  if (source.type == PixelType::F32 || same_) return;
  const auto full = static_cast<std::size_t>(full_range(source.type));
  decode_.resize(full + 1);
  for (std::size_t i = 0; i <= full; ++i) decode_[i] = static_cast<float>(i) / static_cast<float>(full);
}

void RowConverter::stretch(float low, float high) {
  stretched_ = true;
  low_ = low;
  scale_ = high > low ? 1 / (high - low) : 0;
}

void RowConverter::convert(const ConstAnyView& source, const AnyView& result) {
  width_ = source.info.width;
  if (same_ && !stretched_) {
    const std::size_t bytes = static_cast<std::size_t>(width_) * result_.pixel_bytes();
    for (int y = 0; y < source.info.height; ++y) std::memcpy(result.row(y), source.row(y), bytes);
    return;
  }
  row_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(source_.channels));
  narrowed_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(result_.channels));
  for (int y = 0; y < source.info.height; ++y) {
    load(source, y);
    if (source_.alpha == AlphaState::Premultiplied) straighten();
    transfer();
    change_channels();
    if (result_.alpha == AlphaState::Premultiplied) premultiply();
    store(result, y);
  }
}

void RowConverter::load(const ConstAnyView& source, int y) {
  switch (source_.type) {
    case PixelType::U8:
      std::transform(source.as<std::uint8_t>().row(y), source.as<std::uint8_t>().row(y) + row_.size(), row_.begin(),
                     [&](std::uint8_t value) { return decode_[value]; });
      break;
    case PixelType::U16:
      std::transform(source.as<std::uint16_t>().row(y), source.as<std::uint16_t>().row(y) + row_.size(), row_.begin(),
                     [&](std::uint16_t value) { return decode_[value]; });
      break;
    case PixelType::F32: std::memcpy(row_.data(), source.row(y), row_.size() * sizeof(float)); break;
  }
  if (!stretched_) return;
  const auto channels = static_cast<std::size_t>(source_.channels);
  const auto colors = static_cast<std::size_t>(source_.color_channels());
  for (std::size_t i = 0; i < row_.size(); i += channels) {
    for (std::size_t c = 0; c < colors; ++c) row_[i + c] = (row_[i + c] - low_) * scale_;
  }
}

void RowConverter::straighten() {
  const auto channels = static_cast<std::size_t>(source_.channels);
  for (std::size_t i = 0; i < row_.size(); i += channels) {
    const float alpha = row_[i + channels - 1];
    const float inverse = alpha > 0 ? 1 / alpha : 0;
    for (std::size_t c = 0; c + 1 < channels; ++c) row_[i + c] = alpha == 1 ? row_[i + c] : row_[i + c] * inverse;
  }
}

void RowConverter::transfer() {
  if (source_.color == result_.color || source_.color == ColorState::Data || result_.color == ColorState::Data) return;
  const auto channels = static_cast<std::size_t>(source_.channels);
  const auto colors = static_cast<std::size_t>(source_.color_channels());
  for (std::size_t i = 0; i < row_.size(); i += channels) {
    for (std::size_t c = 0; c < colors; ++c) row_[i + c] = transferred(row_[i + c], source_.color, result_.color);
  }
}

void RowConverter::change_channels() {
  if (source_.channels == result_.channels &&
      (source_.alpha == AlphaState::None) == (result_.alpha == AlphaState::None)) {
    narrowed_ = row_;
    return;
  }
  const auto from = static_cast<std::size_t>(source_.channels);
  const auto from_colors = static_cast<std::size_t>(source_.color_channels());
  const auto to = static_cast<std::size_t>(result_.channels);
  const auto to_colors = static_cast<std::size_t>(result_.color_channels());
  const bool drop_alpha = source_.alpha != AlphaState::None && result_.alpha == AlphaState::None;
  for (std::size_t x = 0; x < static_cast<std::size_t>(width_); ++x) {
    const float* const in = &row_[x * from];
    float* const out = &narrowed_[x * to];
    if (from_colors >= 3 && to_colors < 3) {
      out[0] = rec601(in[0], in[1], in[2]);
      std::fill(out + 1, out + to_colors, 0.0F);
    } else {
      for (std::size_t c = 0; c < to_colors; ++c) out[c] = c < from_colors ? in[c] : from_colors == 1 ? in[0] : 0.0F;
    }
    if (drop_alpha) {
      const float alpha = std::clamp(in[from - 1], 0.0F, 1.0F);
      for (std::size_t c = 0; c < std::min<std::size_t>(to_colors, 3); ++c) {
        out[c] = out[c] * alpha + background_[c] * (1 - alpha);
      }
    }
    if (result_.alpha != AlphaState::None) out[to - 1] = source_.alpha == AlphaState::None ? 1.0F : in[from - 1];
  }
}

void RowConverter::premultiply() {
  const auto channels = static_cast<std::size_t>(result_.channels);
  for (std::size_t i = 0; i < narrowed_.size(); i += channels) {
    for (std::size_t c = 0; c + 1 < channels; ++c) narrowed_[i + c] *= narrowed_[i + channels - 1];
  }
}

void RowConverter::store(const AnyView& result, int y) {
  switch (result_.type) {
    case PixelType::U8: store_integers(result.as<std::uint8_t>().row(y)); break;
    case PixelType::U16: store_integers(result.as<std::uint16_t>().row(y)); break;
    case PixelType::F32: std::memcpy(result.row(y), narrowed_.data(), narrowed_.size() * sizeof(float)); break;
  }
}

template <class T>
void RowConverter::store_integers(T* row) {
  const float full = full_range(result_.type);
  std::int64_t clipped = 0;
  for (std::size_t i = 0; i < narrowed_.size(); ++i) {
    const float rounded = narrowed_[i] * full + 0.5F;
    // Only what would have been another integer is clipped: 1.0000001 is not. NaN fails both comparisons.
    const bool fits = rounded >= 0 && rounded < full + 1;
    clipped += fits ? 0 : 1;
    row[i] = static_cast<T>(fits ? rounded : rounded > full ? full : 0.0F);
  }
  if (source_.type == PixelType::F32) clipped_ += clipped;
}

}  // namespace azulejo
