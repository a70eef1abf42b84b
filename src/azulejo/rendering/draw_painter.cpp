#include "azulejo/rendering/draw_painter.h"

#include <algorithm>

namespace azulejo {
namespace {

constexpr std::size_t kAhead = 4;

int blocks_of(int width) { return (width + kBlock - 1) / kBlock; }

}  // namespace

void DrawPlan::prepare() {
  const bool linear = options.light == DrawLight::Linear;
  items.resize(steps.steps.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    const DrawStep& step = steps.steps[i];
    DrawItem& item = items[i];
    item.kind = step.kind;
    if (step.kind != DrawStep::Shape) continue;
    const DrawOutline& outline = outlines.of(i);
    const std::span<const DrawPart> parts = outlines.parts(outline);
    item.rule = outline.rule;
    item.parts = parts.data();
    item.part_count = outline.part_count;
    if (parts.size() == 1 && parts[0].starts.empty()) {
      item.edges = parts[0].edges.data();
      item.edge_count = parts[0].edges.size();
    }
    if (step.in_clip) {
      item.color = glm::vec4(1);
      continue;
    }
    const DrawingStyle& style = drawing.styles[drawing.paths[step.path].style];
    const std::optional<Paint>& paint = paint_of(style, step.shape, options.polygon_mode);
    glm::vec4 tint = paint->color;
    tint.w *= step.opacity;
    item.color = premultiplied(tint, linear);
    if (!paint->pattern || parts.empty()) continue;
    auto pattern = std::make_unique<const DrawPaint>(drawing.patterns[*paint->pattern], tint, steps.places[step.place],
                                                     linear, options.antialias == Antialias::Area);
    if (pattern->plain()) {
      item.color = *pattern->plain();
      continue;
    }
    item.pattern = pattern.get();
    patterns.push_back(std::move(pattern));
  }
}

DrawPainter::DrawPainter(const DrawPlan& plan) : plan_(plan), coverage_(plan.frame.width, plan.bands.rows) {
  colors_.resize(static_cast<std::size_t>(blocks_of(plan.frame.width)) * kBlockFloats);
}

template <class Each>
void DrawPainter::for_rows(const Rect& region, Each&& each) {
  const int first = region.x / kBlock;
  const int last = blocks_of(region.right());
  for (int y = std::max(region.y - top_, 0); y < std::min(region.bottom() - top_, rows_); ++y) each(y, first, last);
}

void DrawPainter::begin(const Rect& region, const glm::vec4& color) {
  if (depth_ == layers_.size()) {
    layers_.push_back(std::make_unique<DrawLayer>(blocks_of(plan_.frame.width), plan_.bands.rows));
  }
  ++depth_;
  for_rows(region, [&](int y, int first, int last) {
    const LayerRow row = layer().row(y);
    std::fill(row.colors + first, row.colors + last, color);
    std::fill(row.plain + first, row.plain + last, std::uint8_t{1});
  });
}

void DrawPainter::end(const Rect& region, float opacity) {
  for_rows(region, [&](int y, int first, int last) {
    kernels::cover_with_layer(layer(1).row(y), layer().row(y), first, last, opacity);
  });
  --depth_;
}

void DrawPainter::keep(const Rect& region) {
  for_rows(region,
           [&](int y, int first, int last) { kernels::keep_inside(layer(1).row(y), layer().row(y), first, last); });
  --depth_;
}

void DrawPainter::add_edges(const DrawItem& item) {
  const Antialias antialias = plan_.options.antialias;
  if (item.edges != nullptr) {
    coverage_.add({item.edges, item.edge_count}, antialias);
    if (coverage_.wants_gathering()) coverage_.gather({item.edges, item.edge_count});
    return;
  }
  const auto for_parts = [&](auto&& all, auto&& chosen) {
    for (const DrawPart& part : std::span(item.parts, item.part_count)) {
      if (part.starts.empty()) {
        all(part.edges);
        continue;
      }
      const int band = band_ - part.first_band;
      if (band < 0 || band + 1 >= static_cast<int>(part.starts.size())) continue;
      const std::uint32_t* const start = part.starts.data() + band;
      chosen(part.edges, part.chosen.subspan(start[0], start[1] - start[0]));
    }
  };
  for_parts([&](auto edges) { coverage_.add(edges, antialias); },
            [&](auto edges, auto chosen) { coverage_.add(edges, chosen, antialias); });
  if (!coverage_.wants_gathering()) return;
  for_parts([&](auto edges) { coverage_.gather(edges); },
            [&](auto edges, auto chosen) { coverage_.gather(edges, chosen); });
}

void DrawPainter::cover(const DrawItem& item) {
  add_edges(item);
  const int blocks = blocks_of(plan_.frame.width);
  for (int y = coverage_.first_row(); y <= coverage_.last_row(); ++y) {
    const LayerRow row = layer().row(y);
    for (const CoverageRun& run : coverage_.row(y, item.rule)) {
      const RunCoverage covered{run.first, std::min(run.last, blocks), run.mixed ? coverage_.coverage() : nullptr,
                                run.value};
      if (covered.first >= covered.last) continue;
      if (item.pattern != nullptr) {
        item.pattern->colors(covered.first, covered.last, top_ + y, colors_.data());
        kernels::cover_with_colors(row, covered, colors_.data());
      } else {
        kernels::cover_with_color(row, covered, item.color);
      }
    }
  }
  coverage_.finish();
}

void DrawPainter::paint(int band, const ImageView<std::uint8_t>& rgba) {
  band_ = band;
  top_ = band * plan_.bands.rows;
  rows_ = std::min(plan_.bands.rows, plan_.frame.height - top_);
  coverage_.move_to(top_, rows_);
  const bool linear = plan_.options.light == DrawLight::Linear;
  const Color background = plan_.options.background.value_or(Color{0, 0, 0, 0});
  begin({0, top_, plan_.frame.width, rows_},
        premultiplied({background.r, background.g, background.b, background.a}, linear));
  const std::span<const std::uint32_t> steps = plan_.bands.steps_of(band);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    // Steps of a band are far apart in memory.
    if (i + 2 * kAhead < steps.size()) __builtin_prefetch(&plan_.items[steps[i + 2 * kAhead]]);
    if (i + kAhead < steps.size()) __builtin_prefetch(plan_.items[steps[i + kAhead]].edges);
    const std::uint32_t step = steps[i];
    const DrawItem& item = plan_.items[step];
    switch (item.kind) {
      case DrawStep::Shape: cover(item); break;
      case DrawStep::Begin: begin(plan_.bands.regions[step], glm::vec4(0)); break;
      case DrawStep::Keep: keep(plan_.bands.regions[step]); break;
      case DrawStep::End: end(plan_.bands.regions[step], plan_.steps.steps[step].opacity); break;
      case DrawStep::Nothing: break;
    }
  }
  for (int y = 0; y < rows_; ++y) {
    kernels::store_row(layer().row(y), plan_.frame.width, linear, rgba.row(top_ + y));
  }
  --depth_;
}

}  // namespace azulejo
