// What is written, and that it is read as the same drawing.

#include "azulejo/io/svg_write.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/io/svg_output.h"
#include "azulejo/io/svg_testing.h"

namespace azulejo {
namespace {

/// The first difference, or "".
std::string difference(const Drawing& a, const Drawing& b) {
  if (a.width != b.width || a.height != b.height || a.unit != b.unit) return "page";
  if (a.groups.size() != b.groups.size()) return "number of groups";
  if (a.paths.size() != b.paths.size()) return "number of paths";
  const auto paint = [&](const std::optional<Paint>& p, const std::optional<Paint>& q) {
    if (p.has_value() != q.has_value()) return false;
    if (!p) return true;
    if (p->pattern.has_value() != q->pattern.has_value() || p->color.w != q->color.w) return false;
    return p->pattern ? a.patterns[*p->pattern] == b.patterns[*q->pattern] : p->color == q->color;
  };
  const auto style = [&](const DrawingStyle& s, DrawingStyle t) {
    if (!paint(s.fill, t.fill) || !paint(s.stroke, t.stroke)) return false;
    t.fill = s.fill;
    t.stroke = s.stroke;
    return s == t;
  };
  // Both are walked side by side, clips too: their order in the lists may differ.
  std::vector<std::pair<DrawingItem, DrawingItem>> waiting{{{true, 0}, {true, 0}}};
  while (!waiting.empty()) {
    const auto [left, right] = waiting.back();
    waiting.pop_back();
    if (left.is_group != right.is_group) return "kind of an item";
    if (left.is_group) {
      const DrawingGroup& g = a.groups[left.index];
      const DrawingGroup& h = b.groups[right.index];
      if (g.parent_from_group != h.parent_from_group || g.opacity != h.opacity) return "group";
      if (g.id != h.id) return "id " + g.id + " and " + h.id;
      if (g.clip.has_value() != h.clip.has_value() || g.items.size() != h.items.size()) return "what is in a group";
      if (g.clip) waiting.push_back({{true, *g.clip}, {true, *h.clip}});
      for (std::size_t i = 0; i < g.items.size(); ++i) waiting.emplace_back(g.items[i], h.items[i]);
      continue;
    }
    const DrawingPath& p = a.paths[left.index];
    const DrawingPath& q = b.paths[right.index];
    if (p.id != q.id) return "id " + p.id + " and " + q.id;
    if (!style(a.styles[p.style], b.styles[q.style])) return "style of " + p.id;
    const PathView v = a.view(p);
    const PathView w = b.view(q);
    if (!std::equal(v.commands.begin(), v.commands.end(), w.commands.begin(), w.commands.end())) return "commands";
    if (!std::equal(v.points.begin(), v.points.end(), w.points.begin(), w.points.end())) return "points";
  }
  return "";
}

/// A drawing of everything that SVG says as it is.
class RandomDrawing {
 public:
  explicit RandomDrawing(unsigned seed) : random_(seed) {}

  Drawing make() {
    drawing_.width = static_cast<float>(1 + random_() % 1000) / 4;
    drawing_.height = static_cast<float>(1 + random_() % 1000) / 3;
    drawing_.unit = random_() % 2 == 0 ? DrawingUnit::Pixel : DrawingUnit::Millimetre;
    std::vector<std::uint32_t> groups{0};
    for (int i = 0; i < 12; ++i) {
      const std::uint32_t parent = groups[random_() % groups.size()];
      const std::uint32_t group = drawing_.add_group(matrix(), random_() % 3 == 0 ? share() : 1, parent);
      drawing_.groups[group].id = "group" + std::to_string(group);
      if (random_() % 3 == 0) drawing_.groups[group].clip = clip();
      groups.push_back(group);
    }
    for (int i = 0; i < 40; ++i) add_path(groups[random_() % groups.size()]);
    return std::move(drawing_);
  }

 private:
  float share() { return static_cast<float>(random_() % 998 + 1) / 1000; }
  float number() { return static_cast<float>(static_cast<int>(random_() % 20001) - 10000) / 70; }
  glm::mat3x2 matrix() {
    switch (random_() % 4) {
      case 0: return {1, 0, 0, 1, 0, 0};
      case 1: return {1, 0, 0, 1, number(), number()};
      case 2: return {number(), 0, 0, number(), 0, 0};
      default: return {number(), number(), number(), number(), number(), number()};
    }
  }
  glm::vec4 color() {
    const auto channel = [&] { return static_cast<float>(random_() % 256) / 255; };
    return {channel(), channel(), channel(), 1};
  }

