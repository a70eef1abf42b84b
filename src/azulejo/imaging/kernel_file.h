#pragma once

#include <string>

#include "azulejo/math/number_grid.h"

namespace azulejo {

/// Weights from a file, and what stands for a weight of 1 in them.
struct KernelFile {
  NumberGrid kernel;
  float full = 1;
};

inline constexpr int kLargestKernelSide = 255;
inline constexpr int kLargestWeight = 1'000'000;

/// Reads a kernel: text, a line for each row (or rows with / between) with numbers between blanks, tabs or commas and
/// comments behind #, or an image of one channel, whose intensities are the weights (given as they are stored; `full`
/// is that of 1).
/// Throws Error(Io | Data | Unsupported | Resource | Argument)
KernelFile read_kernel(const std::string& path);

/// `kernel`, or that of `file` if one is named.
/// Throws as read_kernel, and Error(Argument) for a file beside a kernel that isn't the `normal` one, and for a kernel
/// without weights or with more than kLargestKernelSide rows or columns.
KernelFile chosen_kernel(const NumberGrid& kernel, const NumberGrid& normal, const std::string& file);

}  // namespace azulejo
