#include "azulejo/rendering/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

using Rgba = std::array<int, 4>;

Rgba at(const Image& image, int x, int y) {
  const ImageView<const std::uint8_t> view = image.view<std::uint8_t>();
  return {view(x, y, 0), view(x, y, 1), view(x, y, 2), view(x, y, 3)};
}

bool same(const Image& a, const Image& b) {
  if (a.info() != b.info()) return false;
  for (int y = 0; y < a.height(); ++y) {
    const std::uint8_t* const row = a.view<std::uint8_t>().row(y);
    if (!std::equal(row, row + a.info().row_bytes(), b.view<std::uint8_t>().row(y))) return false;
  }
  return true;
}

Drawing page(float width, float height) {
  Drawing drawing;
  drawing.width = width;
  drawing.height = height;
  return drawing;
}

Path rectangle(float x0, float y0, float x1, float y1) {
  Path path;
  path.move_to({x0, y0}).line_to({x1, y0}).line_to({x1, y1}).line_to({x0, y1}).close();
  return path;
}

DrawingStyle filled(const glm::vec4& color) {
  DrawingStyle style;
  style.fill = Paint(color);
  return style;
}

std::uint32_t add(Drawing& drawing, const Path& path, const Paint& paint, std::uint32_t group = 0) {
  DrawingStyle style;
  style.fill = paint;
  return drawing.add_path(path, drawing.add_style(style), {}, group);
}

constexpr glm::vec4 kRed{1, 0, 0, 1};
constexpr glm::vec4 kBlue{0, 0, 1, 1};

TEST(Draw, GivesAPixelThePartThatIsCovered) {
  Drawing drawing = page(4, 3);
  add(drawing, rectangle(1, 0.5F, 2.25F, 2), kRed);
  const Image image = draw(drawing);
  EXPECT_EQ(at(image, 0, 0), (Rgba{0, 0, 0, 0}));
  EXPECT_EQ(at(image, 1, 0), (Rgba{255, 0, 0, 128}));
  EXPECT_EQ(at(image, 1, 1), (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(at(image, 2, 0), (Rgba{255, 0, 0, 32}));  // 255 / 8
  EXPECT_EQ(at(image, 2, 1), (Rgba{255, 0, 0, 64}));
  EXPECT_EQ(at(image, 1, 2), (Rgba{0, 0, 0, 0}));
}

TEST(Draw, PutsColorsOverEachOther) {
  Drawing drawing = page(1, 1);
  add(drawing, rectangle(0, 0, 1, 1), kRed);
  add(drawing, rectangle(0, 0, 1, 1), glm::vec4(0, 0, 1, 0.25F));
  EXPECT_EQ(at(draw(drawing), 0, 0), (Rgba{191, 0, 64, 255}));
  // Linear: 0.75 and 0.25 of light, encoded: 0.8808 and 0.5371 (IEC 61966-2-1).
  EXPECT_EQ(at(draw(drawing, {.light = DrawLight::Linear}), 0, 0), (Rgba{225, 0, 137, 255}));
}

TEST(Draw, PaintsAGroupBeforeItFades) {
  Drawing drawing = page(2, 1);
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 0, 0}, 0.5F);
  add(drawing, rectangle(0, 0, 2, 1), kRed, group);
  add(drawing, rectangle(0, 0, 1, 1), kBlue, group);
  const Image image = draw(drawing, {.background = Color{1, 1, 1, 1}});
  EXPECT_EQ(at(image, 0, 0), (Rgba{128, 128, 255, 255}));
  EXPECT_EQ(at(image, 1, 0), (Rgba{255, 128, 128, 255}));
}

TEST(Draw, FadesAGroupOfOneThingAsThatThing) {
  Drawing one = page(3, 3);
  const std::uint32_t group = one.add_group({1, 0, 0, 1, 0, 0}, 0.5F);
  add(one, rectangle(0.3F, 0.2F, 2.7F, 2.9F), kRed, group);
  Drawing plain = page(3, 3);
  add(plain, rectangle(0.3F, 0.2F, 2.7F, 2.9F), glm::vec4(1, 0, 0, 0.5F));
  EXPECT_TRUE(same(draw(one), draw(plain)));
}

