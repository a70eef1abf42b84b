#include "azulejo/imaging/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/compare_kernels.h"
#include "azulejo/imaging/compare_measures.h"
#include "azulejo/imaging/gaussian_kernels.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/math/exponential.h"

namespace azulejo {
namespace {

constexpr int kReach = 5;

/// The Gaussian window of SSIM, from its middle outwards.
std::array<float, kReach + 1> window_weights() {
  std::array<double, kReach + 1> exact{};
  double sum = 0;
  for (int k = 0; k <= kReach; ++k) {
    exact[static_cast<std::size_t>(k)] = exp_deterministic(-0.5 * k * k / (1.5 * 1.5));
    sum += (k > 0 ? 2 : 1) * exact[static_cast<std::size_t>(k)];
  }
  std::array<float, kReach + 1> weights{};
  std::ranges::transform(exact, weights.begin(), [sum](double weight) { return static_cast<float>(weight / sum); });
  return weights;
}

/// The rows of a tile as intensities, colors weighted by alpha.
class Intensities {
 public:
  Intensities(const ConstTile& tile, bool reference)
      : tile_(tile), format_(row_format(tile.pixels.info, Light::Encoded)), reference_(reference) {
    alpha_unit_ = full_range(tile.pixels.info.type);
    color_unit_ = format_.alpha == RowAlpha::Weigh ? alpha_unit_ * alpha_unit_ : alpha_unit_;
  }
  int channels() const { return format_.channels; }
  int colors() const { return tile_.pixels.info.color_channels(); }
  std::size_t values() const { return format_.values(tile_.rect.width); }

  void load(int y, float* row) const {
    (reference_ ? load_row_reference : load_row)(format_, tile_.pixels.row(y - tile_.rect.y), tile_.rect.width, row);
    if (alpha_unit_ == 1) return;
    const int colors = this->colors();
    if (colors == channels()) {
      if (reference_) {
        for (std::size_t i = 0; i < values(); ++i) row[i] /= color_unit_;
      } else {
        kernels::divide_row(row, values(), color_unit_);
      }
      return;
    }
    for (std::size_t i = 0; i < values();) {
      for (int c = 0; c < channels(); ++c, ++i) row[i] /= c < colors ? color_unit_ : alpha_unit_;
    }
  }

 private:
  const ConstTile& tile_;
  RowFormat format_;
  bool reference_;
  float color_unit_;  ///< loaded value of intensity 1
  float alpha_unit_;
};

float distance(float a, float b) {
  if (a == b || (a != a && b != b)) return 0;
  return std::fabs(a - b);
}

class Compare final : public TileNode {
 public:
  Compare(const CompareOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options), weights_(window_weights()) {
    const ImageInfo& a = sources[0];
    const ImageInfo& b = sources[1];
    const auto is_light = [](const ImageInfo& info) { return info.color == ColorState::Linear; };
    const bool fits = a.width == b.width && a.height == b.height && a.channels == b.channels &&
                      a.color_channels() == b.color_channels();
    if (!fits || (is_light(a) != is_light(b) && a.color != ColorState::Data && b.color != ColorState::Data)) {
      throw Error(Error::Argument,
                  fmt::format("reference: {}, expected size, channels and light of {}", describe(b), describe(a)));
    }
    if (!options.ssim && options.metric == Metric::Ssim && (options.at_most || options.at_least)) {
      throw Error(Error::Argument, "metric: ssim is not computed, expected ssim=true");
    }
    const ImageInfo difference{a.width,        a.height,         a.color_channels(),
                               PixelType::F32, ColorState::Data, AlphaState::None};
    ImageInfo similarity = difference;
    similarity.channels = 1;
    set_results({difference, similarity});
  }

  Rect needs(const Rect& result, int) const override { return grown(result, kReach, kReach); }

  std::unique_ptr<Analysis> result_analysis(int result) const override {
    const ImageInfo& info = sources()[0];
    if (result == 0) {
      const bool whole = info.type == sources()[1].type && info.type != PixelType::F32 &&
                         info.alpha == AlphaState::None && options_.gain == 1;
      return std::make_unique<DifferenceMeasure>(options_.gain, whole ? static_cast<int>(full_range(info.type)) : 0);
    }
    if (!options_.ssim) return nullptr;
    const Rect inner = grown(info.rect(), -kReach, -kReach);
    return std::make_unique<SimilarityMeasure>(inner.empty() ? info.rect() : inner);
  }

