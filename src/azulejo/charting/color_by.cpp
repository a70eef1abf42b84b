#include "azulejo/charting/color_by.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "azulejo/charting/color_bar.h"
#include "azulejo/charting/mesh_scalar.h"
#include "azulejo/engine/operation.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;

Extent range_of(const Array<float>& values, const std::optional<glm::vec2>& asked) {
  if (asked) return {asked->x, asked->y};
  Extent extent;
  for (const float value : values) {
    if (std::isfinite(value)) extent.add(static_cast<double>(value));
  }
  return extent.empty() ? Extent{0, 1} : extent;
}

/// sRGB of each value.
Array<std::uint8_t> colors_of(const Array<float>& values, const Extent& range, const ColorByOptions& options,
                              const Run& run) {
  const PseudoColorOptions how{.map = options.map,
                               .low = static_cast<float>(range.low),
                               .high = static_cast<float>(range.high),
                               .levels = options.bands,
                               .nan_color = options.nan_color};
  Array<std::uint8_t> colors(values.size() * 3);
  Array<float> shades(std::min(kChunk, values.size()) * 3);
  for (std::size_t begin = 0; begin < values.size(); begin += kChunk) {
    const auto count = static_cast<int>(std::min(kChunk, values.size() - begin));
    const ImageView<const float> source{values.data() + begin, count, 1, 1, count};
    const ImageView<float> result{shades.data(), count, 1, 3, 3 * count};
    pseudo_color(source, result, how, run);
    for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(count); ++i) {
      colors[3 * begin + i] = static_cast<std::uint8_t>(std::clamp(shades[i], 0.0F, 1.0F) * 255 + 0.5F);
    }
  }
  return colors;
}

/// Of faces: of their corners.
Array<std::uint8_t> spread(const Mesh& mesh, const Array<std::uint8_t>& of_faces) {
  Array<std::uint8_t> of_corners(3 * mesh.corner_count());
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    for (std::size_t corner = mesh.face_begin(face); corner < mesh.face_end(face); ++corner) {
      std::copy_n(of_faces.data() + 3 * face, 3, of_corners.data() + 3 * corner);
    }
  }
  return of_corners;
}

Drawing bar_page(const ColorBar& bar, const ColorByOptions& options, const Run& run) {
  const PlotSizes sizes(options.font_size);
  Drawing page;
  page.height = static_cast<float>(options.bar_height);
  const float margin = std::min(0.25F * page.height, sizes.pad);
  page.width = std::ceil(color_bar_width(bar, page.height - 2 * margin, sizes) + sizes.pad);
  draw_color_bar(page, 0, bar, {{-0.5F * sizes.pad, margin}, {-0.5F * sizes.pad, page.height - margin}}, sizes,
                 {0.13F, 0.13F, 0.13F, 1}, run);
  return page;
}

std::vector<Value> run_color_by(std::span<const Value> inputs, const ColorByOptions& options, const Run& run) {
  ColoredMesh colored = color_by(*inputs[0].mesh(), options, run);
  std::vector<Value> results;
  results.emplace_back(std::move(colored.mesh));
  results.emplace_back(std::move(colored.bar));
  return results;
}

}  // namespace

extern const Operation kColorBy = with_examples(
    value_operation<ColorByOptions>(
        "color_by", "Colors a mesh by a coordinate or an attribute.", {{"source", "the mesh", ValueKind::Mesh}},
        {{"mesh", "with colors at its vertices or corners", ValueKind::Mesh},
         {"bar", "what the colors mean", ValueKind::Drawing}},
        {field("attribute", &ColorByOptions::attribute, "x, y or z of the positions, or an attribute's name"),
         field("component", &ColorByOptions::component, {0, 3}, "", "of an attribute; auto: the length of a vector"),
         field("map", &ColorByOptions::map, "colors from the lowest to the highest value"),
         field("range", &ColorByOptions::range, {-1e30, 1e30}, "", "values of the first and last color; auto: all"),
         field("bands", &ColorByOptions::bands, {2, 256}, "", "as many colors; auto: without bands"),
         field("nan_color", &ColorByOptions::nan_color, "of what is not a number"),
         field("label", &ColorByOptions::label, "beside the color bar; auto: what it shows"),
         field("bar_height", &ColorByOptions::bar_height, {16, 16384}, "px", "of the page with the color bar"),
         field("font_size", &ColorByOptions::font_size, {1, 1000}, "px", "of the color bar")},
        run_color_by),
    {{"primitive:kind=teapot color_by:attribute=y render:width=480,height=360,background=white",
      "The teapot by its height."},
     {"primitive:kind=torus color_by:attribute=x,map=turbo,bands=8 render:width=480,height=360,background=white",
      "Eight bands across a ring."}});

ColoredMesh color_by(const Mesh& mesh, const ColorByOptions& options, const Run& run) {
  kColorBy.check(&options);
  const MeshScalar scalar = mesh_scalar(mesh, options.attribute, options.component);
  const Extent range = range_of(scalar.values, options.range);
  Array<std::uint8_t> colors = colors_of(scalar.values, range, options, run);
  ColoredMesh result;
  result.mesh = mesh.clone();
  std::erase_if(result.mesh.attributes, [](const Attribute& each) { return each.name == "COLOR_0"; });
  const bool of_faces = scalar.domain == Domain::Face;
  result.mesh.attributes.push_back(
      {"COLOR_0", of_faces ? Domain::Corner : scalar.domain, 3, of_faces ? spread(mesh, colors) : std::move(colors)});
  const ColorBar bar{options.label.value_or(options.attribute), range.low, range.high, options.map,
                     options.bands.value_or(0)};
  result.bar = bar_page(bar, options, run);
  return result;
}

}  // namespace azulejo