TEST(Draw, ClipsToTheUnionOfPaths) {
  Drawing drawing = page(4, 1);
  const std::uint32_t clip = drawing.add_clip();
  add(drawing, rectangle(0, 0, 1, 1), kRed, clip);
  add(drawing, rectangle(2, 0, 2.5F, 1), kRed, clip);
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 0, 0});
  drawing.groups[group].clip = clip;
  add(drawing, rectangle(0, 0, 4, 1), kBlue, group);
  const Image image = draw(drawing);
  EXPECT_EQ(at(image, 0, 0), (Rgba{0, 0, 255, 255}));
  EXPECT_EQ(at(image, 1, 0), (Rgba{0, 0, 0, 0}));
  EXPECT_EQ(at(image, 2, 0), (Rgba{0, 0, 255, 128}));
  EXPECT_EQ(at(image, 3, 0), (Rgba{0, 0, 0, 0}));
}

TEST(Draw, ClipsClips) {
  Drawing drawing = page(3, 1);
  const std::uint32_t inner = drawing.add_clip();
  add(drawing, rectangle(0, 0, 2, 1), kRed, inner);
  const std::uint32_t outer = drawing.add_clip();
  add(drawing, rectangle(1, 0, 3, 1), kRed, outer);
  drawing.groups[outer].clip = inner;
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 0, 0});
  drawing.groups[group].clip = outer;
  add(drawing, rectangle(0, 0, 3, 1), kBlue, group);
  const Image image = draw(drawing);
  EXPECT_EQ(at(image, 0, 0)[3], 0);
  EXPECT_EQ(at(image, 1, 0)[3], 255);
  EXPECT_EQ(at(image, 2, 0)[3], 0);
  // A clip without paths leaves nothing.
  drawing.groups[inner].items.clear();
  EXPECT_EQ(at(draw(drawing), 1, 0)[3], 0);
}

TEST(Draw, MixesStoredColorsOfALinearGradient) {
  for (const GradientSpread spread : {GradientSpread::Pad, GradientSpread::Reflect, GradientSpread::Repeat}) {
    Drawing drawing = page(40, 1);
    Gradient gradient;
    gradient.from = {10, 0};
    gradient.to = {20, 0};
    gradient.spread = spread;
    gradient.stops = {{0, {0, 0, 0, 1}}, {0.5F, {1, 0, 0, 1}}, {0.5F, {0, 1, 0, 1}}, {1, {0, 1, 1, 1}}};
    add(drawing, rectangle(0, 0, 40, 1), Paint({0, 0, 0, 1}, drawing.add_pattern(gradient)));
    const Image image = draw(drawing);
    for (int x = 0; x < 40; ++x) {
      double t = (x + 0.5 - 10) / 10;
      if (spread == GradientSpread::Pad) t = std::clamp(t, 0.0, 1.0);
      if (spread == GradientSpread::Repeat) t -= std::floor(t);
      if (spread == GradientSpread::Reflect) t = std::abs(t - 2 * std::floor(t / 2 + 0.5));
      const double red = t < 0.5 ? 2 * t : 0;
      const double blue = t < 0.5 ? 0 : 2 * t - 1;
      EXPECT_NEAR(at(image, x, 0)[0], 255 * red, 0.6) << x;
      EXPECT_NEAR(at(image, x, 0)[1], t < 0.5 ? 0 : 255, 0.6) << x;
      EXPECT_NEAR(at(image, x, 0)[2], 255 * blue, 0.6) << x;
    }
  }
}

// The circle of offset t has its center at from + t (to − from) and the radius of t between the two: a pixel's offset
// must give the circle that it is on.
TEST(Draw, RadialGradientsHaveTheirCirclesWhereTheyAre) {
  Drawing drawing = page(64, 64);
  Gradient gradient;
  gradient.radial = true;
  gradient.from = {25, 30};
  gradient.to = {32, 32};
  gradient.from_radius = 2;
  gradient.to_radius = 30;
  gradient.stops = {{0, {0, 0, 0, 1}}, {1, {1, 1, 1, 1}}};
  add(drawing, rectangle(0, 0, 64, 64), Paint({0, 0, 0, 1}, drawing.add_pattern(gradient)));
  const Image image = draw(drawing);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double t = at(image, x, y)[0] / 255.0;
      if (t == 0 || t == 1) continue;
      const double dx = x + 0.5 - (25 + 7 * t);
      const double dy = y + 0.5 - (30 + 2 * t);
      // A step of 1/255 is a ninth of a pixel of radius, and less than 0.15 with the moving center.
      ASSERT_NEAR(std::sqrt(dx * dx + dy * dy), 2 + 28 * t, 0.1) << x << " " << y;
    }
  }
  EXPECT_EQ(at(image, 0, 0)[0], 255);
  EXPECT_EQ(at(image, 25, 30)[0], 0);
}

