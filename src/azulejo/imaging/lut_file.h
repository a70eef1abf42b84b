#pragma once

#include <optional>
#include <string>
#include <vector>

namespace azulejo {

/// A table of a file, ready to be looked up: one for all channels, or three for red, green and blue.
struct LutTable {
  float first = 0;            ///< intensity of the first value
  float last = 1;             ///< intensity of the last value
  std::vector<float> values;  ///< at even distances
};

/// The file of lut.h. scale  number that stands for an intensity of 1
/// Throws  Error(Io), Error(Data), Error(Unsupported)
std::vector<LutTable> read_lut(const std::string& path, std::optional<float> scale);

}  // namespace azulejo
