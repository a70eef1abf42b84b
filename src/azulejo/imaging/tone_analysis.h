#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/linear_function.h"
#include "azulejo/imaging/tone.h"

namespace azulejo {

/// Counts of equal steps of intensity from 0 to 1, both ends included: 256 of u8, 65536 of u16 and f32, where what lies
/// outside is counted at the ends.
using LevelCounts = std::span<const std::uint64_t>;

/// The steps of a histogram between which most of it lies.
struct PercentileSteps {
  std::size_t low = 0;
  std::size_t high = 0;  ///< not below low
};

/// The lowest step with more than the share `low` of all counts up to it, and the highest with more than 1 − `high` from
/// it on: 0 and 1 give the first and the last that occur. Both 0 for an empty histogram.
PercentileSteps percentile_steps(LevelCounts counts, double low, double high);

/// The line on which the intensity of the low step becomes 0 and that of the high one 1, cut to that; where both are
/// the same, nothing changes.
/// count  steps of the histogram
LinearFunction line_between(const PercentileSteps& steps, std::size_t count);

/// What follows from the histograms of an image's color channels: tones for each of its values.
class ToneAnalysis : public Analysis {
 public:
  /// Called with one histogram for all color channels, or one each.
  using MakeTones = std::function<Tones(std::span<const LevelCounts> histograms)>;
  static std::unique_ptr<ToneAnalysis> make(const ImageInfo& info, bool per_channel, MakeTones make_tones);

  virtual const std::vector<LevelCounts>& histograms() const = 0;
  virtual const ToneMap& map() const = 0;
};

}  // namespace azulejo
