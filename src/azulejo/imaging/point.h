#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "azulejo/engine/tile_node.h"

namespace azulejo {

/// Whether a view's rows follow each other without a gap.
template <class T>
bool is_gapless(const ImageView<T>& view) {
  return view.stride == static_cast<std::ptrdiff_t>(view.width) * view.channels;
}

/// Calls f(source row, result row, values in a row, period) for the rows of two views of the same shape and type; all
/// rows at once where nothing lies between them.
/// With a period other than 0, the last value of each period is alpha.
template <class F>
void for_rows(const ConstAnyView& source, const AnyView& result, F f) {
  visit(result, [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    const auto from = source.as<T>();
    const int period = result.info.alpha == AlphaState::None ? 0 : view.channels;
    const auto count = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.channels);
    if (is_gapless(view) && is_gapless(from)) {
      f(from.row(0), view.row(0), count * static_cast<std::size_t>(view.height), period);
    } else {
      for (int y = 0; y < view.height; ++y) f(from.row(y), view.row(y), count, period);
    }
  });
}

/// A step that makes each value from the value at its place, and copies alpha.
///
/// Point   Point<T>(options) for a pixel type; its T operator()(T) const is the definition
/// kernel  the same for a tile: point_tile of point_inl.h, dispatched to the machine's vectors
template <class Options, template <class> class Point,
          void (*kernel)(const ConstAnyView& source, const AnyView& result, const Options& options)>
class PointNode final : public TileNode {
 public:
  PointNode(const Options& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    set_results({sources[0]});
  }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    kernel(sources[0].pixels, results[0].pixels, options_);
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext&) const override {
    for_rows(sources[0].pixels, results[0].pixels, [&](auto* source, auto* result, std::size_t count, int period) {
      const Point<std::remove_pointer_t<decltype(result)>> point(options_);
      for (std::size_t i = 0; i < count; ++i) {
        const bool alpha = period > 0 && i % static_cast<std::size_t>(period) + 1 == static_cast<std::size_t>(period);
        result[i] = alpha ? source[i] : point(source[i]);
      }
    });
  }

 private:
  Options options_;
};

}  // namespace azulejo
