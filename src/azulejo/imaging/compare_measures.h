#pragma once

#include <cstdint>

#include "azulejo/engine/tile_node.h"
#include "azulejo/math/exact_sum.h"

namespace azulejo {

/// What `compare` gathers of its difference picture.
class DifferenceMeasure final : public Analysis {
 public:
  /// gain   of the picture
  /// steps  differences are whole multiples of 1/steps: 255 or 65535; 0: any numbers
  DifferenceMeasure(float gain, int steps) : gain_(gain), steps_(steps) {}

  void add(const ConstTile& tile, Scratch& scratch) override;
  void merge(const Analysis& other) override;

  double mean() const { return values() > 0 ? sum() / values() : 0; }
  double mean_square() const { return values() > 0 ? squares() / values() : 0; }

  std::int64_t pixels = 0;
  std::int64_t differing = 0;
  std::int64_t not_finite = 0;
  float maximum = 0;
  int maximum_x = 0;
  int maximum_y = 0;

 private:
  void take_maximum(float value, int x, int y);
  void add_pixel(const float* pixel, int x, int y);
  void add_whole_row(const float* row, int x, int y, int width);
  double values() const { return static_cast<double>(pixels - not_finite) * channels_; }
  double sum() const;
  double squares() const;

  float gain_;
  int steps_;
  int channels_ = 1;
  std::uint64_t whole_sum_ = 0;      ///< in steps
  std::uint64_t whole_squares_ = 0;  ///< in steps²
  ExactSum sum_;
  ExactSum squares_;
};

/// The mean of its similarity picture, over a part of it.
class SimilarityMeasure final : public Analysis {
 public:
  explicit SimilarityMeasure(const Rect& part) : part_(part) {}
  void add(const ConstTile& tile, Scratch& scratch) override;
  void merge(const Analysis& other) override;
  double mean() const { return count_ > 0 ? sum_.value() / static_cast<double>(count_) : 1; }

 private:
  Rect part_;
  std::int64_t count_ = 0;
  ExactSum sum_;
};

}  // namespace azulejo
