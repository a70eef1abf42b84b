#include "azulejo/rendering/picture_onto.h"

#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {
namespace {

const char* name_of(ColorState state) {
  switch (state) {
    case ColorState::Srgb: return "srgb";
    case ColorState::Linear: return "linear";
    default: return "data";
  }
}

/// How rows of an image are read: colors times alpha.
struct Layout {
  explicit Layout(const ImageInfo& info)
      : format(row_format(info, Light::Encoded)),
        colors(info.color_channels()),
        full(full_range(info.type)),
        unit(format.alpha == RowAlpha::Plain ? full : full * full) {}
  bool has_alpha() const { return format.channels > colors; }

  RowFormat format;
  int colors;
  float full;  ///< of alpha
  float unit;  ///< of colors where alpha is 1
};

/// Lays `count` pixels of the picture over those under them, into a row of the result.
void over(const Layout& under, const float* below, const Layout& picture, const float* above, const Layout& result,
          int count, float* row) {
  const float keep_scale = result.unit / under.unit;
  const float scale = result.unit / picture.unit;
  for (int x = 0; x < count; ++x) {
    const float alpha = !picture.has_alpha() ? 1.0F : above[picture.colors] / picture.full;
    const float through = 1.0F - alpha;
    for (int c = 0; c < 3; ++c) {
      const float kept = below[under.colors == 1 ? 0 : c] * keep_scale;
      row[c] = alpha == 0 ? kept : through == 0 ? above[c] * scale : above[c] * scale + through * kept;
    }
    if (result.has_alpha())
      row[3] = alpha == 0 ? below[under.colors] : result.full * alpha + through * below[under.colors];
    below += under.format.channels;
    above += picture.format.channels;
    row += result.format.channels;
  }
}

/// A row as it was, gray as three equal channels.
void widen(const Layout& under, const float* below, const Layout& result, int count, float* row) {
  for (int x = 0; x < count; ++x, below += under.format.channels, row += result.format.channels) {
    for (int c = 0; c < 3; ++c) row[c] = below[under.colors == 1 ? 0 : c];
    if (result.has_alpha()) row[3] = below[under.colors];
  }
}

}  // namespace

void check_onto(const Image& under, ColorState picture) {
  if (under.info().color == picture) return;
  throw Error(Error::Argument, fmt::format("onto: an image whose colors are {}, expected {} as the picture's",
                                           name_of(under.info().color), name_of(picture)));
}

Image picture_onto(const Image& under, const Image& picture, const Rect& area, const Run& run) {
  check_onto(under, picture.info().color);
  if (under.width() != picture.width() || under.height() != picture.height()) {
    throw Error(Error::Argument, fmt::format("onto: an image of {}×{} pixels, expected {}×{}", under.width(),
                                             under.height(), picture.width(), picture.height()));
  }
  ImageInfo info = under.info();
  info.channels = info.alpha == AlphaState::None ? 3 : 4;
  Image image(info, run.limits);
  image.set_metadata(under.metadata());
  const Layout from(under.info());
  const Layout drawn(picture.info());
  const Layout to(info);
  const Rect part = intersection(area, info.rect());
  constexpr std::size_t kRows = 16;
  parallel_for(static_cast<std::size_t>(info.height), kRows, run, [&](std::size_t begin, std::size_t end) {
    std::vector<float> below(from.format.values(info.width));
    std::vector<float> above(drawn.format.values(part.width));
    std::vector<float> row(to.format.values(info.width));
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      std::byte* const result = image.any().row(y);
      const std::byte* const source = under.any().row(y);
      const bool covered = !part.empty() && y >= part.y && y < part.bottom();
      if (info == under.info()) {
        std::memcpy(result, source, info.row_bytes());
        if (!covered) continue;
      }
      load_row(from.format, source, info.width, below.data());
      widen(from, below.data(), to, info.width, row.data());
      if (covered) {
        load_row(drawn.format, picture.any().row(y) + static_cast<std::size_t>(part.x) * picture.info().pixel_bytes(),
                 part.width, above.data());
        over(from, below.data() + from.format.values(part.x), drawn, above.data(), to, part.width,
             row.data() + to.format.values(part.x));
      }
      const int first = info == under.info() ? part.x : 0;
      const int count = info == under.info() ? part.width : info.width;
      store_row(to.format, row.data() + to.format.values(first), count,
                result + static_cast<std::size_t>(first) * info.pixel_bytes());
    }
  });
  return image;
}

}  // namespace azulejo
