#pragma once

#include <string>

#include "azulejo/math/number_grid.h"

namespace azulejo {

/// Weights from a file, and what stands for a weight of 1 in them.
struct KernelFile {
  NumberGrid kernel;
  float full = 1;
};

/// Reads a kernel: text, a line for each row with numbers between blanks, tabs or commas, or an image of one channel,
/// whose intensities are the weights (given as they are stored; `full` is that of 1).
/// Throws Error(Io | Data | Unsupported | Resource)
KernelFile read_kernel(const std::string& path);

}  // namespace azulejo
