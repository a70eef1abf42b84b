#include "azulejo/charting/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "azulejo/charting/plot.h"
#include "azulejo/core/error.h"

namespace azulejo {
namespace {

CsvTable table(const std::string& text) { return parse_csv(text, "test.csv"); }

std::vector<std::uint32_t> paths_of(const Drawing& drawing, std::string_view id) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t p = 0; p < drawing.paths.size(); ++p) {
    if (drawing.paths[p].id == id) found.push_back(p);
  }
  return found;
}

PathView only(const Drawing& drawing, std::string_view id) {
  const std::vector<std::uint32_t> found = paths_of(drawing, id);
  EXPECT_EQ(found.size(), 1U) << id;
  return found.empty() ? PathView{} : drawing.view(drawing.paths[found[0]]);
}

Box2 area_of(const Drawing& drawing) { return bounds(only(drawing, "frame")); }

std::vector<std::string> texts_of(const Drawing& drawing, std::string_view id) {
  std::vector<std::string> texts;
  for (const std::uint32_t p : paths_of(drawing, id)) texts.push_back(drawing.texts[*drawing.paths[p].text].text);
  return texts;
}

TEST(Chart, LinesGoThroughTheirPoints) {
  const Drawing drawing =
      chart(table("t,v\n0,0\n1,4\n2,1\n4,10\n"), {.x = "t", .x_range = glm::vec2(0, 4), .y_range = glm::vec2(0, 10)});
  drawing.check("chart");
  const Box2 area = area_of(drawing);
  const auto at = [&](float x, float y) {
    return glm::vec2(area.lower.x + (area.upper.x - area.lower.x) * x / 4,
                     area.upper.y - (area.upper.y - area.lower.y) * y / 10);
  };
  const PathView line = only(drawing, "v");
  const std::vector<glm::vec2> wanted{at(0, 0), at(1, 4), at(2, 1), at(4, 10)};
  ASSERT_EQ(line.points.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(line.points[i].x, wanted[i].x, 1e-3F);
    EXPECT_NEAR(line.points[i].y, wanted[i].y, 1e-3F);
  }
  EXPECT_EQ(texts_of(drawing, "x-label"), std::vector<std::string>{"t"});
  EXPECT_EQ(texts_of(drawing, "y-label"), std::vector<std::string>{"v"});
  EXPECT_EQ(texts_of(drawing, "y-tick").front(), "0");
}

TEST(Chart, LogarithmicAxesPlaceByPowers) {
  const Drawing drawing = chart(table("a,b\n1,1\n10,100\n1000,1e4\n"), {.x = "a",
                                                                        .x_range = glm::vec2(1, 1000),
                                                                        .y_range = glm::vec2(1, 10000),
                                                                        .x_scale = AxisScale::Log,
                                                                        .y_scale = AxisScale::Log});
  const Box2 area = area_of(drawing);
  const PathView line = only(drawing, "b");
  ASSERT_EQ(line.points.size(), 3U);
  EXPECT_NEAR(line.points[1].x, area.lower.x + (area.upper.x - area.lower.x) / 3, 1e-3F);
  EXPECT_NEAR(line.points[1].y, 0.5F * (area.lower.y + area.upper.y), 1e-3F);
}

TEST(Chart, WhatIsNoNumberIsAGap) {
  const Drawing drawing = chart(table("v\n1\n2\nnan\n3\n\n4\nnan\n5\n6\n"), {.kind = ChartKind::Line});
  const PathView line = only(drawing, "v");
  EXPECT_EQ(std::count(line.commands.begin(), line.commands.end(), PathCommand::Move), 3);
  for (const glm::vec2& point : line.points) EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
  // On a logarithmic axis, so is what has no place there.
  const Drawing log = chart(table("v\n1\n0\n-3\n5\n6\n"), {.kind = ChartKind::Line, .y_scale = AxisScale::Log});
  EXPECT_EQ(only(log, "v").points.size(), 4U) << "a point alone is a line of no length";
}