TEST(Draw, HatchesCoverTheirShare) {
  for (const float angle : {0.0F, 0.3F, 0.7853982F, 1.5707964F, 2.5F}) {
    Drawing drawing = page(200, 200);
    add(drawing, rectangle(0, 0, 200, 200), Paint({0, 0, 0, 1}, drawing.add_pattern(Hatch{angle, 7, 2, false})));
    const Image image = draw(drawing);
    double sum = 0;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 200; ++x) sum += at(image, x, y)[3] / 255.0;
    }
    // 28 periods and a part of one at each side.
    EXPECT_NEAR(sum / 40000, 2.0 / 7, 0.01) << angle;
  }
  // Level lines through the origin, 2 wide: half a line above, the other half below it.
  Drawing drawing = page(8, 8);
  add(drawing, rectangle(0, 0, 8, 8), Paint({0, 0, 0, 1}, drawing.add_pattern(Hatch{0, 4, 2, false})));
  const Image image = draw(drawing);
  for (int y = 0; y < 8; ++y) EXPECT_EQ(at(image, 3, y)[3], y % 4 == 0 || y % 4 == 3 ? 255 : 0) << y;
}

TEST(Draw, StipplesRepeatFromTheCorner) {
  Drawing drawing = page(70, 40);
  Stipple stipple;
  stipple.rows[1] = 0x80000001U;
  add(drawing, rectangle(0, 0, 70, 40), Paint(kRed, drawing.add_pattern(stipple)));
  const Image image = draw(drawing);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 70; ++x) {
      ASSERT_EQ(at(image, x, y)[3], y % 32 == 1 && (x % 32 == 0 || x % 32 == 31) ? 255 : 0) << x << " " << y;
    }
  }
}

Drawing random_drawing(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-20, 140);
  std::uniform_real_distribution<float> share(0, 1);
  Drawing drawing = page(120, 90);
  Gradient gradient;
  gradient.to = {100, 50};
  gradient.spread = GradientSpread::Reflect;
  gradient.stops = {{0, {1, 0, 0, 0.5F}}, {1, {0, 0, 1, 1}}};
  const std::uint32_t pattern = drawing.add_pattern(gradient);
  std::uint32_t group = 0;
  for (int i = 0; i < 40; ++i) {
    if (i % 5 == 0) {
      const std::uint32_t clip = drawing.add_clip();
      Path inside = rectangle(place(random), place(random), place(random), place(random));
      drawing.add_path(inside, drawing.add_style(DrawingStyle()), {}, clip);
      group = drawing.add_group({1, 0.1F, -0.1F, 1, 3, 4}, share(random), i % 10 == 0 ? 0 : group);
      if (i % 3 == 0) drawing.groups[group].clip = clip;
    }
    Path path;
    path.move_to({place(random), place(random)}).line_to({place(random), place(random)});
    path.cubic_to({place(random), place(random)}, {place(random), place(random)}, {place(random), place(random)});
    DrawingStyle style = filled({share(random), share(random), share(random), share(random)});
    if (i % 4 == 0) style.fill->pattern = pattern;
    if (i % 3 == 0) {
      style.stroke = Paint({0, 0, 0, 1});
      style.stroke_width = 4 * share(random);
    }
    if (i % 7 == 0) style.points = Paint(kRed);
    style.fill_rule = i % 2 == 0 ? FillRule::NonZero : FillRule::EvenOdd;
    drawing.add_path(path, drawing.add_style(style), {}, group);
  }
  return drawing;
}

