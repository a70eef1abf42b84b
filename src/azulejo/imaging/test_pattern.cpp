#include "azulejo/imaging/test_pattern.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/convert.h"
#include "azulejo/math/arctangent.h"
#include "azulejo/math/sine.h"

namespace azulejo {

namespace {

constexpr float kTurn = 6.28318531F;

/// A cosine of turns from 0 to 1.
float wave(double turns) {
  const double part = turns - std::floor(turns);
  return 0.5F + 0.5F * sine_cosine_of_turns(static_cast<float>(part)).cosine;
}

/// Intensities from 0 to 1 at places of an image.
class PatternFunction {
 public:
  explicit PatternFunction(const TestPatternOptions& options) : options_(options) {
    const auto [sine, cosine] = sine_cosine_of_turns(options.angle_deg / 360.0F);
    across_ = cosine;
    down_ = -sine;  // y is down
    // From the middle to the outermost centers, along the angle.
    extent_ = std::fabs(across_) * (options.width - 1) / 2.0 + std::fabs(down_) * (options.height - 1) / 2.0;
  }

  float operator()(int column, int row) const {
    // From the middle of the image to the center of the pixel.
    const double x = column + 0.5 - options_.width / 2.0;
    const double y = row + 0.5 - options_.height / 2.0;
    const double along = x * across_ + y * down_;
    switch (options_.kind) {
      case Pattern::Ramp: return extent_ > 0 ? static_cast<float>(0.5 + 0.5 * along / extent_) : 0.0F;
      case Pattern::Checker: return field(column) != field(row) ? 1.0F : 0.0F;
      case Pattern::Stripes: return wave(along / static_cast<double>(options_.period));
      case Pattern::Edge: return edge(along);
      case Pattern::SiemensStar: {
        const double turns = static_cast<double>(atan2_deterministic(static_cast<float>(-y), static_cast<float>(x)) /
                                                 kTurn * static_cast<float>(options_.spokes));
        const double part = turns - std::floor(turns);
        return part > 0 && part < 0.5 ? 1.0F : 0.0F;
      }
      default: {
        const double shorter = std::min(options_.width, options_.height);
        return wave(static_cast<double>(options_.frequency) * (x * x + y * y) / shorter);
      }
    }
  }

 private:
  /// Whether a column or row belongs to a second field.
  bool field(int at) const {
    const double half = static_cast<double>(options_.period) / 2;
    return std::fmod(std::floor((at + 0.5) / half), 2.0) != 0;
  }
  float edge(double along) const {
    if (options_.softness == 0) return along > 0 ? 1.0F : along < 0 ? 0.0F : 0.5F;
    return static_cast<float>(std::clamp(0.5 + along / static_cast<double>(options_.softness), 0.0, 1.0));
  }

  TestPatternOptions options_;
  double across_;
  double down_;
  double extent_;
};

class TestPattern final : public TileNode {
 public:
  TestPattern(const TestPatternOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options), intensity_(options) {
    if (options.channels == 2) {
      throw Error(Error::Argument, "channels: 2, expected 1 or 3");
    }
    set_results({{options.width, options.height, options.channels, options.type}});
  }

  void run(std::span<const ConstTile>, std::span<const Tile> results, const TileContext&) const override {
    const Tile& to = results[0];
    visit(to.pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      for (int y = 0; y < result.height; ++y) {
        T* place = result.row(y);
        for (int x = 0; x < result.width; ++x) {
          const float share = intensity_(to.rect.x + x, to.rect.y + y);
          const float value = (options_.low * (1.0F - share) + options_.high * share) * full_range(options_.type);
          const T stored = std::is_same_v<T, float> ? static_cast<T>(value) : static_cast<T>(value + 0.5F);
          for (int c = 0; c < result.channels; ++c) *place++ = stored;
        }
      }
    });
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }

 private:
  TestPatternOptions options_;
  PatternFunction intensity_;
};

}  // namespace

extern const Operation kTestPattern = with_examples(
    image_operation<TestPatternOptions, TestPattern>(
        "test_pattern", "Makes an image to test others with: rings, ramps, fields, edges, spokes.", {},
        {{"pattern", "the image"}},
        {field("kind", &TestPatternOptions::kind, "which pattern"),
         field("width", &TestPatternOptions::width, {1, 1'000'000}, "px", "of the image"),
         field("height", &TestPatternOptions::height, {1, 1'000'000}, "px", "of the image"),
         field("type", &TestPatternOptions::type, "of the pixels"),
         field("channels", &TestPatternOptions::channels, {1, 3}, "", "1, or 3 of the same"),
         field("low", &TestPatternOptions::low, {0, 1}, "", "intensity of what is dark"),
         field("high", &TestPatternOptions::high, {0, 1}, "", "intensity of what is light"),
         field("frequency", &TestPatternOptions::frequency, {0, 4}, "cycles/px",
               "of the zone plate where the shorter side ends"),
         field("period", &TestPatternOptions::period, {0.125, 1'000'000}, "px", "of checker and stripes"),
         field("spokes", &TestPatternOptions::spokes, {1, 10'000}, "", "light ones of the star"),
         field("angle_deg", &TestPatternOptions::angle_deg, {-360, 360}, "deg",
               "direction in which ramp, stripes and edge change"),
         field("softness", &TestPatternOptions::softness, {0, 1'000'000}, "px", "in which the edge rises")}),
    {{"test_pattern:width=256,height=256", "A zone plate: all frequencies, up to the finest."},
     {"test_pattern:width=256,height=256 sample:step=3,show=true", "Sampled, it has rings that aren't there."},
     {"test_pattern:kind=edge,width=256,height=128,angle_deg=20,softness=8,low=0.25,high=0.75 noise",
      "A soft, noisy edge."},
     {"test_pattern:kind=siemens_star,width=256,height=256", "Spokes, finer inwards."}});

void test_pattern(const AnyView& result, const TestPatternOptions& options, const Run& run) {
  apply_into(kTestPattern, &options, {}, {result}, run);
}

Image test_pattern(const TestPatternOptions& options, const Run& run) {
  return std::move(apply(kTestPattern, &options, {}, run)[0]);
}

}  // namespace azulejo
