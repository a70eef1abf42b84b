#pragma once

#include <cmath>
#include <cstddef>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"
#include "azulejo/vision/height_field.h"

namespace azulejo {

/// Heights in rows; not finite: there is none.
struct HeightGrid {
  std::size_t columns = 0;
  std::size_t rows = 0;
  Array<float> heights;

  float at(std::size_t x, std::size_t y) const { return heights[y * columns + x]; }
  bool is_there(std::size_t x, std::size_t y) const { return std::isfinite(at(x, y)); }
};

/// Throws Error(Argument) for a channel that the image hasn't.
HeightGrid height_grid(const ConstAnyView& image, const HeightFieldOptions& options, const Run& run);
/// Throws Error(Data) for a column of texts, and as read_csv.
HeightGrid height_grid(const std::string& csv_file, const HeightFieldOptions& options, const Run& run);

/// The mesh of height_field.
Mesh height_mesh(const HeightGrid& grid, const HeightFieldOptions& options, const Run& run);

}  // namespace azulejo