TEST(Chart, BarsStandAtTheirHeights) {
  const Drawing drawing =
      chart(table("fruit,small,large\napple,2,4\npear,-1,3\nplum,,8\n"), {.y_range = glm::vec2(-2, 8)});
  const Box2 area = area_of(drawing);
  const auto y_of = [&](float value) { return area.upper.y - (area.upper.y - area.lower.y) * (value + 2) / 10; };
  const auto x_of = [&](float place) { return area.lower.x + (area.upper.x - area.lower.x) * (place + 0.5F) / 3; };
  const PathView small = only(drawing, "small");
  ASSERT_EQ(small.points.size(), 2 * 4U) << "an empty cell has no bar";
  const PathView large = only(drawing, "large");
  ASSERT_EQ(large.points.size(), 3 * 4U);
  const auto box = [](const PathView& path, std::size_t bar) {
    return bounds({path.commands.subspan(5 * bar, 5), path.points.subspan(4 * bar, 4)});
  };
  EXPECT_NEAR(box(small, 0).lower.x, x_of(-0.4F), 1e-3F);
  EXPECT_NEAR(box(small, 0).upper.x, x_of(0), 1e-3F);
  EXPECT_NEAR(box(small, 0).lower.y, y_of(2), 1e-3F);
  EXPECT_NEAR(box(small, 0).upper.y, y_of(0), 1e-3F);
  EXPECT_NEAR(box(small, 1).lower.y, y_of(0), 1e-3F) << "down from 0";
  EXPECT_NEAR(box(small, 1).upper.y, y_of(-1), 1e-3F);
  EXPECT_NEAR(box(large, 2).lower.y, y_of(8), 1e-3F);
  EXPECT_NEAR(box(large, 2).lower.x, x_of(2), 1e-3F);
  EXPECT_EQ(texts_of(drawing, "x-tick"), (std::vector<std::string>{"apple", "pear", "plum"}));
  EXPECT_EQ(texts_of(drawing, "legend-text"), (std::vector<std::string>{"small", "large"}));
}

TEST(Chart, StackedBarsStandOnEachOther) {
  const Drawing drawing = chart(table("k,a,b\nx,1,2\n"), {.stacked = true, .y_range = glm::vec2(0, 4)});
  const Box2 area = area_of(drawing);
  const float unit = (area.upper.y - area.lower.y) / 4;
  const Box2 a = bounds(only(drawing, "a"));
  const Box2 b = bounds(only(drawing, "b"));
  EXPECT_NEAR(a.lower.y, area.upper.y - unit, 1e-3F);
  EXPECT_NEAR(b.upper.y, a.lower.y, 1e-3F);
  EXPECT_NEAR(b.lower.y, area.upper.y - 3 * unit, 1e-3F);
  EXPECT_EQ(a.lower.x, b.lower.x);
}

TEST(Chart, BarsAddUpWhatIsOfOneName) {
  const Drawing sums = chart(table("k,v\nx,1\ny,5\nx,2\n"), {.y_range = glm::vec2(0, 6)});
  const Box2 area = area_of(sums);
  const PathView bars = only(sums, "v");
  ASSERT_EQ(bars.points.size(), 8U);
  EXPECT_NEAR(bounds({bars.commands.first(5), bars.points.first(4)}).lower.y, 0.5F * (area.lower.y + area.upper.y),
              1e-3F);
  // Without numbers, rows are counted.
  const Drawing counts = chart(table("k,w\nx,a\ny,a\nx,b\n"), {.x = "k"});
  EXPECT_EQ(texts_of(counts, "y-label"), std::vector<std::string>{"count"});
}

TEST(Chart, HistogramsCount) {
  const Drawing drawing =
      chart(table("v\n0\n0.5\n1.5\n1.7\n1.9\n4\n"),
            {.kind = ChartKind::Histogram, .bins = 4, .x_range = glm::vec2(0, 4), .y_range = glm::vec2(0, 4)});
  const Box2 area = area_of(drawing);
  const PathView shape = only(drawing, "v");
  // Counts 2, 3, 0 and 1: the upper end belongs to the last bin.
  std::vector<float> heights;
  for (std::size_t i = 1; i + 1 < shape.points.size(); i += 2) {
    heights.push_back((area.upper.y - shape.points[i].y) / (area.upper.y - area.lower.y) * 4);
  }
  ASSERT_EQ(heights.size(), 4U);
  EXPECT_NEAR(heights[0], 2, 1e-4F);
  EXPECT_NEAR(heights[1], 3, 1e-4F);
  EXPECT_NEAR(heights[2], 0, 1e-4F);
  EXPECT_NEAR(heights[3], 1, 1e-4F);
}

