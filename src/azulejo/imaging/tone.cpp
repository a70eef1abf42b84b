#include "azulejo/imaging/tone.h"

#include <algorithm>

#include "azulejo/imaging/lookup.h"
#include "azulejo/imaging/point.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/imaging/tone_kernels.h"

namespace azulejo {
namespace {

/// Values that are loaded, changed and stored at a time: they stay in the nearest cache.
constexpr std::size_t kBlock = 1536;  // a multiple of every number of channels and of every vector

std::array<std::uint8_t, 256> byte_table(const Tone& tone) {
  std::array<std::uint8_t, 256> table;
  for (std::size_t v = 0; v < 256; ++v) table[v] = static_cast<std::uint8_t>(v);
  std::array<float, 256> row;
  auto* const bytes = reinterpret_cast<std::byte*>(table.data());
  kernels::load_intensities(PixelType::U8, bytes, 256, row.data());
  tone.apply(row.data(), row.data(), 256);
  kernels::store_intensities(PixelType::U8, row.data(), 256, bytes);
  return table;
}

}  // namespace

ToneMap::ToneMap(const ImageInfo& info, Tones tones)
    : type_(info.type),
      alpha_(info.alpha),
      channels_(info.channels),
      colors_(info.color_channels()),
      tones_(std::move(tones)) {
  if (type_ == PixelType::U16 && alpha_ == AlphaState::None && tones_.size() == 1 && tones_[0]->line() != nullptr) {
    line_.emplace(*tones_[0]->line());
  }
  if (type_ != PixelType::U8 || alpha_ == AlphaState::Premultiplied) return;
  for (const auto& each : tones_) tables_.push_back(byte_table(*each));
}

void ToneMap::run(const ConstAnyView& source, const AnyView& result, Scratch& scratch) const {
  if (!tables_.empty()) return look_up(source, result);
  if (line_) {
    return for_rows(source, result, [&](const auto* from, auto* to, std::size_t count, int) {
      if constexpr (std::is_same_v<decltype(to), std::uint16_t*>) kernels::word_line(*line_, from, to, count);
    });
  }
  if (type_ != PixelType::F32 || alpha_ != AlphaState::None || tones_.size() > 1) {
    return run_rows(source, result, scratch);
  }
  for_rows(source, result, [&](const auto* from, auto* to, std::size_t count, int) {
    if constexpr (std::is_same_v<decltype(to), float*>) tones_[0]->apply(from, to, count);
  });
}

void ToneMap::look_up(const ConstAnyView& source, const AnyView& result) const {
  std::array<const std::uint8_t*, 4> tables{};
  for (std::size_t c = 0; c < tables_.size(); ++c) tables[c] = tables_[c].data();
  const auto channels = static_cast<std::size_t>(channels_);
  for_rows(source, result, [&](const auto* from, auto* to, std::size_t count, int period) {
    if constexpr (std::is_same_v<decltype(to), std::uint8_t*>) {
      if (tables_.size() == 1) return kernels::lookup_bytes(from, to, count, tables[0], period);
      kernels::lookup_channels(from, to, count / channels, {tables.data(), channels});
    }
  });
}

void ToneMap::run_rows(const ConstAnyView& source, const AnyView& result, Scratch& scratch) const {
  float* const loaded = scratch.take<float>(kBlock);
  float* const row = scratch.take<float>(kBlock);
  float* const plane = scratch.take<float>(kBlock);
  const std::size_t count = result.info.row_bytes() / size_of(type_);
  const bool premultiplied = alpha_ == AlphaState::Premultiplied;
  for (int y = 0; y < result.info.height; ++y) {
    for (std::size_t i = 0; i < count; i += kBlock) {
      const std::size_t values = std::min(kBlock, count - i);
      kernels::load_intensities(type_, source.row(y) + i * size_of(type_), values, loaded);
      if (premultiplied) kernels::divide_by_alpha(loaded, values, channels_, row);
      apply(premultiplied ? row : loaded, row, values / static_cast<std::size_t>(channels_), plane);
      if (premultiplied) {
        kernels::multiply_by_alpha(loaded, values, channels_, type_ != PixelType::F32, row);
      } else if (alpha_ != AlphaState::None) {
        kernels::keep_alpha(loaded, values, channels_, row);
      }
      kernels::store_intensities(type_, row, values, result.row(y) + i * size_of(type_));
    }
  }
}

/// What becomes of alpha doesn't matter.
void ToneMap::apply(const float* source, float* result, std::size_t pixels, float* plane) const {
  const auto channels = static_cast<std::size_t>(channels_);
  if (tones_.size() == 1) return tones_[0]->apply(source, result, pixels * channels);
  for (std::size_t c = 0; c < tones_.size(); ++c) {
    for (std::size_t x = 0; x < pixels; ++x) plane[x] = source[x * channels + c];
    tones_[c]->apply(plane, plane, pixels);
    for (std::size_t x = 0; x < pixels; ++x) result[x * channels + c] = plane[x];
  }
}

void ToneMap::run_reference(const ConstAnyView& source, const AnyView& result) const {
  visit(result, [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    constexpr float kTop = full_range(kPixelTypeOf<T>);
    const bool premultiplied = alpha_ == AlphaState::Premultiplied;
    for (int y = 0; y < view.height; ++y) {
      const T* from = source.as<T>().row(y);
      T* to = view.row(y);
      for (int x = 0; x < view.width; ++x, from += channels_, to += channels_) {
        const T stored_alpha = from[channels_ - 1];
        const float alpha = premultiplied ? static_cast<float>(stored_alpha) / kTop : 1.0F;
        for (int c = 0; c < colors_; ++c) {
          if constexpr (std::is_same_v<T, std::uint16_t>) {
            if (line_) {
              to[c] = (*line_)(from[c]);
              continue;
            }
          }
          const float color = static_cast<float>(from[c]) / kTop;
          float mapped = tone(c).at(!premultiplied ? color : alpha == 0.0F ? 0.0F : color / alpha);
          if (premultiplied && type_ != PixelType::F32) mapped = mapped > 0.0F ? std::min(mapped, 1.0F) : 0.0F;
          if (premultiplied) mapped = alpha == 0.0F ? 0.0F : mapped * alpha;
          to[c] = rounded<T>(mapped * kTop);
        }
        if (colors_ < channels_) to[colors_] = stored_alpha;
      }
    }
  });
}

}  // namespace azulejo
