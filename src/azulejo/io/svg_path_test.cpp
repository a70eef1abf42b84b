#include "azulejo/io/svg_path.h"

#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "azulejo/io/svg_output.h"

namespace azulejo {
namespace {

/// What is read, in absolute coordinates, with "!" where there is an error.
std::string read(const std::string& text) {
  Path path;
  const bool sound = parse_path_data(text, path);
  std::string result;
  const glm::vec2* next = path.points.data();
  for (const PathCommand command : path.commands) {
    result += "MLQCZ"[static_cast<int>(command)];
    for (std::size_t i = 0; i < points_of(command); ++i, ++next) {
      result += fmt::format("{}{},{}", i > 0 ? " " : "", next->x, next->y);
    }
  }
  return result + (sound ? "" : "!");
}

TEST(SvgPath, EachCommand) {
  EXPECT_EQ(read("M1 2L3 4"), "M1,2L3,4");
  EXPECT_EQ(read("m1 2l3 4"), "M1,2L4,6");
  EXPECT_EQ(read("M1 2H5h1V7v-1"), "M1,2L5,2L6,2L6,7L6,6");
  EXPECT_EQ(read("M1 2C3 4 5 6 7 8"), "M1,2C3,4 5,6 7,8");
  EXPECT_EQ(read("M1 2c3 4 5 6 7 8"), "M1,2C4,6 6,8 8,10");
  EXPECT_EQ(read("M1 2Q3 4 5 6q1 1 2 0"), "M1,2Q3,4 5,6Q6,7 7,6");
  EXPECT_EQ(read("M1 2zM3 4Z"), "M1,2ZM3,4Z");
}

TEST(SvgPath, SmoothCurvesMirrorTheControlPointBefore) {
  EXPECT_EQ(read("M0 0C0 1 2 3 4 3S8 5 9 9"), "M0,0C0,1 2,3 4,3C6,3 8,5 9,9");
  EXPECT_EQ(read("M0 0c0 1 2 3 4 3s4 2 5 6"), "M0,0C0,1 2,3 4,3C6,3 8,5 9,9");
  EXPECT_EQ(read("M1 1S8 5 9 9"), "M1,1C1,1 8,5 9,9") << "nothing to mirror";
  EXPECT_EQ(read("M0 0Q1 2 3 2S8 5 9 9"), "M0,0Q1,2 3,2C3,2 8,5 9,9") << "not of the other kind";
  EXPECT_EQ(read("M0 0Q1 2 3 2T5 5t1 0"), "M0,0Q1,2 3,2Q5,2 5,5Q5,8 6,5");
  EXPECT_EQ(read("M1 1T5 5"), "M1,1Q1,1 5,5");
}

TEST(SvgPath, CommandsRepeat) {
  EXPECT_EQ(read("M1 2 3 4 5 6"), "M1,2L3,4L5,6");
  EXPECT_EQ(read("m1 2 3 4,5,6"), "M1,2L4,6L9,12");
  EXPECT_EQ(read("M0 0H1 2 3"), "M0,0L1,0L2,0L3,0");
  EXPECT_EQ(read("M1.5.5-3-4"), "M1.5,0.5L-3,-4");
  EXPECT_EQ(read(" \n\tM 1 , 2 , 3 4 "), "M1,2L3,4");
}

TEST(SvgPath, AfterACloseTheSubpathBeginsWhereTheLastDid) {
  EXPECT_EQ(read("M1 2L3 4zl1 1"), "M1,2L3,4ZL2,3");
  EXPECT_EQ(read("M1 2L3 4zm1 1"), "M1,2L3,4ZM2,3");
}

TEST(SvgPath, AnErrorKeepsWhatComesBefore) {
  EXPECT_EQ(read(""), "");
  EXPECT_EQ(read("L1 2"), "!");
  EXPECT_EQ(read("M1"), "!");
  EXPECT_EQ(read("M1 2L3"), "M1,2!");
  EXPECT_EQ(read("M1 2L3 4 5"), "M1,2L3,4!");
  EXPECT_EQ(read("M1 2X3 4"), "M1,2!");
  EXPECT_EQ(read("M1 2L"), "M1,2!");
  EXPECT_EQ(read("M1,,2"), "!");
  EXPECT_EQ(read("M1 2,L3 4"), "M1,2!");
  EXPECT_EQ(read("M1 2zz3"), "M1,2ZZ!");
  EXPECT_EQ(read("M1 2 A1 1 0 2 0 3 3"), "M1,2!") << "a flag is 0 or 1";
  EXPECT_EQ(read("M1 2 L inf 3"), "M1,2!");
}

TEST(SvgPath, FlagsOfArcsMayStickTogether) {
  EXPECT_EQ(read("M1 0A1 1 0 01-1 0"), read("M1 0A1 1 0 0 1 -1 0"));
  EXPECT_EQ(read("M1 0a1 1 0 01.5.5"), read("M1 0a1 1 0 0 1 .5 .5"));
  EXPECT_EQ(read("M1 0a1 1 0 1110 10"), read("M1 0a1 1 0 1 1 10 10"));
}

glm::dvec2 on_cubic(const glm::vec2* p, double t) {
  const double s = 1 - t;
  return s * s * s * glm::dvec2(p[0]) + 3 * s * s * t * glm::dvec2(p[1]) + 3 * s * t * t * glm::dvec2(p[2]) +
         t * t * t * glm::dvec2(p[3]);
}

/// All points of an arc are on an ellipse through its ends: 5·10⁻⁶ of the radius for the cubics, and rounding to floats.
TEST(SvgPath, ArcsAreOnTheirEllipse) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(0, 6.28318);
  for (int i = 0; i < 200; ++i) {
    const double rx = 1 + i % 7;
    const double ry = 1 + i % 5;
    const double turned = angle(random);
    const double from = angle(random);
    const double sweep = (i % 2 == 0 ? 1 : -1) * (0.1 + angle(random) * 0.95);
    const auto at = [&](double a) {
      const double x = rx * std::cos(a);
      const double y = ry * std::sin(a);
      return glm::dvec2(10 + x * std::cos(turned) - y * std::sin(turned),
                        20 + x * std::sin(turned) + y * std::cos(turned));
    };
    const glm::dvec2 start = at(from);
    const glm::dvec2 end = at(from + sweep);
    Path path;
    ASSERT_TRUE(parse_path_data(
        fmt::format("M{},{}A{} {} {} {} {} {},{}", start.x, start.y, rx, ry, turned * 180 / 3.141592653589793,
                    std::abs(sweep) > 3.141592653589793 ? 1 : 0, sweep > 0 ? 1 : 0, end.x, end.y),
        path));
    ASSERT_EQ(path.points.size(), 1 + 3 * (path.commands.size() - 1));
    double travelled = 0;
    glm::dvec2 before = start;
    for (std::size_t first = 0; first + 3 < path.points.size(); first += 3) {
      for (double t = 0; t <= 1; t += 0.125) {
        const glm::dvec2 p = on_cubic(&path.points[first], t);
        const glm::dvec2 d = p - glm::dvec2(10, 20);
        const double x = (d.x * std::cos(turned) + d.y * std::sin(turned)) / rx;
        const double y = (d.y * std::cos(turned) - d.x * std::sin(turned)) / ry;
        ASSERT_NEAR(std::sqrt(x * x + y * y), 1, 1e-5) << "arc " << i;
        travelled += std::sqrt((p.x - before.x) * (p.x - before.x) + (p.y - before.y) * (p.y - before.y));
        before = p;
      }
    }
    // It takes the way that was asked for: its length is between those of the two circles.
    ASSERT_GT(travelled, 0.99 * std::abs(sweep) * std::min(rx, ry)) << "arc " << i;
    ASSERT_LT(travelled, 1.01 * std::abs(sweep) * std::max(rx, ry)) << "arc " << i;
  }
}

TEST(SvgPath, ArcsOfLittleUse) {
  EXPECT_EQ(read("M1 2A1 1 0 0 0 1 2"), "M1,2") << "to where it is";
  EXPECT_EQ(read("M1 2A0 1 0 0 0 5 6"), "M1,2L5,6") << "without a radius a line";
  const std::string grown = read("M0 0A1 1 0 0 1 8 0");
  EXPECT_EQ(grown, read("M0 0A4 4 0 0 1 8 0")) << "too small radii grow";
  EXPECT_EQ(read("M0 0A-4 -4 0 0 1 8 0"), grown) << "signs don't count";
  EXPECT_EQ(read("M0 0A1e38 1e-38 0 0 1 1e38 1e38").back() == '!', false);
}

TEST(SvgPath, CircleOfEighths) {
  Path path;
  add_arc(path, {10, 20}, {3, 3}, 0, 8);
  ASSERT_EQ(path.commands.size(), 9U);
  EXPECT_EQ(path.points.front(), glm::vec2(13, 20));
  EXPECT_EQ(path.points.back(), glm::vec2(13, 20));
  EXPECT_EQ(path.points[6], glm::vec2(10, 23)) << "towards y first";
  for (std::size_t first = 0; first + 3 < path.points.size(); first += 3) {
    for (double t = 0; t <= 1; t += 0.0625) {
      const glm::dvec2 d = on_cubic(&path.points[first], t) - glm::dvec2(10, 20);
      EXPECT_NEAR(std::sqrt(d.x * d.x + d.y * d.y), 3, 3e-5);
    }
  }
}

std::string written(const Path& path) {
  std::string text;
  put_path_data(text, {path.commands, path.points});
  return text;
}

TEST(SvgPath, WrittenShort) {
  EXPECT_EQ(written(Path().move_to({1, 2}).line_to({3, 4}).line_to({5, -6}).close()), "M1 2L3 4 5-6Z");
  EXPECT_EQ(written(Path().move_to({1, 2}).line_to({3, 2}).line_to({3, .5})), "M1 2H3V.5");
  EXPECT_EQ(written(Path().move_to({0, 0}).quadratic_to({1, 1}, {2, 0}).cubic_to({3, 0}, {4, 0}, {5, 5})),
            "M0 0Q1 1 2 0C3 0 4 0 5 5");
}

TEST(SvgPath, WhatIsNotFiniteLeavesAGap) {
  const float nan = NAN;
  EXPECT_EQ(written(Path().move_to({0, 0}).line_to({1, nan}).line_to({2, 1}).line_to({3, 3})), "M0 0M2 1L3 3");
  EXPECT_EQ(written(Path().move_to({0, 1}).line_to({2, 2}).line_to({nan, nan}).line_to({5, 6}).line_to({7, 8}).close()),
            "M0 1L2 2M5 6L7 8 0 1");
  EXPECT_EQ(written(Path().move_to({nan, 0}).line_to({1, 1}).line_to({2, 3}).close()), "M1 1L2 3");
  EXPECT_EQ(written(Path().move_to({INFINITY, 0})), "");
}

TEST(SvgPath, WrittenAndReadAgain) {
  std::mt19937 random(7);
  const auto point = [&] {
    return glm::vec2(std::ldexp(static_cast<float>(random() % 20001) - 10000, -static_cast<int>(random() % 20)),
                     static_cast<float>(random() % 9) / 3);
  };
  for (int i = 0; i < 300; ++i) {
    Path path;
    path.move_to(point());
    for (auto count = random() % 20; count > 0; --count) {
      switch (random() % 6) {
        case 0: path.move_to(point()); break;
        case 1: path.line_to({path.points.back().x, point().y}); break;
        case 2: path.line_to(point()); break;
        case 3: path.quadratic_to(point(), point()); break;
        case 4: path.cubic_to(point(), point(), point()); break;
        default: path.close();
      }
    }
    Path again;
    ASSERT_TRUE(parse_path_data(written(path), again)) << written(path);
    ASSERT_EQ(path.commands, again.commands) << written(path);
    ASSERT_EQ(path.points, again.points) << written(path);
  }
}

}  // namespace
}  // namespace azulejo
