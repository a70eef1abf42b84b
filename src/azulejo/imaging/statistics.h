#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct StatisticsOptions {
  std::vector<float> percentiles = {1, 5, 25, 50, 75, 95, 99};  ///< each 0–100
};

/// Of one channel, or of all color channels together. Intensities: 1 is the full range.
struct ChannelStatistics {
  std::string name;        ///< "gray", "red", "green", "blue", "channel 0" …, "all"
  std::int64_t count = 0;  ///< values; without NaN and infinities
  std::int64_t not_finite = 0;
  double minimum = 0;
  double maximum = 0;
  double mean = 0;
  double standard_deviation = 0;  ///< of the values themselves: divided by their count
  double entropy = 0;             ///< bits a value, in 256 steps of the range 0–1
  std::vector<double> percentiles;
};

struct Statistics {
  std::vector<ChannelStatistics> channels;  ///< color channels
  ChannelStatistics all;
};

/// Measures the values of an image.
///
/// source       any size, 1–4 channels, any pixel type; color channels. Pixels of alpha 0 are left out; premultiplied
///              color is divided by alpha
/// Exact        integers: exact but for the last division and root. f32: sums are exact in any order; percentiles are
///              within 0.4 % of the value. The least value of which at least the percentage is not above it
/// No values    (all transparent, or NaN): zeros
/// Cost         O(pixels), bounded memory
/// Throws       Error(Argument) for a percentage out of range
/// Source       Gonzalez & Woods, Digital Image Processing, 4th ed., 3.3 (3-24 to 3-27)
AZULEJO_EXPORT Statistics statistics(const ConstAnyView& source, const StatisticsOptions& options = {},
                                     const Run& run = {});
AZULEJO_EXPORT Statistics statistics(const Image& source, const StatisticsOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Json to_json(const Statistics& statistics, const StatisticsOptions& options);

}  // namespace azulejo
