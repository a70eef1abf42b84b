#pragma once

#include <cstddef>

namespace azulejo {

/// A sum in double precision of kCount values side by side.
template <std::size_t kCount>
class WeightedSum {
 public:
  void add(const float* values) {
    for (std::size_t i = 0; i < kCount; ++i) sums_[i] += static_cast<double>(values[i]);
  }
  void add(const float* values, double weight) {
    for (std::size_t i = 0; i < kCount; ++i) sums_[i] += static_cast<double>(values[i]) * weight;
  }
  void add(const WeightedSum& other, double weight) {
    for (std::size_t i = 0; i < kCount; ++i) sums_[i] += other.sums_[i] * weight;
  }
  void scale(double factor) {
    for (double& each : sums_) each *= factor;
  }
  void store(float* values) const {
    for (std::size_t i = 0; i < kCount; ++i) values[i] = static_cast<float>(sums_[i]);
  }

 private:
  double sums_[kCount] = {};
};

}  // namespace azulejo
