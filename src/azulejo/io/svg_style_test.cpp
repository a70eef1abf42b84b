// How an SVG's elements are painted: properties, style sheets, gradients.

#include "azulejo/io/svg_style.h"

#include <string>

#include <gtest/gtest.h>

#include "azulejo/io/svg_testing.h"

namespace azulejo {
namespace {

DrawingStyle painted(const std::string& attributes, const std::string& before = "") {
  const SvgRead read = svg_elements(before + "<path id='p' class='c d' d='M0 0H10V20H0z' " + attributes + "/>");
  EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  return style_of(read.drawing);
}

const glm::vec4 kRed(1, 0, 0, 1);
const glm::vec4 kBlue(0, 0, 1, 1);
const glm::vec4 kBlack(0, 0, 0, 1);

TEST(SvgStyle, Defaults) { EXPECT_EQ(painted(""), DrawingStyle()); }

TEST(SvgStyle, EachProperty) {
  EXPECT_FALSE(painted("fill='none'").fill);
  EXPECT_EQ(painted("fill='red'").fill->color, kRed);
  EXPECT_EQ(painted("fill='#ff000080' fill-opacity='.5'").fill->color.w, 128.0F / 255 / 2);
  EXPECT_EQ(painted("fill='currentColor' color='blue'").fill->color, kBlue);
  EXPECT_EQ(painted("fill-rule='evenodd'").fill_rule, FillRule::EvenOdd);
  EXPECT_EQ(painted("opacity='50%'").opacity, 0.5F);
  const DrawingStyle style = painted(
      "stroke='red' stroke-width='2mm' stroke-opacity='.25' stroke-linecap='round' stroke-linejoin='bevel' "
      "stroke-miterlimit='7' stroke-dasharray='1, 2px 3' stroke-dashoffset='-4' vector-effect='non-scaling-stroke'");
  EXPECT_EQ(style.stroke->color, glm::vec4(1, 0, 0, 0.25F));
  EXPECT_FLOAT_EQ(style.stroke_width, 7.5590551F);
  EXPECT_EQ(style.cap, LineCap::Round);
  EXPECT_EQ(style.join, LineJoin::Bevel);
  EXPECT_EQ(style.miter_limit, 7);
  EXPECT_EQ(style.dash, (std::vector<float>{1, 2, 3, 1, 2, 3})) << "an odd list counts twice";
  EXPECT_EQ(style.dash_offset, -4);
  EXPECT_TRUE(style.fixed_stroke);
  EXPECT_FALSE(painted("stroke='red' stroke-width='0'").stroke);
  EXPECT_TRUE(painted("stroke='red' stroke-dasharray='0 0'").dash.empty());
}

TEST(SvgStyle, ValuesThatCannotBeReadAreAsIfTheyWereNotThere) {
  EXPECT_EQ(painted("fill='reddish' stroke-width='-1' stroke-miterlimit='0' fill-rule='odd' stroke-linecap='flat' "
                    "fill-opacity='x' stroke-dasharray='1 -2' opacity=''"),
            DrawingStyle());
}

TEST(SvgStyle, WhatIsInheritedAndWhatIsNot) {
  const SvgRead read = svg_elements(
      "<g fill='red' stroke='currentColor' color='blue' opacity='.5' font-size='10'><path d='M0 0L1 1'/>"
      "<path d='M0 0L1 1' fill='none' color='red' stroke-width='1em'/></g>");
  EXPECT_EQ(style_of(read.drawing, 0).fill->color, kRed);
  EXPECT_EQ(style_of(read.drawing, 0).stroke->color, kBlue);
  EXPECT_EQ(style_of(read.drawing, 0).opacity, 1);
  EXPECT_EQ(style_of(read.drawing, 1).stroke->color, kRed) << "the keyword is inherited, not its color";
  EXPECT_EQ(style_of(read.drawing, 1).stroke_width, 10);
  EXPECT_EQ(svg_elements("<g fill='red'><path d='M0 0L1 1' fill='inherit'/></g>").drawing.styles[0].fill->color, kRed);
}

TEST(SvgStyle, TransformsStandInStyleSheetsToo) {
  const SvgRead read = svg_elements(
      "<style>.a{transform:translate(3px, 4px) rotate(90deg)}</style><path class='a' d='M0 0L1 1' "
      "transform='scale(2)'/>");
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(walk(read.drawing)[0].page_from_path, glm::mat3x2(0, 1, -1, 0, 3, 4));
}

TEST(SvgStyle, HiddenThings) {
  const auto paths = [](const std::string& text) { return svg_elements(text).drawing.paths.size(); };
  EXPECT_EQ(paths("<path d='M0 0L1 1' display='none'/>"), 0U);
  EXPECT_EQ(paths("<g display='none'><path d='M0 0L1 1' display='inline'/></g>"), 0U);
  EXPECT_EQ(paths("<g visibility='hidden'><path d='M0 0L1 1'/></g>"), 0U);
  EXPECT_EQ(paths("<g visibility='hidden'><path d='M0 0L1 1' visibility='visible'/></g>"), 1U);
}

TEST(SvgSheet, SelectorsAndWhoWins) {
  const auto fill = [](const std::string& css, const std::string& attributes = "") {
    return painted(attributes, "<style>" + css + "</style>").fill->color;
  };
  EXPECT_EQ(fill("path{fill:red}"), kRed);
  EXPECT_EQ(fill("*{fill:red}"), kRed);
  EXPECT_EQ(fill(".c { fill : red }"), kRed);
  EXPECT_EQ(fill("#p{fill:red}"), kRed);
  EXPECT_EQ(fill("path.c.d{fill:red}"), kRed);
  EXPECT_EQ(fill("path.c.e{fill:red}"), kBlack);
  EXPECT_EQ(fill("rect,\n.d{fill:red}"), kRed);
  EXPECT_EQ(fill("<![CDATA[.c{fill:red}]]>"), kRed);
  EXPECT_EQ(fill("/* .c{} */ .c{/*;*/fill:red;x:url(a;b)}"), kRed);
  EXPECT_EQ(fill("#p{fill:red} .c{fill:blue} path{fill:blue}"), kRed) << "an id counts more";
  EXPECT_EQ(fill(".c{fill:red} path{fill:blue}"), kRed) << "a class counts more";
  EXPECT_EQ(fill(".c{fill:blue} .d{fill:red}"), kRed) << "the last of equals";
  EXPECT_EQ(fill("path{fill:red !important} #p{fill:blue}"), kRed);
  EXPECT_EQ(fill("path{fill:red}", "fill='blue'"), kRed) << "attributes count least";
  EXPECT_EQ(fill("#p{fill:blue}", "style='fill:red'"), kRed) << "the style attribute counts most";
  EXPECT_EQ(fill("#p{fill:red!important}", "style='fill:blue'"), kRed);
  EXPECT_EQ(fill("#p{fill:blue!important}", "style='fill:red!important'"), kRed);
}

TEST(SvgSheet, WhatIsNotUnderstoodIsSaid) {
  const SvgRead read = svg_elements(
      "<style>@import url(x.css); g > path{fill:blue} a:hover{fill:blue} @media print{path{fill:blue} g{}} "
      "path{fill:red}</style><g><path d='M0 0L1 1'/></g>");
  EXPECT_EQ(style_of(read.drawing).fill->color, kRed);
  EXPECT_EQ(read.warnings, (std::vector<std::string>{
                               "test.svg: left out: @import of style sheets",
                               "test.svg: left out: rules of style sheets with selectors of several steps (2 times)",
                               "test.svg: left out: @media of style sheets"}));
}

/// The gradient of a path whose box is 10 × 20.
Gradient gradient(const std::string& definitions) {
  const SvgRead read = svg_elements(definitions + "<path d='M0 0H10V20H0z' fill='url(#g)' fill-opacity='.5'/>");
  EXPECT_TRUE(read.warnings.empty());
  const DrawingStyle& style = style_of(read.drawing);
  if (!style.fill || !style.fill->pattern) {
    ADD_FAILURE() << "no gradient";
    return {};
  }
  EXPECT_EQ(style.fill->color.w, 0.5F);
  return std::get<Gradient>(read.drawing.patterns[*style.fill->pattern]);
}

const char* const kStops = "<stop stop-color='red'/><stop offset='50%' stop-color='blue' stop-opacity='.5'/>";

TEST(SvgGradient, Linear) {
  const Gradient of_box = gradient(std::string("<linearGradient id='g'>") + kStops + "</linearGradient>");
  EXPECT_FALSE(of_box.radial);
  EXPECT_EQ(of_box.from, glm::vec2(0, 0));
  EXPECT_EQ(of_box.to, glm::vec2(1, 0));
  EXPECT_EQ(of_box.path_from_gradient, glm::mat3x2(10, 0, 0, 20, 0, 0));
  ASSERT_EQ(of_box.stops.size(), 2U);
  EXPECT_EQ(of_box.stops[1].offset, 0.5F);
  EXPECT_EQ(of_box.stops[1].color, glm::vec4(0, 0, 1, 0.5F));

  const Gradient of_page = gradient(std::string("<linearGradient id='g' gradientUnits='userSpaceOnUse' x1='1' y2='50%' "
                                                "spreadMethod='reflect' gradientTransform='scale(2)'>") +
                                    kStops + "</linearGradient>");
  EXPECT_EQ(of_page.from, glm::vec2(1, 0));
  EXPECT_EQ(of_page.to, glm::vec2(100, 25));
  EXPECT_EQ(of_page.spread, GradientSpread::Reflect);
  EXPECT_EQ(of_page.path_from_gradient, glm::mat3x2(2, 0, 0, 2, 0, 0));
}

TEST(SvgGradient, Radial) {
  const Gradient plain = gradient(std::string("<radialGradient id='g'>") + kStops + "</radialGradient>");
  EXPECT_TRUE(plain.radial);
  EXPECT_EQ(plain.from, glm::vec2(0.5F, 0.5F));
  EXPECT_EQ(plain.to, glm::vec2(0.5F, 0.5F));
  EXPECT_EQ(plain.to_radius, 0.5F);
  EXPECT_EQ(plain.from_radius, 0);
  const Gradient focal =
      gradient(std::string("<radialGradient id='g' cx='1' fx='.25' r='2' fr='.1'>") + kStops + "</radialGradient>");
  EXPECT_EQ(focal.from, glm::vec2(0.25F, 0.5F));
  EXPECT_EQ(focal.to, glm::vec2(1, 0.5F));
  EXPECT_EQ(focal.to_radius, 2);
  EXPECT_EQ(focal.from_radius, 0.1F);
}

TEST(SvgGradient, TakesFromOthers) {
  const Gradient taken = gradient(std::string("<linearGradient id='b' x1='.25' spreadMethod='repeat'>") + kStops +
                                  "</linearGradient><linearGradient id='a' x2='.75' href='#b'/>"
                                  "<linearGradient id='g' xlink:href='#a' y2='1'/>");
  EXPECT_EQ(taken.from, glm::vec2(0.25F, 0));
  EXPECT_EQ(taken.to, glm::vec2(0.75F, 1));
  EXPECT_EQ(taken.spread, GradientSpread::Repeat);
  EXPECT_EQ(taken.stops.size(), 2U);
  const SvgRead circle = svg_elements(
      "<linearGradient id='g' href='#h'/><linearGradient id='h' href='#g'/>"
      "<path d='M0 0H1V1z' fill='url(#g)'/>");
  EXPECT_EQ(circle.warnings.size(), 1U);
  EXPECT_FALSE(style_of(circle.drawing).fill);
}

TEST(SvgGradient, StopsNeverFall) {
  const Gradient sorted = gradient(
      "<linearGradient id='g'><stop offset='.5'/><stop offset='.25' style='stop-color:red'/><stop offset='7'/>"
      "</linearGradient>");
  EXPECT_EQ(sorted.stops[1].offset, 0.5F);
  EXPECT_EQ(sorted.stops[1].color, kRed);
  EXPECT_EQ(sorted.stops[2].offset, 1);
}

TEST(SvgGradient, ThatIsNone) {
  const auto fill = [](const std::string& definition, const std::string& paint) {
    const SvgRead read = svg_elements(definition + "<path d='M0 0H10V10z' fill='" + paint + "'/>");
    return style_of(read.drawing).fill;
  };
  EXPECT_FALSE(fill("<linearGradient id='g'/>", "url(#g)"));
  EXPECT_EQ(fill("<linearGradient id='g'/>", "url(#g) red")->color, kRed) << "the color behind it";
  EXPECT_FALSE(fill("", "url(#g)"));
  EXPECT_EQ(fill("<linearGradient id='g' x2='0'><stop/><stop stop-color='red'/></linearGradient>", "url(#g)")->color,
            kRed)
      << "from a point to itself: the last color";
  EXPECT_EQ(fill("<radialGradient id='g' r='0'><stop/><stop stop-color='red'/></radialGradient>", "url(#g)")->color,
            kRed);
  const SvgRead line =
      svg_elements("<linearGradient id='g'><stop/></linearGradient><path d='M0 0H9' stroke='url(#g)'/>");
  EXPECT_FALSE(style_of(line.drawing).stroke) << "a box without area";
}

}  // namespace
}  // namespace azulejo
