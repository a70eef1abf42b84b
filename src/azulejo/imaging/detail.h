#pragma once

#include <vector>

#include "azulejo/engine/border.h"
#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/detail_kernels.h"
#include "azulejo/imaging/light.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {

/// A step that weighs an image against what a Gaussian leaves of it: unsharp_mask, high_boost, high_pass.
///
/// Like the source: each pixel is base · s + gain · d of its color (kernels::detailed), rounded once; alpha is copied.
/// Under alpha, g is the mean of colors weighted by alpha.
/// As f32: the detail alone, in units of full range, of the color channels times alpha.
class Detail : public TileNode {
 public:
  struct Settings {
    float sigma = 1;
    BorderRule border = {};
    Light light = Light::Encoded;
    kernels::DetailWeights weights = {};  ///< threshold as an intensity
    bool as_floats = false;
  };
  Detail(const Settings& settings, std::span<const ImageInfo> sources);

  Rect needs(const Rect& result, int) const override { return grown(result, radius_, radius_); }
  BorderRule border(int) const override { return settings_.border; }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override;
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override;

 private:
  void run_bytes(const ConstTile& source, const Tile& result, Scratch& scratch, bool reference) const;
  void run_band(const ConstAnyView& source, const AnyView& result, Scratch& scratch, bool reference) const;
  void run_floats(const ConstTile& source, const Tile& result, Scratch& scratch, bool reference) const;
  void finish_row(float* center, const float* smoothed, int width, std::byte* result, bool reference) const;
  void combine(float* center, const float* smoothed, int width, bool reference) const;

  Settings settings_;
  RowFormat format_;
  float unit_;  ///< loaded value of an intensity of 1
  int radius_ = 0;
  std::vector<float> weights_;
  std::vector<std::int16_t> fixed_;  ///< weights of bytes that are smoothed in integers; else empty
};

/// A node made from settings that options say.
template <class Node, class Options, typename Node::Settings (*settings)(const Options& options)>
class SettingsNode final : public Node {
 public:
  SettingsNode(const Options& options, std::span<const ImageInfo> sources) : Node(settings(options), sources) {}
};

}  // namespace azulejo
