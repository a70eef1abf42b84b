#pragma once

// For benchmarks only.

#include <functional>
#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {

/// The peer of a function of one byte: OpenCV's lookup in a table that `operation` makes of every byte.
inline ImageCall table_peer(const std::function<Image(const Image& source)>& operation) {
  Image every(256, 1, 1);
  for (int v = 0; v < 256; ++v) every.view<std::uint8_t>()(v, 0) = static_cast<std::uint8_t>(v);
  const Image result = operation(every);
  const cv::Mat table = mat(result.any()).clone();
  return [table](const ConstAnyView& source, const AnyView& to) { cv::LUT(mat(source), table, mat(to)); };
}

}  // namespace azulejo::bench
