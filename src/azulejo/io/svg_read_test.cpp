// Where things of an SVG come to lie, and what is said of what is left out. Styles: svg_style_test.cpp.

#include "azulejo/io/svg_read.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/io/svg_testing.h"

namespace azulejo {
namespace {

/// The box of all paths, rounded to thousandths.
std::string box(const Drawing& drawing) {
  const Box2 b = bounds(drawing);
  std::string text;
  for (const float each : {b.lower.x, b.lower.y, b.upper.x, b.upper.y}) {
    if (!text.empty()) text += ' ';
    text += std::to_string(std::lround(each * 1000));
  }
  return text;
}

Drawing page(const std::string& attributes, const std::string& content = "<path d='M0 0H10V10z'/>") {
  SvgRead read = svg_file("<svg " + attributes + ">" + content + "</svg>");
  EXPECT_TRUE(read.warnings.empty());
  return std::move(read.drawing);
}

TEST(SvgPage, InPixelsOrMillimetres) {
  const auto size = [](const std::string& attributes) {
    const Drawing drawing = page(attributes);
    return std::tuple(drawing.width, drawing.height, drawing.unit);
  };
  using enum DrawingUnit;
  EXPECT_EQ(size("width='30' height='20'"), std::tuple(30.0F, 20.0F, Pixel));
  EXPECT_EQ(size("width='30pt' height='2pc'"), std::tuple(40.0F, 32.0F, Pixel));
  EXPECT_EQ(size("width='210mm' height='29.7cm'"), std::tuple(210.0F, 297.0F, Millimetre));
  EXPECT_EQ(size("width='1in' height='96px'"), std::tuple(25.4F, 25.4F, Millimetre));
  EXPECT_EQ(size("viewBox='0 0 30 20'"), std::tuple(30.0F, 20.0F, Pixel));
  EXPECT_EQ(size("viewBox='0 0 30 20' width='100%' height='100%'"), std::tuple(30.0F, 20.0F, Pixel));
  EXPECT_EQ(size("viewBox='0 0 30 20' width='60mm'"), std::tuple(60.0F, 40.0F, Millimetre));
  EXPECT_EQ(size("viewBox='0 0 30 20' height='60'"), std::tuple(90.0F, 60.0F, Pixel));
  EXPECT_EQ(size(""), std::tuple(10.0F, 10.0F, Pixel)) << "as large as what is shown";
}

TEST(SvgPage, ViewBoxAndAspect) {
  EXPECT_EQ(box(page("width='100' height='50' viewBox='0 0 10 10'")), "25000 0 75000 50000");
  EXPECT_EQ(box(page("width='100' height='50' viewBox='0 0 10 10' preserveAspectRatio='xMinYMin'")), "0 0 50000 50000");
  EXPECT_EQ(box(page("width='100' height='50' viewBox='0 0 10 10' preserveAspectRatio='xMaxYMax meet'")),
            "50000 0 100000 50000");
  EXPECT_EQ(box(page("width='100' height='50' viewBox='0 0 10 10' preserveAspectRatio='xMidYMin slice'")),
            "0 0 100000 100000");
  EXPECT_EQ(box(page("width='100' height='50' viewBox='0 0 10 10' preserveAspectRatio='xMidYMax slice'")),
            "0 -50000 100000 50000");
  EXPECT_EQ(box(page("width='100' height='50' viewBox='0 0 10 10' preserveAspectRatio='none'")), "0 0 100000 50000");
  EXPECT_EQ(box(page("width='100' height='50' viewBox='5 5 10,10' preserveAspectRatio='none'")),
            "-50000 -25000 50000 25000");
  EXPECT_EQ(box(page("width='96' height='96' viewBox='0 0 0 0'")), "0 0 10000 10000")
      << "no area: as if it weren't there";
  EXPECT_EQ(box(page("width='25.4mm' height='1in'")), "0 0 2646 2646") << "a unit is a pixel";
}

TEST(SvgPage, AViewBoxThatDoesNothingIsNoGroup) {
  const Drawing drawing = page("id='x' width='10mm' height='20mm' viewBox='0 0 10 20'");
  EXPECT_EQ(drawing.groups.size(), 1U);
  EXPECT_EQ(drawing.groups[0].id, "x");
}

TEST(SvgShapes, WhereSvgSays) {
  const auto path_of = [](const std::string& element) {
    const Drawing drawing = svg_elements(element).drawing;
    if (drawing.paths.size() != 1) return std::string("none");
    std::string text;
    const PathView view = drawing.view(drawing.paths[0]);
    for (const PathCommand each : view.commands) text += "MLQCZ"[static_cast<int>(each)];
    return text + " " + box(drawing);
  };
  EXPECT_EQ(path_of("<rect x='1' y='2' width='3' height='4'/>"), "MLLLZ 1000 2000 4000 6000");
  EXPECT_EQ(path_of("<rect x='1' y='2' width='6' height='6' rx='1'/>"), "MLCCLCCLCCLCCZ 1000 2000 7000 8000");
  EXPECT_EQ(path_of("<rect width='6' height='6' rx='30' ry='2'/>"), "MCCLCCCCLCCZ 0 0 6000 6000") << "half at most";
  EXPECT_EQ(path_of("<rect width='10%' height='10%'/>"), "MLLLZ 0 0 10000 5000");
  EXPECT_EQ(path_of("<circle cx='5' cy='6' r='2'/>"), "MCCCCCCCCZ 3000 4000 7000 8000");
  EXPECT_EQ(path_of("<ellipse cx='5' cy='6' rx='2' ry='1'/>"), "MCCCCCCCCZ 3000 5000 7000 7000");
  EXPECT_EQ(path_of("<line x1='1' y1='2' x2='3' y2='4'/>"), "ML 1000 2000 3000 4000");
  EXPECT_EQ(path_of("<polyline points='1,2 3,4 5 6'/>"), "MLL 1000 2000 5000 6000");
  EXPECT_EQ(path_of("<polygon points='1 2-3,4 5,6'/>"), "MLLZ -3000 2000 5000 6000");
  for (const char* none : {"<rect width='3'/>", "<rect width='3' height='-3'/>", "<circle/>", "<circle r='-1'/>",
                           "<ellipse rx='1' ry='0'/>", "<polygon/>", "<path/>", "<path d=''/>"}) {
    EXPECT_EQ(path_of(none), "none") << none;
  }
  EXPECT_EQ(svg_elements("<polygon points='1 2 3 4 5'/>").warnings.size(), 1U) << "an odd number of coordinates";
}

TEST(SvgGroups, KeepTransformOpacityAndIds) {
  const Drawing drawing =
      svg_elements("<g id='g' transform='translate(1 2)' opacity='.5'><path id='p' d='M0 0L1 1'/></g>").drawing;
  ASSERT_EQ(drawing.groups.size(), 2U);
  EXPECT_EQ(drawing.groups[1].id, "g");
  EXPECT_EQ(drawing.groups[1].opacity, 0.5F);
  EXPECT_EQ(drawing.groups[1].parent_from_group, glm::mat3x2(1, 0, 0, 1, 1, 2));
  ASSERT_EQ(drawing.paths.size(), 1U);
  EXPECT_EQ(drawing.paths[0].id, "p");
  EXPECT_EQ(drawing.groups[1].items, (std::vector<DrawingItem>{{false, 0}}));
}

TEST(SvgGroups, AShapeGetsOneWhereItNeedsIt) {
  const auto groups = [](const std::string& attributes) {
    return svg_elements("<path d='M0 0L1 1' " + attributes + "/>").drawing.groups.size() - 1;
  };
  EXPECT_EQ(groups(""), 0U);
  EXPECT_EQ(groups("transform='scale(1)'"), 0U);
  EXPECT_EQ(groups("transform='scale(2)'"), 1U);
  EXPECT_EQ(groups("opacity='.5'"), 0U) << "a style can say that";
  EXPECT_EQ(groups("opacity='.5' stroke='red'"), 1U) << "of both together";
}

TEST(SvgUse, CopiesAndMoves) {
  const SvgRead read = svg_elements(
      "<defs><g id='g'><path d='M0 0L1 1'/></g></defs><use xlink:href='#g' x='5' y='6'/>"
      "<use href='#g' transform='scale(10)' x='1' fill='red'/>");
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(read.drawing.paths.size(), 2U);
  const std::vector<PlacedPath> placed = walk(read.drawing);
  EXPECT_EQ(placed[0].page_from_path, glm::mat3x2(1, 0, 0, 1, 5, 6));
  EXPECT_EQ(placed[1].page_from_path, glm::mat3x2(10, 0, 0, 10, 10, 0)) << "its place is in its own coordinates";
  EXPECT_EQ(style_of(read.drawing, 0).fill->color, glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(style_of(read.drawing, 1).fill->color, glm::vec4(1, 0, 0, 1)) << "what is copied inherits from the use";
}

TEST(SvgUse, SymbolsHaveAViewport) {
  const SvgRead read = svg_elements(
      "<symbol id='s' viewBox='0 0 10 10'><path d='M0 0H10V10H0z'/></symbol>"
      "<use href='#s' x='5' y='6' width='20' height='10'/>");
  EXPECT_EQ(box(read.drawing), "10000 6000 20000 16000");
  std::size_t clips = 0;
  for (const DrawingGroup& group : read.drawing.groups) clips += group.clip ? 1 : 0;
  EXPECT_EQ(clips, 1U) << "what is outside isn't shown";
}

TEST(SvgUse, OfNothingAndOfItself) {
  EXPECT_EQ(svg_elements("<use href='#x'/>").warnings,
            (std::vector<std::string>{"test.svg: a use names what isn't there"}));
  EXPECT_EQ(svg_elements("<use href='other.svg#x'/>").warnings.size(), 1U);
  EXPECT_EQ(svg_elements("<use id='u' href='#u'/>").warnings,
            (std::vector<std::string>{"test.svg: a use shows itself"}));
  const SvgRead read = svg_elements("<g id='g'><path d='M0 0L1 1'/><use href='#g'/></g>");
  EXPECT_EQ(read.warnings.size(), 1U);
  EXPECT_EQ(read.drawing.paths.size(), 1U);
  EXPECT_EQ(svg_elements("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>").warnings,
            (std::vector<std::string>{"test.svg: a use shows itself (2 times)"}));
}

TEST(SvgNested, PlacesAndClips) {
  const Drawing drawing =
      svg_elements("<svg x='10' y='20' width='40' height='20' viewBox='0 0 20 20'><path d='M0 0H20V20z'/></svg>")
          .drawing;
  EXPECT_EQ(box(drawing), "20000 20000 40000 40000");
  const Drawing open =
      svg_elements("<svg width='4' height='4' overflow='visible'><path d='M0 0H20V20z'/></svg>").drawing;
  EXPECT_FALSE(open.groups[1].clip);
  EXPECT_EQ(box(svg_elements("<svg x='50%' width='50%'><rect width='50%' height='100%'/></svg>").drawing),
            "50000 0 75000 50000");
}

TEST(SvgSwitch, ShowsItsFirstChildThatCanBeShown) {
  const SvgRead read = svg_elements(
      "<switch><foreignObject/><g requiredExtensions='x'/><path systemLanguage='de' d='M0 0L1 1'/>"
      "<path id='b' d='M0 0L1 1'/><path d='M2 2L3 3'/></switch>");
  ASSERT_EQ(read.drawing.paths.size(), 1U);
  EXPECT_EQ(read.drawing.paths[0].id, "b");
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(svg_elements("<switch><foreignObject/><text>x</text></switch>").warnings.size(), 1U);
}

TEST(SvgClip, GroupsOfTheDrawing) {
  const Drawing drawing =
      svg_elements(
          "<clipPath id='c' transform='translate(1 0)'><rect width='5' height='5' clip-rule='evenodd'/>"
          "<g><rect width='50' height='50'/></g></clipPath>"
          "<g clip-path='url(#c)'><path d='M0 0H9V9z'/></g><path d='M0 0H9V9z' clip-path='url(#c)'/>")
          .drawing;
  ASSERT_TRUE(drawing.groups[1].clip);
  ASSERT_TRUE(drawing.groups[2].clip || drawing.groups[3].clip) << "a group for the path";
  const DrawingGroup& clip = drawing.groups[*drawing.groups[1].clip];
  EXPECT_EQ(clip.parent_from_group, glm::mat3x2(1, 0, 0, 1, 1, 0));
  ASSERT_EQ(clip.items.size(), 1U) << "clips have no groups";
  EXPECT_EQ(style_of(drawing, clip.items[0].index).fill_rule, FillRule::EvenOdd);
  std::size_t clips = 0;
  for (const DrawingGroup& group : drawing.groups) clips += group.clip == drawing.groups[1].clip ? 1 : 0;
  EXPECT_EQ(clips, 2U) << "both have the same";
}

TEST(SvgClip, MeasuredByTheBoxOfWhatIsClipped) {
  const Drawing drawing =
      svg_elements(
          "<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='.5' height='100%'/></clipPath>"
          "<g clip-path='url(#c)'><g transform='translate(10 0)'><path d='M0 0H20V10z'/></g></g>"
          "<path d='M5 5H9V9z' clip-path='url(#c)'/>")
          .drawing;
  std::vector<std::string> boxes;
  for (const DrawingGroup& group : drawing.groups) {
    if (!group.clip) continue;
    const DrawingGroup& clip = drawing.groups[*group.clip];
    ASSERT_EQ(clip.items.size(), 1U);
    const Box2 b = bounds(drawing.view(drawing.paths[clip.items[0].index]), clip.parent_from_group);
    boxes.push_back(std::to_string(b.lower.x) + " " + std::to_string(b.upper.x));
  }
  EXPECT_EQ(boxes, (std::vector<std::string>{"10.000000 20.000000", "5.000000 7.000000"}));
}

TEST(SvgClip, NestedAndInACircle) {
  const SvgRead nested = svg_elements(
      "<clipPath id='a'><rect width='5' height='5'/></clipPath>"
      "<clipPath id='b' clip-path='url(#a)'><rect width='9' height='9' clip-path='url(#a)'/></clipPath>"
      "<g clip-path='url(#b)'/>");
  EXPECT_TRUE(nested.warnings.empty());
  const DrawingGroup& b = nested.drawing.groups[*nested.drawing.groups[1].clip];
  ASSERT_TRUE(b.clip);
  ASSERT_TRUE(b.items[0].is_group);
  EXPECT_EQ(nested.drawing.groups[b.items[0].index].clip, b.clip);

  for (const char* units : {"userSpaceOnUse", "objectBoundingBox"}) {
    const std::string attribute = std::string(" clipPathUnits='") + units + "'";
    const SvgRead circle = svg_elements(
        "<clipPath id='a'" + attribute +
        "><rect width='5' height='5' clip-path='url(#b)'/></clipPath>"
        "<clipPath id='b'" +
        attribute +
        "><rect width='5' height='5' clip-path='url(#a)'/></clipPath>"
        "<rect width='5' height='5' clip-path='url(#a)'/><rect width='5' height='5' clip-path='url(#b)'/>");
    EXPECT_EQ(circle.warnings.size(), 1U) << units;  // `check` has said that there is no circle left
  }
  EXPECT_EQ(svg_elements("<g clip-path='url(#x)'/>").warnings.size(), 1U);
}

TEST(SvgLeftOut, OneWarningAKind) {
  const SvgRead read = svg_elements(
      "<text>a</text><text>b</text><image/><g filter='url(#f)' mask='url(#m)'><animate/><set/></g><title>t</title>"
      "<path d='M0 0L1 1' marker-end='url(#m)' fill='url(#p)'/><pattern id='p'/><other:thing/><blink/>"
      "<filter id='f'/><mask id='m'/><metadata><x/></metadata><path d='M0 0L1'/>");
  EXPECT_EQ(read.warnings,
            (std::vector<std::string>{"test.svg: left out: text (2 times)", "test.svg: left out: image",
                                      "test.svg: left out: filter", "test.svg: left out: mask",
                                      "test.svg: left out: animation (2 times)", "test.svg: left out: marker",
                                      "test.svg: left out: pattern", "test.svg: left out: blink",
                                      "test.svg: an error in path data or points; what stands before it is shown"}));
}

TEST(SvgFile, PrefixesOtherNamespacesAndWhatStandsFirst) {
  const auto paths = [](const std::string& text) { return svg_file(text).drawing.paths.size(); };
  EXPECT_EQ(paths("<svg:svg><svg:path d='M0 0L1 1'/><path d='M0 0L1 1'/><x:path d='M0 0L1 1'/></svg:svg>"), 1U);
  EXPECT_EQ(paths("\xEF\xBB\xBF<?xml version='1.0'?><!-- <x> --><!DOCTYPE svg [<!ENTITY a 'b'>]><svg xmlns='&a;'>"
                  "<path d='M0 0L1 1'/></svg>"),
            1U);
  EXPECT_EQ(paths("<svg><path d='M0&#32;0L1 1'/></svg>"), 1U);
}

TEST(SvgFile, ErrorsNameTheLine) {
  const auto error = [](const std::string& text) {
    try {
      svg_file(text);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error("<svg>\n<g>\n</svg>"), "test.svg: line 3: Start-end tags mismatch");
  EXPECT_EQ(error("<html/>"), "test.svg: its root is \"html\", expected svg");
  EXPECT_EQ(error("words"), "test.svg: there is no element");
  EXPECT_NE(error("<svg"), "");
}

}  // namespace
}  // namespace azulejo
