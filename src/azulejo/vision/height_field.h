#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/data/view.h"

namespace azulejo {

enum class HeightChannel : std::uint8_t { Luma, Red, Green, Blue, Alpha };
constexpr std::array<std::string_view, 5> enum_names(HeightChannel) {
  return {"luma", "red", "green", "blue", "alpha"};
}

struct HeightFieldOptions {
  HeightChannel channel = HeightChannel::Luma;
  float height = 0.3F;                          ///< of an intensity of 1, of a number 1 of a table; may be negative
  std::optional<float> spacing = std::nullopt;  ///< from sample to sample; auto: the longer side is 2
  std::optional<float> base = std::nullopt;     ///< where its flat bottom lies; auto: none, it is open
  std::string file = {};                        ///< a table of numbers instead of an image
};

/// A surface over a grid of heights: a vertex a pixel, y up, the picture's first row at the back, its middle at x = z = 0.
///
/// luma      0.299 R + 0.587 G + 0.114 B of stored values; alpha counts only where it is asked for; f32 as it is
/// faces     two triangles between four samples, along the diagonal whose ends differ less in height; one where one of
///           the four is missing
/// holes     where a height is not finite
/// NORMAL    that of the surface through the neighbors: central differences, one-sided at borders and holes
/// TEXCOORD_0  the centers of the pixels, so the image fits as a texture
/// base      walls and a bottom, with vertices of their own at equal positions: closed, unless holes touch in one
///           sample. It must lie below all heights
/// nothing   fewer than 2 × 2 samples give points without faces
/// Same      the same bytes for any number of threads
/// Throws    Error(Argument) for a base that isn't below, alpha of an image without; Error(Resource) beyond
///           run.limits.memory_bytes
/// Cost      O(pixels); 32 bytes a pixel and 24 a cell, twice that with a base
AZULEJO_EXPORT Mesh height_field(const ConstAnyView& image, const HeightFieldOptions& options = {},
                                 const Run& run = {});

/// The same of the rows of a table, as read_csv reads it: empty cells are holes.
/// Throws    also Error(Data) for a column of texts, and as read_csv
AZULEJO_EXPORT Mesh height_field(const std::string& csv_file, const HeightFieldOptions& options = {},
                                 const Run& run = {});

}  // namespace azulejo