TEST(Chart, OfAnImageIsItsHistogram) {
  Image image(8, 4, 1);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) image.view<std::uint8_t>()(x, y) = x < 6 ? 0 : 255;
  }
  const Drawing drawing = chart(image, {.bins = 2, .y_range = glm::vec2(0, 24)});
  const Box2 area = area_of(drawing);
  const PathView shape = only(drawing, "gray");
  EXPECT_NEAR(shape.points[1].y, area.lower.y, 1e-3F) << "24 of 32";
  EXPECT_NEAR(shape.points[3].y, area.upper.y - (area.upper.y - area.lower.y) / 3, 1e-3F) << "8 of 32";
}

TEST(Chart, ContoursOfAnImageAreWhereItsValuesAre) {
  Image image(64, 64, 1, PixelType::F32);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x)
      image.view<float>()(x, y) = std::hypot(static_cast<float>(x) - 31.5F, static_cast<float>(y) - 31.5F);
  }
  const Drawing drawing = chart(image, {.kind = ChartKind::Contour, .levels = {20}, .labels = false});
  drawing.check("chart");
  const Box2 area = area_of(drawing);
  const float scale = (area.upper.x - area.lower.x) / 64;
  EXPECT_NEAR(area.upper.y - area.lower.y, 64 * scale, 0.1F) << "pixels are squares";
  const glm::vec2 middle = 0.5F * (area.lower + area.upper);
  for (const glm::vec2& point : only(drawing, "level 20").points) {
    // A distance of 20 has a second derivative of 1/20: 1/160 of a pixel.
    EXPECT_NEAR(std::hypot(point.x - middle.x, point.y - middle.y), 20 * scale, 0.01F * scale);
  }
}

TEST(Chart, HeatMapsColorTheirCells) {
  const Drawing drawing = chart(table("a,b\n0,1\n1,0\n"), {.kind = ChartKind::Heatmap, .map = ColorMap::Gray});
  const std::vector<std::uint32_t> cells = paths_of(drawing, "cells");
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(drawing.styles[drawing.paths[cells[0]].style].fill->color, glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(drawing.styles[drawing.paths[cells[1]].style].fill->color, glm::vec4(1, 1, 1, 1));
  EXPECT_EQ(texts_of(drawing, "cell-text"), (std::vector<std::string>{"0", "1", "1", "0"}));
  EXPECT_EQ(texts_of(drawing, "x-tick"), (std::vector<std::string>{"a", "b"}));
  const Box2 area = area_of(drawing);
  const Box2 dark = bounds(drawing.view(drawing.paths[cells[0]]));
  EXPECT_NEAR(dark.lower.x, area.lower.x, 1);
  EXPECT_NEAR(dark.upper.y, area.upper.y, 1);
}

/// Whether two texts of a drawing lie on each other. Slanted ones count by their line, not by their box.
void expect_apart(const Drawing& drawing) {
  std::vector<Box2> boxes;
  std::vector<std::string> names;
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingPath& path = drawing.paths[placed.path];
    if (!path.text || path.command_count == 0 || path.id == "level-text") continue;
    const glm::vec2 along = placed.page_from_path[0];
    if (std::abs(along.x) > 0.1F && std::abs(along.y) > 0.1F) continue;
    boxes.push_back(bounds(drawing.view(path), placed.page_from_path));
    names.push_back(path.id + " " + drawing.texts[*path.text].text);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool apart = boxes[i].lower.x > boxes[k].upper.x || boxes[k].lower.x > boxes[i].upper.x ||
                         boxes[i].lower.y > boxes[k].upper.y || boxes[k].lower.y > boxes[i].upper.y;
      EXPECT_TRUE(apart) << names[i] << " and " << names[k];
    }
  }
}

TEST(Chart, TextsNeverOverlap) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 1000; ++round) {
    const double size = std::pow(10, 9 * unit(random));
    const double middle = size * std::pow(10, 2 * unit(random)) * unit(random);
    std::string text = "x,first,second\n";
    for (int i = 0; i < 5; ++i) {
      text += fmt::format("{},{},{}\n", middle + size * unit(random), middle * 0.1 + size * unit(random),
                          size * unit(random));
    }
    ChartOptions options{.kind = ChartKind::Scatter, .x = "x"};
    options.width = 160 + static_cast<int>(random() % 800);
    options.height = 120 + static_cast<int>(random() % 600);
    options.title = round % 2 == 0 ? "A title of some length" : "";
    options.x_scale = round % 5 == 0 ? AxisScale::Log : AxisScale::Linear;
    options.y_scale = round % 7 == 0 ? AxisScale::Log : AxisScale::Linear;
    options.legend = ChartLegend::UpperLeft;
    SCOPED_TRACE(testing::Message() << "round " << round << ", " << options.width << " x " << *options.height << "\n"
                                    << text);
    const Drawing drawing = chart(table(text), options);
    drawing.check("chart");
    expect_apart(drawing);
    if (testing::Test::HasFailure()) break;
  }
}