  Comparison comparison(std::span<const Analysis* const> analyses) const {
    const auto& difference = static_cast<const DifferenceMeasure&>(*analyses[2]);
    Comparison found;
    found.maximum = difference.maximum;
    found.maximum_x = difference.maximum_x;
    found.maximum_y = difference.maximum_y;
    found.mean = difference.mean();
    found.mse = difference.mean_square();
    found.psnr = found.mse > 0 ? -10 * std::log10(found.mse) : std::numeric_limits<double>::infinity();
    if (analyses[3] != nullptr) found.ssim = static_cast<const SimilarityMeasure&>(*analyses[3]).mean();
    found.pixels = difference.pixels;
    found.differing_pixels = difference.differing;
    found.not_finite_pixels = difference.not_finite;
    return found;
  }

  Report report(std::span<const Analysis* const> analyses) const override {
    const Comparison found = comparison(analyses);
    Report report{to_json(found), is_close(found, options_)};
    if (options_.at_most || options_.at_least) report.json.set("close", report.verdict);
    return report;
  }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    compute(sources, results, context.scratch, false);
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    compute(sources, results, context.scratch, true);
  }

 private:
  void compute(std::span<const ConstTile> sources, std::span<const Tile> results, Scratch& scratch,
               bool reference) const {
    const Intensities images[] = {{sources[0], reference}, {sources[1], reference}};
    const Rect& around = sources[0].rect;
    const auto plane = static_cast<std::size_t>(around.width) * static_cast<std::size_t>(around.height);
    float* const rows[] = {scratch.take<float>(images[0].values()), scratch.take<float>(images[1].values())};
    const bool similar = results[1].wanted();
    float* const luma[] = {similar ? scratch.take<float>(plane) : nullptr,
                           similar ? scratch.take<float>(plane) : nullptr};
    const Rect& inner = grown(around, -kReach, -kReach);
    for (int y = around.y; y < around.bottom(); ++y) {
      const bool shown = results[0].wanted() && y >= inner.y && y < inner.bottom();
      if (!similar && !shown) continue;
      for (std::size_t s = 0; s < 2; ++s) {
        images[s].load(y, rows[s]);
        if (similar) to_luma(images[s], rows[s], around.width, luma[s] + (y - around.y) * around.width);
      }
      if (shown) {
        subtract(images[0], rows[0] + kReach * images[0].channels(), rows[1] + kReach * images[0].channels(),
                 inner.width, results[0].pixels.as<float>().row(y - inner.y), reference);
      }
    }
    if (similar) compare_windows(luma, around, results[1].pixels.as<float>(), scratch, reference);
  }

  void subtract(const Intensities& image, const float* a, const float* b, int width, float* result,
                bool reference) const {
    const int channels = image.channels();
    const int colors = image.colors();
    if (channels == colors && !reference) {
      return kernels::difference_row(a, b, static_cast<std::size_t>(width) * static_cast<std::size_t>(channels),
                                     options_.gain, result);
    }
    if (channels == colors) {
      for (int i = 0; i < width * channels; ++i) result[i] = distance(a[i], b[i]) * options_.gain;
      return;
    }
    for (int x = 0; x < width; ++x, a += channels, b += channels) {
      const float alpha = distance(a[colors], b[colors]);
      for (int c = 0; c < colors; ++c) {
        const float color = distance(a[c], b[c]);
        *result++ = (color > alpha || color != color ? color : alpha) * options_.gain;
      }
    }
  }

  static void to_luma(const Intensities& image, const float* row, int width, float* luma) {
    const int channels = image.channels();
    for (int x = 0; x < width; ++x, row += channels) {
      luma[x] = image.colors() < 3 ? row[0] : (0.299F * row[0] + 0.587F * row[1]) + 0.114F * row[2];
    }
  }

