#include "azulejo/imaging/frequency_filter.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/fourier.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/math/exponential.h"

namespace azulejo {
namespace {

/// The image's size with what continues it.
struct Padding {
  Padding(int size, const FrequencyFilterOptions& options) : inside(size), border(options.border) {
    if (border == Border::Wrap) {
      padded = size;
      return;
    }
    const int reach = std::max(32, static_cast<int>(std::ceil(8 / options.cutoff)));
    padded = FourierPlan::fast_size(size + 2 * std::min(reach, size));
  }
  /// The pixel that stands at a place; −1: outside.
  int source(int place) const {
    const int beyond = padded - inside;
    return border_index(place < inside + beyond / 2 ? place : place - padded, inside, border);
  }

  int inside;
  int padded = 0;
  Border border;
};

/// A low-pass response, from its values along either axis.
class LowPass {
 public:
  LowPass(const FrequencyFilterOptions& options, float cutoff, int width, int height)
      : shape_(options.shape), order_(options.order), u_(squares(width, cutoff)), v_(squares(height, cutoff)) {}

  float operator()(int v, int u) const {
    const double horizontal = u_[static_cast<std::size_t>(u)];
    const double vertical = v_[static_cast<std::size_t>(v)];
    if (shape_ == FrequencyShape::Gaussian) return static_cast<float>(horizontal * vertical);
    const double square = horizontal + vertical;
    if (shape_ == FrequencyShape::Ideal) return square <= 1 ? 1.0F : 0.0F;
    double power = 1;
    for (int i = 0; i < order_; ++i) power *= square;
    return static_cast<float>(1 / (1 + power));
  }

 private:
  /// (f / cutoff)² of each frequency; of a Gaussian, its values.
  std::vector<double> squares(int size, float cutoff) const {
    std::vector<double> values(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) {
      const double frequency = 2.0 * std::min(i, size - i) / size / double{cutoff};
      const double square = frequency * frequency;
      values[static_cast<std::size_t>(i)] =
          shape_ == FrequencyShape::Gaussian ? exp_deterministic(-0.5 * square) : square;
    }
    return values;
  }

  FrequencyShape shape_;
  int order_;
  std::vector<double> u_;
  std::vector<double> v_;
};

/// Filters the channels of an image, one after the other, in a copy of f32.
class Filtering {
 public:
  Filtering(const ConstAnyView& source, const FrequencyFilterOptions& options, const Run& run)
      : source_(source),
        options_(options),
        run_(run),
        format_(row_format(source.info, options.light)),
        x_(source.width(), options),
        y_(source.height(), options),
        low_(options, options.cutoff, x_.padded, y_.padded),
        upper_(options, options.upper, x_.padded, y_.padded),
        values_(f32_info(source.info), run.limits) {
    parallel_for(rows(), 16, run, [&](std::size_t begin, std::size_t end) {
      for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
        load_row(format_, source.row(y), source.width(), row(y));
      }
    });
    outside_ = outside_pixel();
    for (int c = 0; c < source.info.color_channels(); ++c) filter(c);
  }

  void write(const AnyView& result) {
    parallel_for(rows(), 16, run_, [&](std::size_t begin, std::size_t end) {
      for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
        if (options_.output == FilterOutput::F32) {
          write_f32(row(y), result.as<float>().row(y));
        } else {
          add_offset(row(y));
          store_row(format_, row(y), source_.width(), result.row(y));
        }
      }
    });
  }

 private:
  static ImageInfo f32_info(ImageInfo info) {
    info.type = PixelType::F32;
    return info;
  }
  std::size_t rows() const { return static_cast<std::size_t>(source_.height()); }
  float* row(int y) { return values_.view<float>().row(y); }

  /// What Border::Constant puts beside the image, as a loaded pixel.
  std::array<float, 4> outside_pixel() const {
    std::array<float, 4> loaded{};
    visit_type(source_.info.type, [&](auto zero) {
      using T = decltype(zero);
      const float level = options_.border_value * full_range(kPixelTypeOf<T>);
      const std::array<T, 4> pixel = [&] {
        std::array<T, 4> same{};
        same.fill(static_cast<T>(std::is_same_v<T, float> ? level : level + 0.5F));
        return same;
      }();
      load_row(format_, reinterpret_cast<const std::byte*>(pixel.data()), 1, loaded.data());
    });
    return loaded;
  }

  float response(int v, int u) const {
    if (options_.pass == FrequencyPass::Low) return low_(v, u);
    if (options_.pass == FrequencyPass::High) return 1 - low_(v, u);
    const float band = (1 - low_(v, u)) * upper_(v, u);
    return options_.pass == FrequencyPass::Band ? band : 1 - band;
  }

  /// The difference from the first pixel is what is transformed: of constants, nothing.
  void filter(int c) {
    const int channels = source_.info.channels;
    const float first = row(0)[c];
    HalfSpectrum spectrum(x_.padded, y_.padded);
    fourier_rows(spectrum, run_, [&](int y, float* values) {
      const int from_y = y_.source(y);
      const float* const from = from_y < 0 ? nullptr : row(from_y);
      for (int x = 0; x < x_.padded; ++x) {
        const int from_x = x < x_.inside ? x : x_.source(x);
        const bool outside = from == nullptr || from_x < 0;
        values[x] = (outside ? outside_[static_cast<std::size_t>(c)] : from[from_x * channels + c]) - first;
      }
    });
    fourier_columns(spectrum, run_, [&](int v, int u, float* re, float* im) {
      const int count = std::min(FourierPlan::kLanes, spectrum.columns - u);
      for (int i = 0; i < count; ++i) {
        const float factor = response(v, u + i);
        re[i] *= factor;
        im[i] *= factor;
      }
    });
    const float kept = first * response(0, 0);
    const float scale = 1.0F / (static_cast<float>(x_.padded) * static_cast<float>(y_.padded));
    inverse_fourier_rows(spectrum, run_, y_.inside, [&](int y, const float* values) {
      float* const to = row(y) + c;
      for (int x = 0; x < x_.inside; ++x) to[x * channels] = values[x] * scale + kept;
    });
  }

