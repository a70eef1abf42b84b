#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/linear_function.h"

namespace azulejo {

/// A function of one intensity; 0–1 is the full range of every pixel type. Immutable.
class Tone {
 public:
  virtual ~Tone() = default;
  /// The definition.
  virtual float at(float intensity) const = 0;
  /// result[i] = at(source[i]), the same bytes, with vectors. In place is allowed.
  virtual void apply(const float* source, float* result, std::size_t count) const = 0;
  /// The function if it is a line: 16-bit values have a kernel for that.
  virtual const LinearFunction* line() const { return nullptr; }
};

/// A tone of a function object and the vectors that do the same (tone_functions.h).
template <class Function,
          void (*kernel)(const Function& function, const float* source, float* result, std::size_t count)>
class KernelTone final : public Tone {
 public:
  explicit KernelTone(const Function& function) : function_(function) {}
  float at(float intensity) const override { return function_(intensity); }
  void apply(const float* source, float* result, std::size_t count) const override {
    kernel(function_, source, result, count);
  }
  const LinearFunction* line() const override {
    if constexpr (std::is_same_v<Function, LinearFunction>) return &function_;
    return nullptr;
  }

 private:
  Function function_;
};

/// One for all color channels, or one for each.
using Tones = std::vector<std::unique_ptr<const Tone>>;

/// Tones made ready for pixels of a kind: bytes take a table of 256, 16-bit values a line or vectors of f32.
///
/// Alpha     is copied; premultiplied color is divided by it before and multiplied after, and 0 where it is 0
/// Rounding  of integers once, half up, saturated (premultiplied: to its alpha); NaN becomes 0. f32 is as the tone says
class ToneMap {
 public:
  ToneMap(const ImageInfo& info, Tones tones);
  void run(const ConstAnyView& source, const AnyView& result, Scratch& scratch) const;
  void run_reference(const ConstAnyView& source, const AnyView& result) const;

 private:
  const Tone& tone(int channel) const { return *tones_[tones_.size() == 1 ? 0 : static_cast<std::size_t>(channel)]; }
  void look_up(const ConstAnyView& source, const AnyView& result) const;
  void run_rows(const ConstAnyView& source, const AnyView& result, Scratch& scratch) const;
  void apply(const float* source, float* result, std::size_t pixels, float* plane) const;

  PixelType type_;
  AlphaState alpha_;
  int channels_;
  int colors_;
  Tones tones_;
  std::optional<WordLine> line_;                       ///< of 16-bit values without alpha
  std::vector<std::array<std::uint8_t, 256>> tables_;  ///< of bytes that aren't premultiplied; one a tone
};

/// A step whose tones depend on its options and the kind of its source alone: `make` throws as its constructor.
template <class Options, Tones (*make)(const Options& options, const ImageInfo& source)>
class ToneNode final : public TileNode {
 public:
  ToneNode(const Options& options, std::span<const ImageInfo> sources)
      : TileNode(sources), map_(sources[0], make(options, sources[0])) {
    set_results({sources[0]});
  }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    map_.run(sources[0].pixels, results[0].pixels, context.scratch);
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext&) const override {
    map_.run_reference(sources[0].pixels, results[0].pixels);
  }

 private:
  ToneMap map_;
};

/// The tones of a step with one function for all channels.
template <class SomeTone, class Function>
Tones one_tone(const Function& function) {
  Tones tones;
  tones.push_back(std::make_unique<SomeTone>(function));
  return tones;
}

}  // namespace azulejo
