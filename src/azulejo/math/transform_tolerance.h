#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace azulejo {

/// Whether a determinant is lost in rounding; size: the product of the lengths of the columns.
inline bool is_singular(double determinant, double size) {
  constexpr double kLost = 1.0 / (std::int64_t{1} << 48);
  return !(std::fabs(determinant) > kLost * size) || !std::isfinite(determinant) || !std::isfinite(1 / determinant);
}

/// What counts as equal in a matrix with these entries.
class Nearly {
 public:
  Nearly(double tolerance, std::initializer_list<double> entries) : tolerance_(tolerance) {
    for (const double entry : entries) largest_ = std::max(largest_, std::fabs(entry));
  }
  bool same(double a, double b) const { return std::fabs(a - b) <= tolerance_ * largest_; }
  /// Of a scalar product of columns.
  bool no_product(double product) const { return std::fabs(product) <= tolerance_ * largest_ * largest_; }

 private:
  double tolerance_;
  double largest_ = 0;
};

}  // namespace azulejo