  Path path() {
    Path path;
    path.move_to({number(), number()});
    for (auto i = random_() % 6; i > 0; --i) {
      path.cubic_to({number(), number()}, {number(), number()}, {number(), number()}).line_to({number(), number()});
    }
    return path.close();
  }

  Paint paint() {
    if (random_() % 3 != 0) {
      glm::vec4 plain = color();
      if (random_() % 3 == 0) plain.w = share();
      return plain;
    }
    Gradient gradient;
    gradient.radial = random_() % 2 == 0;
    gradient.from = {number(), number()};
    gradient.to = {number(), number()};
    if (gradient.radial) {
      gradient.from_radius = random_() % 2 == 0 ? 0 : share();
      gradient.to_radius = 1 + share();
    }
    gradient.spread = static_cast<GradientSpread>(random_() % 3);
    gradient.path_from_gradient = matrix();
    gradient.stops = {{0, color()}, {share(), color()}, {1, color()}};
    gradient.stops[1].color.w = share();
    return {{0, 0, 0, share()}, drawing_.add_pattern(gradient)};
  }

  DrawingStyle style() {
    DrawingStyle style;
    style.fill = random_() % 4 == 0 ? std::nullopt : std::optional(paint());
    if (style.fill) style.fill_rule = static_cast<FillRule>(random_() % 2);
    if (random_() % 2 == 0) {
      style.stroke = paint();
      style.stroke_width = share() * 9;
      style.cap = static_cast<LineCap>(random_() % 3);
      style.join = static_cast<LineJoin>(random_() % 3);
      style.miter_limit = 1 + share();
      if (random_() % 2 == 0) {
        style.dash = {share(), share(), 0, share()};
        style.dash_offset = number();
      }
      style.fixed_stroke = random_() % 2 == 0;
    }
    if (style.fill.has_value() != style.stroke.has_value()) style.opacity = share();
    return style;
  }

  std::uint32_t clip() {
    const std::uint32_t clip = drawing_.add_clip();
    drawing_.groups[clip].id = "clip" + std::to_string(clip);
    drawing_.groups[clip].parent_from_group = matrix();
    if (random_() % 3 == 0) drawing_.groups[clip].clip = this->clip();
    DrawingStyle plain;
    plain.fill_rule = static_cast<FillRule>(random_() % 2);
    for (auto i = random_() % 3; i > 0; --i) {
      std::uint32_t group = clip;
      if (random_() % 2 == 0) {
        group = drawing_.add_group({2, 0, 0, 1, number(), 1}, 1, clip);
        if (random_() % 2 == 0) drawing_.groups[group].clip = this->clip();
      }
      drawing_.add_path(path(), drawing_.add_style(plain), {}, group);
    }
    return clip;
  }

  void add_path(std::uint32_t group) {
    const std::string id = "path" + std::to_string(drawing_.paths.size());
    const DrawingStyle chosen = style();
    // A group for a single path, as a transformed shape has.
    if (random_() % 4 == 0) group = drawing_.add_group({3, 0, 0, 2, number(), 1}, 1, group);
    if (random_() % 4 == 0 && chosen.fill && chosen.stroke) {
      group = drawing_.add_group({1, 0, 0, 1, 0, 0}, share(), group);
    }
    drawing_.add_path(path(), drawing_.add_style(chosen), id, group);
  }

  std::mt19937 random_;
  Drawing drawing_;
};

TEST(SvgWrite, IsReadAsTheSameDrawing) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Drawing drawing = RandomDrawing(seed).make();
    const std::string text = svg_text(drawing);
    const SvgRead again = svg_file(text);
    ASSERT_EQ(difference(drawing, again.drawing), "") << "seed " << seed << "\n" << text;
    ASSERT_TRUE(again.warnings.empty()) << again.warnings.front();
    // Patterns are in the order in which they are painted with now.
    const std::string second = svg_text(again.drawing);
    ASSERT_TRUE(svg_text(svg_file(second).drawing) == second) << "seed " << seed;
  }
}

