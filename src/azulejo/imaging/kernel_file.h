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

/// Throws Error(Argument) for a kernel without weights or with more than kLargestKernelSide rows or columns.
inline constexpr int kLargestKernelSide = 255;
void check_kernel_size(const NumberGrid& kernel);

}  // namespace azulejo