  void add_offset(float* values) const {
    const int colors = source_.info.color_channels();
    const int channels = source_.info.channels;
    const float unit = row_unit(format_);
    const bool has_alpha = colors < channels;
    const float offset = options_.offset * (has_alpha ? unit / full_range(format_.type) : unit);
    const bool saturates = has_alpha && format_.type != PixelType::F32 && format_.alpha == RowAlpha::Plain;
    for (int x = 0; x < source_.width(); ++x, values += channels) {
      for (int c = 0; c < colors; ++c) {
        values[c] += has_alpha ? offset * values[colors] : offset;
        if (saturates && values[c] > values[colors]) values[c] = values[colors];
      }
    }
  }

  void write_f32(const float* values, float* result) const {
    const int colors = source_.info.color_channels();
    const float unit = row_unit(format_);
    for (int x = 0; x < source_.width(); ++x, values += source_.info.channels) {
      for (int c = 0; c < colors; ++c) *result++ = values[c] / unit + options_.offset;
    }
  }

  const ConstAnyView& source_;
  const FrequencyFilterOptions& options_;
  const Run& run_;
  RowFormat format_;
  Padding x_;
  Padding y_;
  LowPass low_;
  LowPass upper_;
  Image values_;
  std::array<float, 4> outside_{};
};

ImageInfo result_info(ImageInfo info, const FrequencyFilterOptions& options) {
  if (options.output == FilterOutput::Same) return info;
  info.type = PixelType::F32;
  info.color = ColorState::Data;
  info.channels = info.color_channels();
  info.alpha = AlphaState::None;
  return info;
}

void check(const FrequencyFilterOptions& options) {
  const bool two = options.pass == FrequencyPass::Band || options.pass == FrequencyPass::Stop;
  if (two && !(options.upper > options.cutoff)) {
    throw Error(Error::Argument,
                fmt::format("upper: {}, expected more than the cut-off {}", options.upper, options.cutoff));
  }
}

Image filtered(const Image& source, const FrequencyFilterOptions& options, const Run& run) {
  check(options);
  Image result(result_info(source.info(), options), run.limits);
  result.share_metadata(source);
  if (!source.empty()) Filtering(source.any(), options, run).write(result.any());
  return result;
}

}  // namespace

extern const Operation kFrequencyFilter = with_examples(
    value_operation<FrequencyFilterOptions>(
        "frequency_filter", "Filters by frequency.", {{"source", "the image"}}, {{"result", "the filtered image"}},
        {field("pass", &FrequencyFilterOptions::pass, "which frequencies are let through"),
         field("shape", &FrequencyFilterOptions::shape, "how the response falls"),
         field("cutoff", &FrequencyFilterOptions::cutoff, {0.001, 1.5}, "", "share of Nyquist's frequency"),
         field("upper", &FrequencyFilterOptions::upper, {0.001, 1.5}, "", "upper cut-off, for pass=band and stop"),
         field("order", &FrequencyFilterOptions::order, {1, 20}, "", "steepness, for shape=butterworth"),
         field("offset", &FrequencyFilterOptions::offset, {-1e3, 1e3}, "", "intensity added to the result"),
         field("output", &FrequencyFilterOptions::output,
               "same: the source's type, saturated; f32: negative values stay"),
         field("border", &FrequencyFilterOptions::border, "what lies outside the image"),
         field("border_value", &FrequencyFilterOptions::border_value, {0, 1}, "",
               "intensity outside, for border=constant"),
         field("light", &FrequencyFilterOptions::light, "what is filtered: stored values or linear light")},
        [](std::span<const Value> inputs, const FrequencyFilterOptions& options, const Run& run) {
          return std::vector<Value>{Value(filtered(*inputs[0].image(), options, run))};
        }),
    {{"gray.png frequency_filter:shape=ideal,cutoff=0.15",
      "An ideal low pass blurs, and rings: ripples run along every edge."},
     {"gray.png frequency_filter:shape=butterworth,cutoff=0.15", "Butterworth's blurs as much without ripples."},
     {"gray.png frequency_filter:pass=high,cutoff=0.1,offset=0.5",
      "A high pass on middle gray: shading is gone, edges and texture stay."}});

void frequency_filter(const ConstAnyView& source, const AnyView& result, const FrequencyFilterOptions& options,
                      const Run& run) {
  kFrequencyFilter.check(&options);
  check(options);
  const ImageInfo expected = result_info(source.info, options);
  if (result.info.width != expected.width || result.info.height != expected.height ||
      result.info.channels != expected.channels || result.info.type != expected.type) {
    throw Error(Error::Argument, "frequency_filter: the result has another size, type or channels than the source");
  }
  Filtering(source, options, run).write(result);
}

Image frequency_filter(const Image& source, const FrequencyFilterOptions& options, const Run& run) {
  kFrequencyFilter.check(&options);
  return filtered(source, options, run);
}

}  // namespace azulejo
