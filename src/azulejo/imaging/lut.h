#pragma once

#include <optional>
#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

struct LutOptions {
  std::string file = {};                 ///< path of a table; empty: `curve` counts
  NumberGrid curve{2, 2, {0, 0, 1, 1}};  ///< points x,y of a curve, 2–256, intensities 0–1, x growing
  std::optional<float> scale = {};       ///< number in the file that stands for an intensity of 1; none: by its largest
};

/// Maps intensities by a curve or a table; between its values they lie on lines, beyond its ends they are constant.
///
/// source   any size, 1–4 channels, any pixel type; stored values. A file with a curve for each of red, green and blue
///          takes images of 3 color channels
/// result   same shape and type; may be the source itself. Integers are rounded once, half up, and saturate
/// File     2–65536 numbers, one a line, for intensities at even distances from 0 to 1; `scale` divides them: if none is
///          given, 1 where no number is above 1, else 255 where none is above that, else 65535. Or a .cube file with
///          LUT_1D_SIZE, DOMAIN_MIN, DOMAIN_MAX, LUT_1D_INPUT_RANGE, TITLE, which `scale` divides as well if it is given.
///          Empty lines and what follows # are comments
/// Alpha    is copied; premultiplied color is divided by it before and multiplied after
/// NaN      stays NaN
/// Cost     O(pixels); u8 is looked up in a table of 256; the others take O(points) of a curve, O(1) of a table
/// Throws   Error(Argument) for a curve whose x don't grow, for a scale without a file and for channels that the file
///          doesn't fit, Error(Io) for a file that can't be read, Error(Data) for one that isn't such a table,
///          Error(Unsupported) for LUT_3D_SIZE
/// Source   Adobe, Cube LUT Specification 1.0, 2013
AZULEJO_EXPORT void lut(const ConstAnyView& source, const AnyView& result, const LutOptions& options = {},
                        const Run& run = {});
AZULEJO_EXPORT Image lut(const Image& source, const LutOptions& options = {}, const Run& run = {});

}  // namespace azulejo