  /// Means, variances and covariance in windows: of x, y, x², y², xy.
  void compare_windows(float* const luma[2], const Rect& around, const ImageView<float>& result, Scratch& scratch,
                       bool reference) const {
    const auto plane = static_cast<std::size_t>(around.width) * static_cast<std::size_t>(around.height);
    const auto width = static_cast<std::size_t>(result.width);
    const auto area = width * static_cast<std::size_t>(result.height);
    float* const product = scratch.take<float>(plane);
    float* smoothed[5];
    const std::pair<const float*, const float*> pairs[5] = {
        {luma[0], nullptr}, {luma[1], nullptr}, {luma[0], luma[0]}, {luma[1], luma[1]}, {luma[0], luma[1]}};
    for (std::size_t p = 0; p < 5; ++p) {
      const auto [a, b] = pairs[p];
      const float* values = a;
      if (b != nullptr) {
        if (reference) {
          for (std::size_t i = 0; i < plane; ++i) product[i] = a[i] * b[i];
        } else {
          kernels::product_row(a, b, plane, product);
        }
        values = product;
      }
      smoothed[p] = scratch.take<float>(area);
      const kernels::GaussianTile<float> tile{values,       around.width, smoothed[p],
                                              result.width, result.width, result.height};
      kernels::gaussian_tile(tile, {}, weights_.data(), kReach, scratch);
    }
    for (int y = 0; y < result.height; ++y) {
      float* const row = result.row(y);
      const std::size_t first = static_cast<std::size_t>(y) * width;
      if (!reference) {
        const float* const means[] = {smoothed[0] + first, smoothed[1] + first, smoothed[2] + first,
                                      smoothed[3] + first, smoothed[4] + first};
        kernels::similarity_row(means, width, row);
        continue;
      }
      for (std::size_t x = 0; x < width; ++x) {
        const std::size_t i = first + x;
        const float xx = smoothed[0][i] * smoothed[0][i];
        const float yy = smoothed[1][i] * smoothed[1][i];
        const float xy = smoothed[0][i] * smoothed[1][i];
        const float variances = (smoothed[2][i] - xx) + (smoothed[3][i] - yy);
        const float covariance = smoothed[4][i] - xy;
        const float ratio = ((2 * xy + kernels::kSsimC1) * (2 * covariance + kernels::kSsimC2)) /
                            ((xx + yy + kernels::kSsimC1) * (variances + kernels::kSsimC2));
        row[x] = ratio > 1 ? 1 : ratio;  // what rounding leaves
      }
    }
  }

  CompareOptions options_;
  std::array<float, kReach + 1> weights_;
};

}  // namespace

extern const Operation kCompare = with_examples(
    image_operation<CompareOptions, Compare>(
        "compare", "Measures how far two images are apart, and shows where.",
        {{"source", "the image"}, {"reference", "what it is compared with"}},
        {{"report", "maximum, mean, MSE, PSNR, SSIM", ValueKind::Report},
         {"difference", "absolute differences of intensities, f32"},
         {"similarity", "structural similarity around each pixel, f32: 1 where nothing differs"}},
        {field("metric", &CompareOptions::metric, "what at_most and at_least are about"),
         field("at_most", &CompareOptions::at_most, {0, 1e9}, "", "exit status 3 if the metric is larger"),
         field("at_least", &CompareOptions::at_least, {-1000, 1000}, "",
               "exit status 3 if the metric, psnr or ssim, is smaller"),
         field("ssim", &CompareOptions::ssim, "structural similarity is computed"),
         field("gain", &CompareOptions::gain, {1e-5, 100'000}, "", "the difference picture is multiplied by it")}),
    {{"noisy.png compare:reference=gray.png", "A picture with noise, compared with the one without."},
     {"noisy.png compare:reference=gray.png as:c @c.similarity", "Where the structure is lost."}});

Comparison compare(const ConstAnyView& source, const ConstAnyView& reference, const CompareOptions& options,
                   const Run& run) {
  Comparison found;
  const ImageInfo infos[] = {source.info, reference.info};
  const auto node = make_node(kCompare, &options, infos);
  const ConstAnyView sources[] = {source, reference};
  measure(kCompare, &options, sources, run, [&](std::span<const Analysis* const> analyses) {
    found = static_cast<const Compare&>(*node).comparison(analyses);
  });
  return found;
}

Comparison compare(const Image& source, const Image& reference, const CompareOptions& options, const Run& run) {
  return compare(source.any(), reference.any(), options, run);
}

void compare(const ConstAnyView& source, const ConstAnyView& reference, const AnyView& difference,
             const AnyView& similarity, const CompareOptions& options, const Run& run) {
  apply_into(kCompare, &options, {source, reference}, {difference, similarity}, run);
}

bool is_close(const Comparison& comparison, const CompareOptions& options) {
  const double values[] = {comparison.maximum, comparison.mean, comparison.mse, comparison.psnr,
                           comparison.ssim.value_or(1)};
  const double value = values[static_cast<std::size_t>(options.metric)];
  if (comparison.not_finite_pixels > 0 && (options.at_most || options.at_least)) return false;
  // The bounds are floats: 0.1 is taken as the one nearest to it.
  return (!options.at_most || static_cast<float>(value) <= *options.at_most) &&
         (!options.at_least || static_cast<float>(value) >= *options.at_least);
}

Json to_json(const Comparison& comparison) {
  Json json = Json::object();
  json.set("maximum", comparison.maximum)
      .set("maximum_at", Json::object().set("x", comparison.maximum_x).set("y", comparison.maximum_y))
      .set("mean", comparison.mean)
      .set("mse", comparison.mse)
      .set("psnr", comparison.psnr);
  if (comparison.ssim) json.set("ssim", *comparison.ssim);
  return json.set("pixels", comparison.pixels)
      .set("differing_pixels", comparison.differing_pixels)
      .set("not_finite_pixels", comparison.not_finite_pixels);
}

}  // namespace azulejo
