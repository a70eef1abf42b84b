#include "azulejo/imaging/affine.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/plan.h"
#include "azulejo/engine/transform_fields.h"
#include "azulejo/imaging/affine_kernels.h"
#include "azulejo/imaging/affine_weights.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/math/transform2d.h"

namespace azulejo {
namespace {

constexpr double kLargestSide = 1e6;
constexpr double kFarthest = 1e9;
constexpr double kMostShrinking = 100;

/// The smallest rectangle around the corners of [left, right] × [top, bottom] under a transformation.
struct Extent {
  Extent(const glm::dmat3& m, double left, double top, double right, double bottom) {
    for (const double x : {left, right}) {
      for (const double y : {top, bottom}) {
        const glm::dvec3 p = m * glm::dvec3(x, y, 1);
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
  }
  glm::dvec2 low{1e300, 1e300};
  glm::dvec2 high{-1e300, -1e300};
};

/// The matrix and size of what `options` ask for.
struct Frame2d {
  glm::dmat3 target_from_source;
  double width;
  double height;
};

Frame2d frame_of(const AffineOptions& options, const ImageInfo& source) {
  glm::dmat3 m = options.target_from_source;
  if (m[0].z != 0 || m[1].z != 0 || m[2].z == 0) {
    throw Error(Error::Unsupported,
                fmt::format("matrix: its last row is {},{},{}, expected 0,0,1 for an image", m[0].z, m[1].z, m[2].z));
  }
  m = m / m[2].z;
  if (options.size == AffineSize::Same)
    return {m, static_cast<double>(source.width), static_cast<double>(source.height)};
  // What rounding adds to a side is not worth a row of pixels.
  constexpr double kRounding = 1e-6;
  const Extent extent(m, 0, 0, source.width, source.height);
  const double left = std::floor(extent.low.x + kRounding);
  const double top = std::floor(extent.low.y + kRounding);
  const double width = std::max(std::ceil(extent.high.x - kRounding) - left, 1.0);
  const double height = std::max(std::ceil(extent.high.y - kRounding) - top, 1.0);
  if (!(width <= kLargestSide && height <= kLargestSide)) {
    throw Error(Error::Argument, fmt::format("size: fit makes {:.0f}×{:.0f} pixels, expected at most {:.0f} on a side",
                                             width, height, kLargestSide));
  }
  return {Translation2d{{-left, -top}}.matrix() * m, width, height};
}

/// Whole columns and rows of the source, which may lie outside.
struct Reach {
  std::int64_t left = 0;
  std::int64_t top = 0;
  std::int64_t right = 0;
  std::int64_t bottom = 0;
  int width() const { return static_cast<int>(right - left); }
  int height() const { return static_cast<int>(bottom - top); }
};

class Affine : public TileNode {
 public:
  Affine(const AffineOptions& options, std::span<const ImageInfo> sources)
      : Affine(options, sources, frame_of(options, sources[0])) {}

  bool needs_everything(int) const override { return true; }

  Rect needs(const Rect& result, int) const override {
    if (result.empty()) return {};
    const Reach reach = reach_of(result);
    const ImageInfo& image = sources()[0];
    const Span1 columns = covering(reach.left, reach.right, image.width, border_);
    const Span1 rows = covering(reach.top, reach.bottom, image.height, border_);
    return rect_between(columns.low, rows.low, columns.high, rows.high);
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    const kernels::AffineWeights across = across_.weights();
    const kernels::AffineWeights down = down_.weights();
    resample(
        from[0], results[0], context.scratch, load_row, store_row,
        [&](const Rect& piece, const Reach& reach) { return copied_bytes(from[0], results[0], piece, reach); },
        [&](const kernels::AffinePatch& patch, const kernels::AffineSpan& span, float* row) {
          kernels::AffinePlaces places;
          kernels::affine_places(span, places);
          if (across_.phases == 0 && down_.phases == 0) {
            kernels::affine_bilinear(patch, places, span.count, row);
          } else {
            kernels::affine_weighted(patch, places, across, down, span.count, row);
          }
        });
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    const kernels::AffineWeights across = across_.weights();
    const kernels::AffineWeights down = down_.weights();
    resample(
        from[0], results[0], context.scratch, load_row_reference, store_row_reference,
        [](const Rect&, const Reach&) { return false; },
        [&](const kernels::AffinePatch& patch, const kernels::AffineSpan& span, float* row) {
          kernels::AffinePlaces places;
          kernels::affine_places_reference(span, places);
          if (across_.phases == 0 && down_.phases == 0) {
            kernels::affine_bilinear_reference(patch, places, span.count, row);
          } else {
            kernels::affine_weighted_reference(patch, places, across, down, span.count, row);
          }
        });
  }

  Report report(std::span<const Analysis* const>) const override { return picture_transform_report(asked_); }

 private:
  Affine(const AffineOptions& options, std::span<const ImageInfo> sources, const Frame2d& frame)
      : TileNode(sources),
        format_(row_format(sources[0], options.light)),
        nearest_(options.filter == AffineFilter::Nearest),
        border_(options.border),
        asked_(options.target_from_source),
        source_from_result_(source_from_result(frame)),
        widening_(widening_of(source_from_result_)),
        across_(options.filter, widening_.x),
        down_(options.filter, widening_.y) {
    // One table, two windows: either both interpolate plainly or none does.
    if (across_.phases == 0 && down_.phases > 0) across_ = AffineWindow(options.filter, kBarely);
    if (down_.phases == 0 && across_.phases > 0) down_ = AffineWindow(options.filter, kBarely);
    ImageInfo info = sources[0];
    info.width = static_cast<int>(frame.width);
    info.height = static_cast<int>(frame.height);
    set_results({info});
  }

  static constexpr double kBarely = 1 + 1e-9;  ///< a tent that is looked up

  static glm::dmat3 source_from_result(const Frame2d& frame) {
    const std::optional<glm::dmat3> inverted = inverse(frame.target_from_source);
    if (!inverted) {
      throw Error(Error::Argument,
                  "the transformation is singular: nothing of the image is left, expected one with an "
                  "inverse");
    }
    const Extent extent(*inverted, 0, 0, frame.width, frame.height);
    const double farthest = std::max({-extent.low.x, -extent.low.y, extent.high.x, extent.high.y});
    if (!(farthest <= kFarthest)) {
      throw Error(Error::Argument, fmt::format("the transformation shows what is {:.3g} pixels away, expected at most "
                                               "{:.0e}",
                                               farthest, kFarthest));
    }
    return *inverted;
  }

  /// How many pixels of the source's rows and columns stand for one of the result.
  static glm::dvec2 widening_of(const glm::dmat3& source_from_result) {
    const auto widening = [&](int axis) {
      const double length = std::hypot(source_from_result[0][axis], source_from_result[1][axis]);
      if (!(length <= kMostShrinking)) {
        throw Error(Error::Argument, fmt::format("the transformation shrinks the image to 1/{:.4g}, expected at least "
                                                 "1/{:.0f}; resize makes it smaller first",
                                                 length, kMostShrinking));
      }
      return length < 1 + 1e-9 ? 1.0 : length;  // rounding of a rotation shrinks nothing
    };
    return {widening(0), widening(1)};
  }

  /// The source position of a result pixel's center, in units of which whole ones are source pixels' centers.
  glm::dvec2 position(double x, double y) const {
    const glm::dmat3& m = source_from_result_;
    return {(m[0].x * (x + 0.5) + m[1].x * (y + 0.5)) + m[2].x - 0.5,
            (m[0].y * (x + 0.5) + m[1].y * (y + 0.5)) + m[2].y - 0.5};
  }

  /// All that the windows of these pixels hold, and a pixel more to each side, which rounding may ask for.
  Reach reach_of(const Rect& result) const {
    glm::dvec2 low(1e300);
    glm::dvec2 high(-1e300);
    for (const int x : {result.x, result.right() - 1}) {
      for (const int y : {result.y, result.bottom() - 1}) {
        const glm::dvec2 p = position(x, y);
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
    const auto whole = [](double value) { return static_cast<std::int64_t>(std::floor(value)); };
    return {whole(low.x) - across_.before - 1, whole(low.y) - down_.before - 1,
            whole(high.x) - across_.before + across_.taps + 1, whole(high.y) - down_.before + down_.taps + 1};
  }

  /// Calls f for pieces of the result, not wider than a block of columns, whose sources fit into a cache.
  template <class F>
  void for_pieces(const Rect& rect, F f) const {
    const double widening = std::max(widening_.x, widening_.y);
    int width = kernels::kAffineBlock;
    while (width > 8 && width * widening > 2 * kernels::kAffineBlock) width /= 2;
    const int height = std::clamp(static_cast<int>(32 / widening), 4, 32);
    for (int y = rect.y; y < rect.bottom(); y += height) {
      for (int x = rect.x; x < rect.right();) {
        const int next = std::min((x / width + 1) * width, rect.right());
        f(Rect{x, y, next - x, std::min(height, rect.bottom() - y)});
        x = next;
      }
    }
  }

  /// at_once(piece, reach) may do a piece in another way.
  template <class Load, class Store, class AtOnce, class Sample>
  void resample(const ConstTile& from, const Tile& to, Scratch& scratch, Load load, Store store, AtOnce at_once,
                Sample sample) const {
    const std::size_t bytes = to.pixels.info.pixel_bytes();
    for_pieces(to.rect, [&](const Rect& piece) {
      const auto target = [&](int y) {
        return to.pixels.row(y - to.rect.y) + static_cast<std::size_t>(piece.x - to.rect.x) * bytes;
      };
      const Reach reach = reach_of(piece);
      if (nowhere(reach)) {
        for (int y = piece.y; y < piece.bottom(); ++y)
          std::memset(target(y), 0, static_cast<std::size_t>(piece.width) * bytes);
        return;
      }
      if (nearest_) {
        for (int y = piece.y; y < piece.bottom(); ++y) copy_nearest(from, piece, y, target(y));
        return;
      }
      if (at_once(piece, reach)) return;
      const Scratch::Mark mark = scratch.mark();
      const kernels::AffinePatch patch = patch_of(from, reach, scratch, load);
      auto* const row = scratch.take<float>(format_.values(kernels::kAffineBlock) + 4);
      for (int y = piece.y; y < piece.bottom(); ++y) {
        sample(patch, span_of(piece, y, reach), row);
        store(format_, row, piece.width, target(y));
      }
      scratch.release(mark);
    });
  }

  /// Pieces of bytes that are summed as stored, all inside the image, need no patch.
  bool copied_bytes(const ConstTile& from, const Tile& to, const Rect& piece, const Reach& reach) const {
    const ImageInfo& image = sources()[0];
    const Rect& tile = from.rect;
    const bool plain = across_.phases == 0 && image.type == PixelType::U8 && image.channels != 2 && !format_.curve &&
                       format_.alpha == RowAlpha::Plain;
    if (!plain || reach.left < tile.x || reach.top < tile.y || reach.right > tile.right() ||
        reach.bottom > tile.bottom()) {
      return false;
    }
    // A few bytes behind a window are read: they must be there.
    if (reach.bottom == tile.bottom() && reach.right + 3 > tile.right()) return false;
    const auto row = static_cast<int>(reach.top - tile.y);
    const auto column = static_cast<std::size_t>(reach.left - tile.x);
    const auto channels = static_cast<std::size_t>(image.channels);
    const kernels::AffineBytes bytes{reinterpret_cast<const std::uint8_t*>(from.pixels.row(row)) + column * channels,
                                     from.pixels.stride, image.channels};
    kernels::AffinePlaces places;
    for (int y = piece.y; y < piece.bottom(); ++y) {
      kernels::affine_places(span_of(piece, y, reach), places);
      std::byte* const target = to.pixels.row(y - to.rect.y) + static_cast<std::size_t>(piece.x - to.rect.x) * channels;
      kernels::affine_bilinear_bytes(bytes, places, piece.width, reinterpret_cast<std::uint8_t*>(target));
    }
    return true;
  }

  bool nowhere(const Reach& reach) const {
    const ImageInfo& image = sources()[0];
    return border_ == Border::Constant &&
           (reach.right <= 0 || reach.bottom <= 0 || reach.left >= image.width || reach.top >= image.height);
  }

  kernels::AffineSpan span_of(const Rect& piece, int y, const Reach& reach) const {
    const int block = piece.x / kernels::kAffineBlock * kernels::kAffineBlock;
    const glm::dvec2 start = position(block, y);
    const glm::dvec2 whole{std::floor(start.x), std::floor(start.y)};
    kernels::AffineSpan span;
    span.begin = piece.x - block;
    span.count = piece.width;
    span.x = static_cast<float>(start.x - whole.x);
    span.y = static_cast<float>(start.y - whole.y);
    span.step_x = static_cast<float>(source_from_result_[0].x);
    span.step_y = static_cast<float>(source_from_result_[0].y);
    span.column = static_cast<int>(static_cast<std::int64_t>(whole.x) - across_.before - reach.left);
    span.row = static_cast<int>(static_cast<std::int64_t>(whole.y) - down_.before - reach.top);
    return span;
  }

  /// The source as rows of f32, with what the border rule puts outside.
  template <class Load>
  kernels::AffinePatch patch_of(const ConstTile& from, const Reach& reach, Scratch& scratch, Load load) const {
    const ImageInfo& image = sources()[0];
    const int channels = image.channels;
    const std::size_t stride = (format_.values(reach.width()) + 15) / 16 * 16;
    auto* const values = scratch.take<float>(stride * static_cast<std::size_t>(reach.height()));
    const std::int64_t inside = std::clamp<std::int64_t>(reach.left, 0, image.width);
    const std::int64_t behind = std::clamp<std::int64_t>(reach.right, inside, image.width);
    for (int r = 0; r < reach.height(); ++r) {
      float* const row = values + stride * static_cast<std::size_t>(r);
      const int line = border_index(reach.top + r, image.height, border_);
      if (line < 0) {
        std::fill_n(row, format_.values(reach.width()), 0.0F);
        continue;
      }
      const auto pixel = [&](std::int64_t column) {
        return from.pixels.row(line - from.rect.y) +
               static_cast<std::size_t>(column - from.rect.x) * image.pixel_bytes();
      };
      if (inside < behind) {
        load(format_, pixel(inside), static_cast<int>(behind - inside),
             row + static_cast<std::ptrdiff_t>(inside - reach.left) * channels);
      }
      for (std::int64_t x = reach.left; x < reach.right; ++x) {
        if (x == inside && inside < behind) x = behind;
        if (x >= reach.right) break;
        float* const out = row + static_cast<std::ptrdiff_t>(x - reach.left) * channels;
        const int column = border_index(x, image.width, border_);
        if (column < 0) {
          std::fill_n(out, channels, 0.0F);
        } else {
          load(format_, pixel(column), 1, out);
        }
      }
    }
    return {values, static_cast<std::ptrdiff_t>(stride), channels};
  }

  void copy_nearest(const ConstTile& from, const Rect& piece, int y, std::byte* target) const {
    const ImageInfo& image = sources()[0];
    const std::size_t bytes = image.pixel_bytes();
    const kernels::AffineSpan span = span_of(piece, y, Reach{});
    for (int i = 0; i < span.count; ++i) {
      const auto n = static_cast<float>(span.begin + i);
      const auto nearest = [n](float start, float step) {
        return static_cast<std::int64_t>(std::floor(start + n * step + 0.5F));
      };
      const int column = border_index(span.column + nearest(span.x, span.step_x), image.width, border_);
      const int line = border_index(span.row + nearest(span.y, span.step_y), image.height, border_);
      if (column < 0 || line < 0) {
        std::memset(target, 0, bytes);
      } else {
        std::memcpy(target,
                    from.pixels.row(line - from.rect.y) + static_cast<std::size_t>(column - from.rect.x) * bytes,
                    bytes);
      }
      target += bytes;
    }
  }

  RowFormat format_;
  bool nearest_;
  Border border_;
  glm::dmat3 asked_;
  glm::dmat3 source_from_result_;
  glm::dvec2 widening_;
  AffineWindow across_;
  AffineWindow down_;
};

const Operation& affine_operation() {
  static const Operation kAffine = image_operation<AffineOptions, Affine>(
      "affine", "Moves, turns, scales, shears or mirrors an image.", {{"source", "the image"}},
      {{"result", "the image where it has come to"}}, {});
  return kAffine;
}

/// Of the operation `transform`.
struct TransformImageOptions : TransformOptions {
  AffineFilter filter = AffineOptions().filter;
  Light light = AffineOptions().light;
  Border border = AffineOptions().border;
  AffineSize size = AffineOptions().size;
};

class TransformImage final : public Affine {
 public:
  TransformImage(const TransformImageOptions& options, std::span<const ImageInfo> sources)
      : Affine({picture_transform(options, {0.5 * sources[0].width, 0.5 * sources[0].height}), options.filter,
                options.light, options.border, options.size},
               sources) {}
};

std::vector<Field> image_fields() {
  std::vector<Field> list = picture_transform_fields(
      [](void* options) -> TransformOptions& { return *static_cast<TransformImageOptions*>(options); });
  list.push_back(field("filter", &TransformImageOptions::filter, "how a result pixel is made of source pixels"));
  list.push_back(field("light", &TransformImageOptions::light, "what is summed: linear light or stored values"));
  list.push_back(field("border", &TransformImageOptions::border, "what lies outside the image"));
  list.push_back(field("size", &TransformImageOptions::size, "of the result: the source's, or all that it becomes"));
  return list;
}

}  // namespace

extern const Operation kTransformImage = image_operation<TransformImageOptions, TransformImage>(
    "transform", "Moves, turns, scales, shears or mirrors, in any order.", {{"source", "what is transformed"}},
    {{"result", "where it has come to"},
     {.name = "report",
      .help = "matrix, class, and what it decomposes into",
      .kind = ValueKind::Report,
      .on_request = true}},
    image_fields());

void affine(const ConstAnyView& source, const AnyView& result, const AffineOptions& options, const Run& run) {
  apply_into(affine_operation(), &options, {source}, {result}, run);
}

Image affine(const Image& source, const AffineOptions& options, const Run& run) {
  return std::move(apply(affine_operation(), &options, {&source}, run)[0]);
}

}  // namespace azulejo