TEST(Draw, DoesNotDependOnThreads) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Drawing drawing = random_drawing(seed);
    drawing.check("random");
    for (const Antialias antialias : {Antialias::None, Antialias::Area}) {
      const DrawOptions options{.antialias = antialias};
      ASSERT_TRUE(same(draw(drawing, options, {.threads = 1}), draw(drawing, options, {.threads = 3}))) << seed;
    }
  }
}

// The page's place in the picture doesn't change it: what is left of or above a window counts as well.
TEST(Draw, OfAPartIsThatPartOfTheWhole) {
  Drawing drawing = random_drawing(3);
  const Image whole = draw(drawing);
  drawing.groups[0].parent_from_group = {1, 0, 0, 1, -32, -11};
  const Image part = draw(drawing);
  int different = 0;
  for (int y = 0; y < 79; ++y) {
    for (int x = 0; x < 88; ++x) {
      const Rgba a = at(whole, x + 32, y + 11);
      const Rgba b = at(part, x, y);
      // Floats of other places are rounded differently.
      for (std::size_t c = 0; c < 4; ++c) different += std::abs(a[c] * a[3] - b[c] * b[3]) > 3 * 255 ? 1 : 0;
    }
  }
  EXPECT_LT(different, 4);
}

TEST(Draw, FollowsSizesAndUnits) {
  Drawing drawing = page(25.4F, 50.8F);
  const auto size = [&](const DrawOptions& options) {
    const DrawFrame frame = draw_frame(drawing, options);
    return std::pair(frame.width, frame.height);
  };
  EXPECT_EQ(size({}), std::pair(26, 51));
  drawing.unit = DrawingUnit::Millimetre;
  EXPECT_EQ(size({}), std::pair(96, 192));
  EXPECT_EQ(size({.scale = 2, .dpi = 100}), std::pair(200, 400));
  EXPECT_EQ(size({.width = 10}), std::pair(10, 20));
  EXPECT_EQ(size({.height = 10}), std::pair(5, 10));
  EXPECT_EQ(size({.width = 7, .height = 10}), std::pair(7, 10));
  EXPECT_THROW(size({.scale = 1e6F}), Error);
  drawing.width = 0;
  EXPECT_THROW(size({}), Error);
  EXPECT_EQ(size({.width = 7, .height = 10}), std::pair(7, 10));
}

/// A window of the page in a viewport: those pixels of the whole, moved; around them the background.
TEST(Draw, AWindowIsSeenInTheViewport) {
  Drawing drawing = random_drawing(3);
  const Image whole = draw(drawing, {.background = Color{1, 1, 1, 1}});
  DrawOptions options{.width = 90, .height = 70, .background = Color{1, 1, 1, 1}};
  options.window = std::array<float, 4>{20, 10, 60, 40};
  options.viewport = std::array<float, 4>{30, 20, 40, 30};
  const Image part = draw(drawing, options);
  ASSERT_EQ(part.width(), 90);
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      const bool inside = x >= 30 && x < 70 && y >= 20 && y < 50;
      const Rgba expected = inside ? at(whole, x - 10, y - 10) : Rgba{255, 255, 255, 255};
      const Rgba got = at(part, x, y);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(got[c], expected[c], inside ? 4 : 0) << x << "," << y;
    }
  }
  // On another picture: the same there, and as it was elsewhere.
  Image under(90, 70, 3);
  for (int y = 0; y < 70; ++y) std::fill_n(under.view<std::uint8_t>().row(y), 270, std::uint8_t{99});
  const Image both = draw_onto(under, drawing, options);
  EXPECT_EQ(both.info().channels, 3);
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      const bool inside = x >= 30 && x < 70 && y >= 20 && y < 50;
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(both.view<std::uint8_t>()(x, y, c), inside ? part.view<std::uint8_t>()(x, y, c) : 99);
      }
    }
  }
}

