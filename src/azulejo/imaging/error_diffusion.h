#pragma once

#include <mutex>

#include "azulejo/data/image.h"
#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/quantize_levels.h"

namespace azulejo {

/// Floyd and Steinberg's dithering of an image, from its first row on, as far as it was asked for. An analysis, because
/// there is one in each computation; it gathers nothing.
template <class T>
class ErrorDiffusion final : public Analysis {
 public:
  ErrorDiffusion(const QuantizeLevels<T>& levels, const ImageInfo& info) : levels_(levels), info_(info) {}

  void add(const ConstTile&, Scratch&) override {}
  void merge(const Analysis&) override {}

  /// Rows of the result; those that aren't there yet are computed. For several threads.
  /// source     the whole image
  /// result     the part of the result at `rect`
  /// reference  value by value; the same for all calls
  void take(const ImageView<const T>& source, const Rect& rect, const AnyView& result, bool reference) const;

 private:
  void compute_row(const T* source, T* result) const;
  void compute_band(const ImageView<const T>& source, int height) const;

  const QuantizeLevels<T>& levels_;  ///< the node's, which lives longer
  ImageInfo info_;
  mutable std::mutex mutex_;
  mutable Image done_;
  mutable int rows_ = 0;                ///< that are done
  mutable std::vector<float> above_;    ///< differences of the row before, with a pixel of 0 at both ends
  mutable std::vector<float> current_;  ///< of the row being computed
  mutable std::vector<float> band_;     ///< amounts and levels of rows that are computed together
};

extern template class ErrorDiffusion<std::uint8_t>;
extern template class ErrorDiffusion<std::uint16_t>;
extern template class ErrorDiffusion<float>;

}  // namespace azulejo