TEST(SvgWrite, SameBytesForAnyThreadCount) {
  Drawing drawing;
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 1, 1});
  for (int i = 0; i < 20'000; ++i) {
    DrawingStyle style;
    style.stroke_width = 1 + static_cast<float>(i % 3);
    style.stroke = Paint();
    drawing.add_path(Path().move_to({static_cast<float>(i), 1}).line_to({2, 3}), drawing.add_style(style), "same",
                     group);
  }
  EXPECT_EQ(svg_text(drawing, {}, 1), svg_text(drawing, {}, 4));
}

Drawing square(const DrawingStyle& style, float size = 10) {
  Drawing drawing;
  drawing.width = drawing.height = size;
  Path path;
  path.move_to({0, 0}).line_to({size, 0}).line_to({size, size}).close();
  drawing.add_path(path, drawing.add_style(style));
  return drawing;
}

TEST(SvgWrite, Small) {
  EXPECT_EQ(
      svg_text(square({})),
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"10\" height=\"10\" viewBox=\"0 0 10 10\">\n"
      " <path d=\"M0 0H10V10Z\"/>\n</svg>\n");
}

TEST(SvgWrite, MillimetresAreTheUnit) {
  Drawing drawing = square({});
  drawing.unit = DrawingUnit::Millimetre;
  const std::string text = svg_text(drawing);
  EXPECT_NE(text.find("width=\"10mm\" height=\"10mm\" viewBox=\"0 0 10 10\""), std::string::npos) << text;
}

TEST(SvgWrite, AnOpacityOverTwoPaintsGoesIntoBoth) {
  DrawingStyle style;
  style.fill = Paint(glm::vec4(1, 0, 0, 0.5F));
  style.stroke = Paint(glm::vec4(0, 0, 1, 1));
  style.opacity = 0.5F;
  const DrawingStyle again = style_of(svg_file(svg_text(square(style))).drawing);
  EXPECT_EQ(again.opacity, 1);
  EXPECT_EQ(again.fill->color.w, 0.25F);
  EXPECT_EQ(again.stroke->color.w, 0.5F);
}

TEST(SvgWrite, ClassesForWhatManyShare) {
  Drawing drawing;
  DrawingStyle style;
  style.fill.reset();
  style.stroke = Paint(glm::vec4(1, 0, 0, 1));
  style.stroke_width = 3;
  const std::uint32_t index = drawing.add_style(style);
  for (int i = 0; i < 9; ++i) drawing.add_path(Path().move_to({0, 0}).line_to({1, 1}), index);
  const std::string text = svg_text(drawing);
  EXPECT_NE(text.find(".a{fill:none;stroke:#f00;stroke-width:3}"), std::string::npos) << text;
  EXPECT_EQ(style_of(svg_file(text).drawing, 8), style);
}

TEST(SvgWrite, IdsAreValidAndUnique) {
  Drawing drawing;
  const std::uint32_t style = drawing.add_style({});
  for (const char* id : {"a", "a", "a-1", "a", "1 2", "", "\xC3\xA9t\xC3\xA9", "\xFF<", "x:y"}) {
    drawing.add_path(Path().move_to({0, 0}).line_to({1, 1}), style, id);
  }
  const SvgRead again = svg_file(svg_text(drawing));
  std::vector<std::string> ids;
  for (const DrawingPath& path : again.drawing.paths) ids.push_back(path.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"a", "a-2", "a-1", "a-3", "_1_2", "", "\xC3\xA9t\xC3\xA9", "_", "x_y"}));
}

