#include "azulejo/imaging/resize.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/resize_passes.h"

namespace azulejo {
namespace {

constexpr int kLargestSide = 1'000'000;

struct Size {
  std::int64_t width;
  std::int64_t height;
};

Size result_size(const ResizeOptions& options, const ImageInfo& source) {
  // a · b / c, rounded half up
  const auto follow = [](std::int64_t a, std::int64_t b, std::int64_t c) { return (2 * a * b + c) / (2 * c); };
  const auto scaled = [&](int side) {
    // Rounded to f32 first: 25 · 0.7 is to be 17.5, though 0.7F is a little less than 0.7.
    return static_cast<std::int64_t>(static_cast<double>(static_cast<float>(side) * options.scale) + 0.5);
  };
  if ((options.width || options.height) && options.scale != 1.0F) {
    throw Error(Error::Argument, fmt::format("scale: {} beside a {}, expected one of both", options.scale,
                                             options.width ? "width" : "height"));
  }
  Size size{scaled(source.width), scaled(source.height)};
  if (options.width) size = {*options.width, follow(source.height, *options.width, source.width)};
  if (options.height) {
    size.height = *options.height;
    if (!options.width) size.width = follow(source.width, *options.height, source.height);
  }
  size = {std::max<std::int64_t>(size.width, 1), std::max<std::int64_t>(size.height, 1)};
  const char* const blamed = options.width ? "width" : options.height ? "height" : "scale";
  if (size.width > kLargestSide || size.height > kLargestSide) {
    throw Error(Error::Argument, fmt::format("{}: makes {}×{} pixels, expected at most {} on a side", blamed,
                                             size.width, size.height, kLargestSide));
  }
  return size;
}

/// Copies pixels of kBytes bytes, from the columns of a table.
template <std::size_t kBytes>
void copy_columns(const TapTable& columns, const Rect& from, const std::byte* source, const Rect& to,
                  std::byte* result) {
  const int* const first = columns.first_of(to.x);
  for (int x = 0; x < to.width; ++x) {
    std::memcpy(result + static_cast<std::size_t>(x) * kBytes,
                source + static_cast<std::size_t>(first[x] - from.x) * kBytes, kBytes);
  }
}

auto column_copier(std::size_t pixel_bytes) {
  switch (pixel_bytes) {
    case 1: return &copy_columns<1>;
    case 2: return &copy_columns<2>;
    case 3: return &copy_columns<3>;
    case 4: return &copy_columns<4>;
    case 6: return &copy_columns<6>;
    case 8: return &copy_columns<8>;
    case 12: return &copy_columns<12>;
    default: return &copy_columns<16>;
  }
}

class Resize final : public TileNode {
 public:
  Resize(const ResizeOptions& options, std::span<const ImageInfo> sources)
      : Resize(options, sources, result_size(options, sources[0])) {}

  Rect needs(const Rect& result, int) const override {
    if (result.empty()) return {};
    return rect_between(across_.first(result.x), down_.first(result.y),
                        across_.first(result.right() - 1) + across_.taps(),
                        down_.first(result.bottom() - 1) + down_.taps());
  }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    if (copies()) return copy(sources[0], results[0]);
    with_passes(results[0].rect,
                [&](const ResizePasses& passes) { passes.run(sources[0], results[0], context.scratch); });
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext&) const override {
    if (copies()) return copy(sources[0], results[0]);
    with_passes(results[0].rect, [&](const ResizePasses& passes) { passes.run_reference(sources[0], results[0]); });
  }

 private:
  /// Tables larger than this are made for each tile rather than for the image.
  static constexpr std::int64_t kTableValues = std::int64_t{4} << 20;

  Resize(const ResizeOptions& options, std::span<const ImageInfo> sources, const Size& size)
      : TileNode(sources),
        format_(row_format(sources[0], options.light)),
        across_(sources[0].width, static_cast<int>(size.width), options.filter),
        down_(sources[0].height, static_cast<int>(size.height), options.filter),
        nearest_(options.filter == ResizeFilter::Nearest) {
    ImageInfo result = sources[0];
    result.width = across_.result();
    result.height = down_.result();
    set_results({result});
    if (whole(across_)) columns_.emplace(across_, 0, across_.result(), across_.enlarging());
    if (whole(down_)) rows_.emplace(down_, 0, down_.result(), false);
  }

  static bool whole(const Axis& axis) { return std::int64_t{axis.taps()} * axis.result() <= kTableValues; }
  bool copies() const { return nearest_ || (across_.identity() && down_.identity()); }

  /// Calls f with tables that cover `rect`.
  template <class F>
  void with_tables(const Rect& rect, F f) const {
    std::optional<TapTable> columns;
    std::optional<TapTable> rows;
    if (!columns_) columns.emplace(across_, rect.x, rect.right(), across_.enlarging());
    if (!rows_) rows.emplace(down_, rect.y, rect.bottom(), false);
    f(columns_ ? *columns_ : *columns, rows_ ? *rows_ : *rows);
  }

  template <class F>
  void with_passes(const Rect& rect, F f) const {
    with_tables(rect, [&](const TapTable& columns, const TapTable& rows) {
      f(ResizePasses{format_, across_, down_, columns, rows});
    });
  }

  void copy(const ConstTile& source, const Tile& result) const {
    if (across_.identity() && down_.identity()) return copy_pixels(source.pixels, result.pixels);
    const auto copy_row = column_copier(result.pixels.info.pixel_bytes());
    with_tables(result.rect, [&](const TapTable& columns, const TapTable& rows) {
      const int* const first = rows.first_of(result.rect.y);
      for (int y = 0; y < result.rect.height; ++y) {
        if (y > 0 && first[y] == first[y - 1]) {
          std::memcpy(result.pixels.row(y), result.pixels.row(y - 1), result.pixels.info.row_bytes());
        } else {
          copy_row(columns, source.rect, source.pixels.row(first[y] - source.rect.y), result.rect,
                   result.pixels.row(y));
        }
      }
    });
  }

  RowFormat format_;
  Axis across_;
  Axis down_;
  bool nearest_;
  std::optional<TapTable> columns_;
  std::optional<TapTable> rows_;
};

}  // namespace

extern const Operation kResize = with_examples(
    image_operation<ResizeOptions, Resize>(
        "resize", "Changes the number of pixels that show the image.", {{"source", "the image"}},
        {{"result", "the image in the new size"}},
        {field("width", &ResizeOptions::width, {1, kLargestSide}, "px", "of the result; auto: keeps the aspect"),
         field("height", &ResizeOptions::height, {1, kLargestSide}, "px", "of the result; auto: keeps the aspect"),
         field("scale", &ResizeOptions::scale, {1e-4, 1e4}, "", "of both sides, instead of width and height"),
         field("filter", &ResizeOptions::filter, "how a result pixel is made of source pixels"),
         field("light", &ResizeOptions::light, "what is summed: linear light or stored values")}),
    {{"photo.png resize:width=96", "Smaller, without false patterns where there were fine ones."},
     {"photo.png resize:scale=0.1 resize:scale=10,filter=nearest",
      "What a tenth of the size keeps, in large pixels."}});

void resize(const ConstAnyView& source, const AnyView& result, const ResizeOptions& options, const Run& run) {
  apply_into(kResize, &options, {source}, {result}, run);
}

Image resize(const Image& source, const ResizeOptions& options, const Run& run) {
  return std::move(apply(kResize, &options, {&source}, run)[0]);
}

}  // namespace azulejo