TEST(Chart, LegendsGoWhereNothingIs) {
  std::string rising = "x,a,b\n";
  for (int i = 0; i < 50; ++i) rising += fmt::format("{},{},{}\n", i, i * i, i * i + 20 * i);
  const Drawing drawing = chart(table(rising), {.x = "x"});
  const Box2 legend = bounds(
      only(drawing, "a").points.empty() ? PathView{} : drawing.view(drawing.paths[paths_of(drawing, "legend")[0]]));
  const Box2 area = area_of(drawing);
  for (const char* name : {"a", "b"}) {
    for (const glm::vec2& point : only(drawing, name).points) {
      EXPECT_FALSE(point.x > legend.lower.x && point.x < legend.upper.x && point.y > legend.lower.y &&
                   point.y < legend.upper.y);
    }
  }
  EXPECT_GE(legend.lower.x, area.lower.x);
}

TEST(Chart, AnyTableGivesAPage) {
  const std::vector<std::string> tables{"a,b\n1,2\n",
                                        "a\n5\n5\n5\n",
                                        "a,b\nnan,nan\n",
                                        "a,b\n1e308,-1e308\n-1e308,1e308\n",
                                        "a,b\n1e-320,5e-324\n0,0\n",
                                        "a,b\ninf,1\n-inf,2\n",
                                        "a,b\n1000000000001,1\n1000000000002,2\n",
                                        "w,v\nx,1\n,2\n\xFF\xFE,3\n",
                                        "a,b\n-1,-2\n-3,-4\n"};
  for (const std::string& text : tables) {
    for (const ChartKind kind : {ChartKind::Line, ChartKind::Scatter, ChartKind::Bar, ChartKind::Histogram,
                                 ChartKind::Heatmap, ChartKind::Contour}) {
      for (const AxisScale scale : {AxisScale::Linear, AxisScale::Log}) {
        SCOPED_TRACE(text + std::string(enum_names(kind)[static_cast<std::size_t>(kind)]));
        const Drawing drawing = chart(table(text), {.kind = kind, .x_scale = scale, .y_scale = scale});
        EXPECT_NO_THROW(drawing.check("chart"));
        for (const glm::vec2& point : drawing.points) EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
      }
    }
  }
}

TEST(Chart, SaysWhatDoesNotFit) {
  const CsvTable numbers = table("a,b\n1,2\n");
  const auto message = [](const CsvTable& data, const ChartOptions& options) -> std::string {
    try {
      (void)chart(data, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(numbers, {.x = "c"}).find("x"), std::string::npos);
  EXPECT_EQ(message(table("a,w\n1,x\n"), {.y = {"w"}}), "y: column w holds words, expected numbers");
  EXPECT_EQ(message(numbers, {.x_range = glm::vec2(2, 1)}), "x_range: 2,1, expected two rising numbers");
  EXPECT_EQ(message(numbers, {.x_range = glm::vec2(0, 1), .x_scale = AxisScale::Log}),
            "x_range: it begins at 0, expected more than 0 on a logarithmic axis");
  EXPECT_EQ(message(table("w\nx\n"), {.kind = ChartKind::Line}), "data: test.csv: it has no column of numbers");
  EXPECT_THROW(chart(Image(4, 4, 3), {.kind = ChartKind::Contour}), Error);
  EXPECT_THROW(chart(Image(4, 4, 1), {.kind = ChartKind::Bar}), Error);
}

TEST(Chart, AMillionPointsAreOnePath) {
  CsvTable data;
  data.source = "memory";
  data.rows = 1000000;
  std::mt19937 random(1);
  for (const char* name : {"x", "y"}) {
    CsvColumn& column = data.columns.emplace_back();
    column.name = name;
    for (std::size_t i = 0; i < data.rows; ++i) column.numbers.push_back(static_cast<double>(random()));
  }
  const Drawing drawing = chart(data, {.kind = ChartKind::Scatter, .x = "x"});
  EXPECT_EQ(only(drawing, "y").points.size(), 1000000U);
}

}  // namespace
}  // namespace azulejo