TEST(Draw, WindowsOfAnotherShape) {
  Drawing drawing = page(40, 20);
  DrawOptions options{.width = 100, .height = 100};
  EXPECT_EQ(draw_frame(drawing, options).viewport, (Rect{0, 25, 100, 50}));
  options.aspect = AspectPolicy::Fill;
  EXPECT_EQ(draw_frame(drawing, options).picture_from_page, glm::mat3x2(5, 0, 0, 5, -50, 0));
  options.aspect = AspectPolicy::Stretch;
  EXPECT_EQ(draw_frame(drawing, options).picture_from_page, glm::mat3x2(2.5F, 0, 0, 5, 0, 0));
  std::string warning;
  azulejo::Run run;
  run.warn = [&](const std::string& text) { warning = text; };
  draw(drawing, options, run);
  EXPECT_NE(warning.find("0.5 times"), std::string::npos) << warning;
  options = {};
  options.window = std::array<float, 4>{10, 5, 20, 10};
  const DrawFrame frame = draw_frame(drawing, options);
  EXPECT_EQ(std::pair(frame.width, frame.height), std::pair(10, 5));
  EXPECT_EQ(frame.picture_from_page, glm::mat3x2(1, 0, 0, 1, -10, -5));
  options.window = std::array<float, 4>{10, 5, 10, 10};
  EXPECT_THROW(draw(drawing, options), Error);
  options = {.width = 10, .height = 10};
  options.viewport = std::array<float, 4>{5, 5, 6, 5};
  EXPECT_THROW(draw(drawing, options), Error);
}

TEST(Draw, PolygonModesPaintOneOfThree) {
  Drawing drawing = page(20, 20);
  add(drawing, rectangle(4, 4, 16, 16), kRed);
  EXPECT_EQ(at(draw(drawing, {.polygon_mode = PolygonMode::Edges}), 10, 10)[3], 0);
  EXPECT_EQ(at(draw(drawing, {.polygon_mode = PolygonMode::Edges}), 10, 4), (Rgba{255, 0, 0, 128}));
  EXPECT_EQ(at(draw(drawing, {.polygon_mode = PolygonMode::Vertices}), 10, 4)[3], 0);
  EXPECT_EQ(at(draw(drawing, {.polygon_mode = PolygonMode::Vertices}), 4, 4)[3], 255);
  EXPECT_EQ(at(draw(drawing, {.polygon_mode = PolygonMode::Filled}), 10, 10)[3], 255);
}

TEST(Draw, CrispLinesAreWholePixels) {
  Drawing drawing = page(20, 20);
  Path line;
  line.move_to({2.5F, 3.5F}).line_to({17.5F, 9.5F});
  DrawingStyle style;
  style.fill.reset();
  style.stroke = Paint(kRed);
  style.stroke_width = 5;
  drawing.add_path(line, drawing.add_style(style));
  const Image image = draw(drawing, {.strokes = DrawStrokes::Crisp});
  int count = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      const int alpha = at(image, x, y)[3];
      ASSERT_TRUE(alpha == 0 || alpha == 255);
      count += alpha / 255;
    }
  }
  EXPECT_EQ(count, 16);
}

TEST(Draw, TakesAMillionGroupsWithinEachOther) {
  Drawing drawing = page(4, 4);
  std::uint32_t group = 0;
  for (int i = 0; i < 1'000'000; ++i) group = drawing.add_group({1, 0, 0, 1, 0, 0}, 0.999999F, group);
  add(drawing, rectangle(0, 0, 4, 4), kRed, group);
  EXPECT_NEAR(at(draw(drawing), 1, 1)[3], 255 * std::exp(-1.0), 2);
  // With two things in each, every group is a layer.
  for (std::uint32_t g = 1; g < 1'000'000; ++g) add(drawing, rectangle(0, 0, 4, 4), kRed, g);
  EXPECT_THROW(draw(drawing, {}, {.limits = {.memory_bytes = std::int64_t{1} << 28}}), Error);
}

TEST(Draw, RefusesClipsThatMultiply) {
  Drawing drawing = page(4, 4);
  std::uint32_t before = drawing.add_clip();
  add(drawing, rectangle(0, 0, 4, 4), kRed, before);
  for (int i = 0; i < 60; ++i) {
    const std::uint32_t clip = drawing.add_clip();
    for (int k = 0; k < 2; ++k) {
      const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 0, 0}, 1, clip);
      drawing.groups[group].clip = before;
      add(drawing, rectangle(0, 0, 4, 4), kRed, group);
    }
    before = clip;
  }
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 0, 0});
  drawing.groups[group].clip = before;
  add(drawing, rectangle(0, 0, 4, 4), kRed, group);
  EXPECT_THROW(draw(drawing), Error);
}

}  // namespace
}  // namespace azulejo