TEST(SvgWrite, HatchesAndStipplesArePatterns) {
  Drawing drawing = square({});
  DrawingStyle style;
  style.fill = Paint(glm::vec4(1, 0, 0, 0.5F),
                     drawing.add_pattern(Hatch{.angle = 0.5F, .spacing = 4, .width = 2, .crossed = true}));
  Stipple stipple;
  stipple.rows[1] = 0xF0000001;
  style.stroke = Paint(glm::vec4(0, 0, 1, 1), drawing.add_pattern(stipple));
  drawing.styles[0] = style;
  const std::string text = svg_text(drawing);
  EXPECT_NE(text.find("<pattern id=\"hatch\" width=\"4\" height=\"4\" patternUnits=\"userSpaceOnUse\" "
                      "patternTransform=\"rotate(-28.64789)\"><path d=\"M0 0H4M0 4H4M0 0V4M4 0V4\" stroke=\"#f00\" "
                      "stroke-width=\"2\"/></pattern>"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("<path d=\"M0 1H4v1H0zM31 1H32v1H31z\" fill=\"#00f\"/>"), std::string::npos) << text;
  EXPECT_NE(text.find("fill=\"url(#hatch)\" fill-opacity=\".5\" stroke=\"url(#stipple)\""), std::string::npos) << text;
}

TEST(SvgWrite, PointsAreShapesOfPixels) {
  DrawingStyle style;
  style.points = Paint(glm::vec4(1, 0, 0, 1));
  style.point_size = 2;
  style.point_shape = PointShape::Square;
  Drawing drawing;
  const std::uint32_t group = drawing.add_group({4, 0, 0, 2, 0, 0});
  drawing.add_path(Path().move_to({1, 1}).quadratic_to({50, 50}, {3, 1}).close(), drawing.add_style(style), {}, group);
  const std::string text = svg_text(drawing);
  // A pixel is a quarter of a unit along x, and a half along y; control points have no mark.
  EXPECT_NE(text.find("d=\"M.75 .5H1.25V1.5H.75ZM2.75 .5H3.25V1.5H2.75Z\""), std::string::npos) << text;
  for (int shape = 0; shape < 6; ++shape) {
    std::string marks;
    const Path point = Path().move_to({5, 5});
    put_marks(marks, {point.commands, point.points}, static_cast<PointShape>(shape), 2, {1, 0, 0, 1, 0, 0});
    const Drawing read = svg_elements("<path d='" + marks + "'/>").drawing;
    EXPECT_NEAR(bounds(read).lower.y, 4, 1e-4) << shape;
    EXPECT_NEAR(bounds(read).upper.y, 6, 1e-4) << shape;
  }
}

TEST(SvgWrite, TextsAreOutlinesOrText) {
  Drawing drawing = square({});
  drawing.texts.push_back(
      {.text = "a  < \"b\"\x01", .family = "DejaVu Sans", .bold = true, .size = 12, .origin = {1, 2}});
  drawing.paths[0].text = 0;
  const std::string outlines = svg_text(drawing);
  EXPECT_NE(outlines.find("<path aria-label=\"a  &lt; &quot;b&quot; \" d=\"M0 0H10V10Z\"/>"), std::string::npos)
      << outlines;
  ModelWriteOptions options;
  options.svg_text = true;
  const std::string text = svg_text(drawing, options);
  EXPECT_NE(text.find("<text x=\"1\" y=\"2\" font-family=\"DejaVu Sans\" font-size=\"12\" font-weight=\"bold\" "
                      "xml:space=\"preserve\">a  &lt; &quot;b&quot; </text>"),
            std::string::npos)
      << text;
}

TEST(SvgWrite, GroupsBelowAClipGoIntoItsPaths) {
  Drawing drawing = square({});
  const std::uint32_t inner = drawing.add_clip();
  drawing.add_path(Path().move_to({0, 0}).line_to({5, 0}).line_to({5, 5}), 0, {}, inner);
  const std::uint32_t clip = drawing.add_clip();
  const std::uint32_t outer = drawing.add_group({2, 0, 0, 2, 0, 0}, 1, clip);
  drawing.groups[outer].clip = inner;
  const std::uint32_t last = drawing.add_group({1, 0, 0, 1, 3, 0}, 1, outer);
  drawing.add_path(Path().move_to({0, 0}).line_to({1, 0}).line_to({1, 1}), 0, {}, last);
  drawing.groups[0].clip = clip;
  const std::string text = svg_text(drawing);
  EXPECT_NE(text.find("<path d=\"M3 0H4V1\" transform=\"scale(2)\" clip-path=\"url(#clip)\"/>"), std::string::npos)
      << text;
  drawing.groups[last].clip = inner;
  EXPECT_THROW(svg_text(drawing), Error);
}

TEST(SvgWrite, DeepGroups) {
  Drawing drawing;
  std::uint32_t group = 0;
  for (int i = 0; i < 100'000; ++i) group = drawing.add_group({1, 0, 0, 1, 0, 0}, 1, group);
  drawing.add_path(Path().move_to({0, 0}).line_to({1, 1}), drawing.add_style({}), {}, group);
  EXPECT_LT(svg_text(drawing).size(), 5'000'000U);
}

TEST(SvgWrite, ThroughTheFormat) {
  const std::vector<std::byte> bytes = encode_model(square({}), "svg");
  const Model model = read_model(bytes, "x", {}, {});
  EXPECT_EQ(std::get<Drawing>(model).paths.size(), 1U);
}

}  // namespace
}  // namespace azulejo
