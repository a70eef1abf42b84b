#include "azulejo/imaging/sample.h"

#include <cstring>
#include <type_traits>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/imaging/sum_row_blocks.h"
#include "azulejo/math/exponential.h"

namespace azulejo {
namespace {

/// The samples of one direction: which pixels each is made of.
struct SampleAxis {
  SampleAxis(int source, const SampleOptions& options) : step(options.step) {
    for (int begin = 0; begin < source; begin += step) {
      const int end = std::min(begin + step, source);
      const int middle = begin + (end - begin - 1) / 2;
      std::vector<double> exact;
      int from = begin;
      if (options.prefilter == Prefilter::None) {
        from = middle;
        exact = {1.0};
      } else if (options.prefilter == Prefilter::Box) {
        exact.assign(static_cast<std::size_t>(end - begin), 1.0);
      } else {
        // Twice the distance from the middle is whole; σ is half a step.
        const int reach = 2 * step;
        from = std::max(0, middle - reach);
        for (int k = from; k <= std::min(source - 1, middle + 1 + reach); ++k) {
          const double twice = 2 * k + 1 - begin - end;
          exact.push_back(exp_deterministic(-0.5 * twice * twice / (static_cast<double>(step) * step)));
        }
      }
      double sum = 0;
      for (const double weight : exact) sum += weight;
      std::vector<float> rounded;
      for (const double weight : exact) rounded.push_back(static_cast<float>(weight / sum));
      first.push_back(from);
      weights.push_back(std::move(rounded));
    }
  }

  int samples() const { return static_cast<int>(first.size()); }
  int end(int j) const {
    return first[static_cast<std::size_t>(j)] + static_cast<int>(weights[static_cast<std::size_t>(j)].size());
  }

  int step;
  std::vector<int> first;
  std::vector<std::vector<float>> weights;
};

/// Copies pixels, those of sample i to where `width` pixels of it begin: `before` of them are left out at the left.
void spread_row(const std::byte* samples, std::size_t bytes, int step, int before, int width, std::byte* result) {
  int x = 0;
  for (; x < width; samples += bytes, before = 0) {
    for (int k = before; k < step && x < width; ++k, ++x, result += bytes) std::memcpy(result, samples, bytes);
  }
}

class Sample final : public TileNode {
 public:
  Sample(const SampleOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources),
        options_(options),
        across_(sources[0].width, options),
        down_(sources[0].height, options),
        format_(row_format(sources[0], options.light)) {
    ImageInfo info = sources[0];
    if (!options.show) {
      info.width = across_.samples();
      info.height = down_.samples();
    }
    set_results({info});
  }

  Rect needs(const Rect& result, int) const override {
    if (result.empty()) return {};
    const Rect samples = samples_of(result);
    return rect_between(across_.first[static_cast<std::size_t>(samples.x)],
                        down_.first[static_cast<std::size_t>(samples.y)], across_.end(samples.right() - 1),
                        down_.end(samples.bottom() - 1));
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    compute(from[0], results[0], context.scratch, false);
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    compute(from[0], results[0], context.scratch, true);
  }

 private:
  /// The samples that part of the result shows.
  Rect samples_of(const Rect& result) const {
    if (!options_.show) return result;
    const int step = options_.step;
    return rect_between(result.x / step, result.y / step, (result.right() - 1) / step + 1,
                        (result.bottom() - 1) / step + 1);
  }

  void compute(const ConstTile& from, const Tile& to, Scratch& scratch, bool reference) const {
    const Rect samples = samples_of(to.rect);
    const std::size_t bytes = to.pixels.info.pixel_bytes();
    auto* const row = scratch.take<std::byte>(static_cast<std::size_t>(samples.width) * bytes);
    for (int j = samples.y; j < samples.bottom(); ++j) {
      const int y = options_.show ? std::max(j * options_.step, to.rect.y) : j;
      std::byte* const place = to.pixels.row(y - to.rect.y);
      sample_row(from, samples, j, options_.show ? row : place, scratch, reference);
      if (!options_.show) continue;
      const int end = std::min((j + 1) * options_.step, to.rect.bottom());
      spread_row(row, bytes, options_.step, to.rect.x - samples.x * options_.step, to.rect.width, place);
      for (int k = y + 1; k < end; ++k) std::memcpy(to.pixels.row(k - to.rect.y), place, to.pixels.info.row_bytes());
    }
  }

