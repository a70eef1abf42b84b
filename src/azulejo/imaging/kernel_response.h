#pragma once

#include <optional>
#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

struct KernelResponseOptions {
  NumberGrid kernel = {3, 3, {1, 1, 1, 1, 1, 1, 1, 1, 1}};  ///< weights, up to 255 × 255
  std::string file = {};                                    ///< where they are read from instead; empty: nowhere
  bool normalize = true;                                    ///< divides the weights by their sum, if that isn't 0
  int size = 256;                                           ///< of the picture, 16–2048
};

/// What a kernel does to waves: |H| is what it multiplies the amplitude of a frequency with.
struct KernelResponse {
  Image picture;       ///< gray u8, |H| ÷ its largest value, from −Nyquist's frequency to it, 0 in the middle
  double at_zero = 0;  ///< |H| of constants: the magnitude of the weights' sum
  double at_nyquist_x = 0;
  double at_nyquist_y = 0;
  double largest = 0;  ///< of the picture's frequencies
  /// The lowest frequency in cycles a pixel, right or down, where |H| falls to 1/√2 (−3 dB) of that of constants; none:
  /// nowhere, or constants give 0
  std::optional<double> cutoff_x;
  std::optional<double> cutoff_y;
  bool separable = false;
};

/// Tells the frequency response of a kernel: H(f) = Σ kernel(i) · e^(−2πi f · i).
///
/// kernel    as convolve's; the picture's column x stands for (x − size / 2) / size cycles a pixel
/// cut-offs  are looked for in steps of 1/4096 cycle a pixel, then halved to 10⁻⁹
/// Cost      O(size² · rows + size · weights)
/// Throws    Error(Argument) for an option out of range, an empty kernel or a larger one;
///           Error(Io | Data | Unsupported | Resource) of the kernel's file
/// Source    Gonzalez & Woods, Digital Image Processing, 4th ed., 4.7
AZULEJO_EXPORT KernelResponse kernel_response(const KernelResponseOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Json to_json(const KernelResponse& response);

}  // namespace azulejo
