#pragma once

#include <limits>

#include "azulejo/engine/tile_node.h"

namespace azulejo {

/// The smallest and the largest intensity of an image's color channels. NaN, infinities and pixels of alpha 0 don't
/// count; premultiplied values are divided by alpha.
class ValueRange : public Analysis {
 public:
  explicit ValueRange(const ImageInfo& info) : info_(info) {}

  void add(const ConstTile& tile, Scratch& scratch) override;
  void merge(const Analysis& other) override;

  /// 0 where nothing counts.
  float smallest() const { return smallest_ <= largest_ ? smallest_ : 0; }
  float largest() const { return smallest_ <= largest_ ? largest_ : 0; }

 private:
  template <class T>
  void add_row(const T* row, int width);
  void add_value(float value);

  ImageInfo info_;
  float smallest_ = std::numeric_limits<float>::max();
  float largest_ = std::numeric_limits<float>::lowest();
};

}  // namespace azulejo