  void sample_row(const ConstTile& from, const Rect& samples, int j, std::byte* result, Scratch& scratch,
                  bool reference) const {
    const auto at = static_cast<std::size_t>(j);
    const int first = down_.first[at];
    if (options_.prefilter == Prefilter::None) {
      const std::size_t bytes = from.pixels.info.pixel_bytes();
      const std::byte* const source = from.pixels.row(first - from.rect.y);
      for (int i = samples.x; i < samples.right(); ++i, result += bytes) {
        std::memcpy(result, source + static_cast<std::size_t>(pixel_of(i) - from.rect.x) * bytes, bytes);
      }
      return;
    }
    const auto mark = scratch.mark();
    if (counts_exactly()) {
      visit_type(format_.type, [&](auto zero) {
        if constexpr (!std::is_same_v<decltype(zero), float>) {
          box_row(from, samples, j, reinterpret_cast<decltype(zero)*>(result), scratch);
        }
      });
      scratch.release(mark);
      return;
    }
    const auto values = format_.values(from.rect.width);
    float* const total = scratch.take<float>(values);
    sum_row_blocks(down_.weights[at].data(), static_cast<int>(down_.weights[at].size()), values, reference, scratch,
                   total, [&](int t, float* row) {
                     (reference ? load_row_reference : load_row)(format_, from.pixels.row(first + t - from.rect.y),
                                                                 from.rect.width, row);
                   });
    float* const filtered = scratch.take<float>(format_.values(samples.width));
    for (int i = samples.x; i < samples.right(); ++i) {
      sum_across(total, from.rect.x, i, filtered + format_.values(i - samples.x));
    }
    (reference ? store_row_reference : store_row)(format_, filtered, samples.width, result);
    scratch.release(mark);
  }

  /// Means of integers, as they are stored, are quotients of whole numbers.
  bool counts_exactly() const {
    return options_.prefilter == Prefilter::Box && format_.type != PixelType::F32 && !format_.curve &&
           format_.alpha == RowAlpha::Plain;
  }

  template <class T>
  void box_row(const ConstTile& from, const Rect& samples, int j, T* result, Scratch& scratch) const {
    using Sum = std::conditional_t<sizeof(T) == 1, std::uint16_t, std::uint32_t>;  // of up to 256 values
    const auto at = static_cast<std::size_t>(j);
    const int height = static_cast<int>(down_.weights[at].size());
    const auto values = format_.values(from.rect.width);
    Sum* const sums = scratch.take<Sum>(values);
    std::fill_n(sums, values, Sum{0});
    for (int y = down_.first[at]; y < down_.first[at] + height; ++y) {
      const T* const row = from.pixels.as<T>().row(y - from.rect.y);
      for (std::size_t i = 0; i < values; ++i) sums[i] = static_cast<Sum>(sums[i] + row[i]);
    }
    for (int i = samples.x; i < samples.right(); ++i, result += format_.channels) {
      const int width = across_.end(i) - pixel_of(i);
      const auto area = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
      const Sum* const pixel = sums + format_.values(pixel_of(i) - from.rect.x);
      for (int c = 0; c < format_.channels; ++c) {
        std::uint64_t sum = 0;
        for (int k = 0; k < width; ++k) sum += pixel[k * format_.channels + c];
        result[c] = static_cast<T>((2 * sum + area) / (2 * area));
      }
    }
  }

  int pixel_of(int i) const { return across_.first[static_cast<std::size_t>(i)]; }

  void sum_across(const float* total, int left, int i, float* sample) const {
    const std::vector<float>& weights = across_.weights[static_cast<std::size_t>(i)];
    double sums[4] = {};
    const float* pixel = total + format_.values(pixel_of(i) - left);
    for (const float weight : weights) {
      for (int c = 0; c < format_.channels; ++c) sums[c] += static_cast<double>(weight) * static_cast<double>(pixel[c]);
      pixel += format_.channels;
    }
    for (int c = 0; c < format_.channels; ++c) sample[c] = static_cast<float>(sums[c]);
  }

  SampleOptions options_;
  SampleAxis across_;
  SampleAxis down_;
  RowFormat format_;
};

}  // namespace

extern const Operation kSample = with_examples(
    image_operation<SampleOptions, Sample>(
        "sample", "Samples an image in space, with or without a filter against aliases.", {{"source", "the image"}},
        {{"samples", "one pixel a sample, or as many as the source has"}},
        {field("step", &SampleOptions::step, {1, 256}, "px", "from a sample to the next"),
         field("prefilter", &SampleOptions::prefilter, "against aliases"),
         field("show", &SampleOptions::show, "the result has the source's size; each sample fills its square"),
         field("light", &SampleOptions::light, "what the prefilter averages: light or stored values")}),
    {{"photo.png sample:step=6,show=true", "Every sixth pixel: fine structure becomes a coarse one that isn't there."},
     {"photo.png sample:step=6,prefilter=box,show=true", "Each sample is the mean of its square."}});

void sample(const ConstAnyView& source, const AnyView& result, const SampleOptions& options, const Run& run) {
  apply_into(kSample, &options, {source}, {result}, run);
}

Image sample(const Image& source, const SampleOptions& options, const Run& run) {
  return std::move(apply(kSample, &options, {&source}, run)[0]);
}

}  // namespace azulejo
