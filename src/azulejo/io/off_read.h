#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"
#include "azulejo/io/input.h"
#include "azulejo/io/off_colors.h"
#include "azulejo/io/off_header.h"

namespace azulejo {

/// Any of OFF's kinds, text or binary. Values that a row lacks (a colour, a normal, texture coordinates) are white, 0 and
/// 0. v of texture coordinates is upwards in the file, and turned. Throws Error(Data | Unsupported | Resource).
Mesh read_off(const std::shared_ptr<const Input>& input, const Run& run);

/// A run of faces.
struct OffFaces {
  Array<std::uint32_t> counts;  ///< corners of each
  Array<std::uint32_t> corners;
  Array<float> colors;  ///< four of each, NaN where there is none; empty: of no face in this run
  OffColorKinds kinds;

  void add_color(const float* values, std::size_t count, bool real);  ///< of the face that was added last
};

/// What the rows of a file give.
struct OffRows {
  Array<glm::vec3> positions;
  Array<float> normals;        ///< empty: none
  Array<float> vertex_colors;  ///< four of each; empty: none
  Array<float> texcoords;      ///< empty: none
  OffColorKinds vertex_kinds;
  std::vector<OffFaces> faces;  ///< in the order of the file

  explicit OffRows(const OffHeader& header);
  /// What follows the position in a row; bit i of `reals` is set where value i was no integer.
  void set_vertex(std::size_t vertex, const float* values, std::size_t count, unsigned reals, OffColorKinds& kinds);
};

void read_off_text(const std::shared_ptr<const Input>& input, const OffHeader& header, OffRows& rows, const Run& run);
void read_off_binary(const std::shared_ptr<const Input>& input, const OffHeader& header, OffRows& rows);

}  // namespace azulejo
