#pragma once

#include <cstddef>
#include <vector>

namespace azulejo {

/// Numbers in rows of equal length: a matrix, the weights of a kernel, the points of a curve (a row `x,y` each).
/// As text: `1,2,1/2,4,2/1,2,1`.
struct NumberGrid {
  int rows = 0;
  int columns = 0;
  std::vector<float> values;  ///< row by row

  bool empty() const { return values.empty(); }
  float operator()(int row, int column) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  friend bool operator==(const NumberGrid&, const NumberGrid&) = default;
};

}  // namespace azulejo
