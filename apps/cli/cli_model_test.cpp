// Models on the command line: what `info` tells of them, and the options for reading them.

#include <array>
#include <fstream>

#include "azulejo/core/json.h"
#include "azulejo/io/model_io.h"
#include "azulejo/operations.h"
#include "cli_testing.h"

namespace azulejo {
namespace {

class CliModel : public Cli {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  /// A tetrahedron, closed, in a file as CAD programs write it.
  void write_tetrahedron(const std::string& name) const {
    const char* const corners[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
    std::string text = "solid tetrahedron\n";
    for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : face) text += std::string("vertex ") + corners[corner] + "\n";
      text += "endloop\nendfacet\n";
    }
    write(name, text + "endsolid tetrahedron\n");
  }
  Json info(std::vector<std::string> words) const {
    words.insert(words.begin(), "info");
    words.emplace_back("--json");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(outcome.out, "info");
  }
};

TEST_F(CliModel, InfoTellsAMesh) {
  write_tetrahedron("t.stl");
  const Outcome text = run({"info", "t.stl"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_EQ(text.out,
            "t.stl\n"
            "  format      stl (mesh)\n"
            "  name        \"tetrahedron\"\n"
            "  vertices    4\n"
            "  faces       4 triangles\n"
            "  closed      yes\n"
            "  bounds      (0, 0, 0) to (1, 1, 1)\n"
            "  size        1 × 1 × 1\n"
            "  unit        unknown\n"
            "  up          z\n");
  const Json json = info({"t.stl"});
  EXPECT_EQ(json["operation"].text(), "info");
  EXPECT_EQ(json["format"].text(), "stl");
  EXPECT_EQ(json["faces"].number(), 4);
  EXPECT_TRUE(json["closed"].truth());
  EXPECT_TRUE(json["metres_per_unit"].is_null());
}

TEST_F(CliModel, AModelComesThroughStandardInput) {
  write_tetrahedron("t.stl");
  ASSERT_EQ(run({"run", "t.stl", "-o", "t.ply"}).status, 0);
  ASSERT_EQ(run({"run", "t.stl", "-o", "t.obj"}).status, 0);
  ASSERT_EQ(run({"render", "t.stl", "-o", "file.png", "--up-axis", "z"}).status, 0);
  for (const std::string name : {"t.stl", "t.ply", "t.obj"}) {
    const Outcome told = run({"info", "-"}, path(name));
    EXPECT_EQ(told.status, 0) << name << ": " << told.err;
    EXPECT_NE(told.out.find("4 triangles"), std::string::npos) << told.out;
    const Outcome drawn = run({"render", "-", "-o", "pipe.png", "--up-axis", "z"}, path(name));
    EXPECT_EQ(drawn.status, 0) << name << ": " << drawn.err;
    EXPECT_EQ(read_file(path("pipe.png")), read_file(path("file.png"))) << name;
  }
  make_ramp("ramp.png");
  EXPECT_NE(run({"info", "-"}, path("ramp.png")).out.find("32×24"), std::string::npos);
  EXPECT_EQ(run({"run", "-", "sobel", "-o", "edges.png"}, path("ramp.png")).status, 0);
  // What came through before says nothing of what comes now.
  for (int i = 0; i < 2; ++i) {
    EXPECT_NE(run({"turntable", "-", "-o", "f{frame}.png", "--frames", "2"}, path("t.stl")).err.find("2 done, 0 done"),
              std::string::npos);
  }
  write("noise", "no model and no picture\n");
  const Outcome refused = run({"render", "-", "-o", "x.png"}, path("noise"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "azulejo: standard input: byte 0: not an image of a known format\n");
}

TEST_F(CliModel, WhatFailsForAllFramesIsSaidOnce) {
  const Outcome outcome = run({"turntable", "missing.stl", "-o", "f{frame}.png", "--frames", "5"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err,
            "azulejo: missing.stl: can't open: No such file or directory\n"
            "azulejo: 0 done, 0 done before, 5 failed, 5 in all\n");
}

TEST_F(CliModel, ReadingTakesOptions) {
  write_tetrahedron("t.stl");
  const Json json = info({"t.stl", "--no-weld", "--unit", "in", "--up-axis", "y"});
  EXPECT_EQ(json["vertices"].number(), 12);
  EXPECT_FLOAT_EQ(static_cast<float>(json["metres_per_unit"].number()), 0.0254F);
  EXPECT_EQ(json["up"].text(), "y");
  EXPECT_TRUE(json["closed"].truth()) << "equal positions meet all the same";
}

TEST_F(CliModel, RawSamplesTakeTheirLayout) {
  write("v.dat", std::string("??\x01\x02\x03\x04\x05\x06", 8));
  const Json json = info({"v.dat", "--raw", "3x1x1:u16:be:skip=2:spacing=1,2,0.5"});
  EXPECT_EQ(json["kind"].text(), "volume");
  EXPECT_EQ(json["lowest"].number(), 258);
  EXPECT_EQ(json["spacing"][2].number(), 0.5);
  for (const std::string wrong : {"3x1:u8", "3x1x1", "3x1x1:u9", "0x1x1:u8", "3x1x1:u8:skip=-1", "3x1x1:u8:skip=",
                                  "3x1x1:u8:spacing=1,2", "3x1x1:u8:spacing=1,2,0", "3x1x1:u8:x", "3x1x1x1:u8", ""}) {
    const Outcome outcome = run({"info", "v.dat", "--raw=" + wrong});
    EXPECT_EQ(outcome.status, 2) << wrong;
    EXPECT_NE(outcome.err.find("--raw: "), std::string::npos) << outcome.err;
  }
}

TEST_F(CliModel, TreeShowsTheNodes) {
  write("two.obj", "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no two\nv 5 5 5\nf 2 3 4\n");
  const Outcome text = run({"info", "two.obj", "--tree"});
  EXPECT_NE(text.out.find("\none  [mesh \"one\", 1 faces]\ntwo  [mesh \"two\", 1 faces]\n"), std::string::npos)
      << text.out;
  const Json json = info({"two.obj", "--tree"});
  EXPECT_EQ(json["tree"]["nodes"].size(), 2U);
  EXPECT_EQ(json["tree"]["roots"].size(), 2U);
}

TEST_F(CliModel, ModelsAndImagesAreToldApart) {
  make_ramp("a.png");
  write_tetrahedron("t.stl");
  const Outcome both = run({"info", "t.stl", "a.png", "gone.obj", "t.stl"});
  EXPECT_EQ(both.status, 1);
  EXPECT_NE(both.out.find("32×24"), std::string::npos) << both.out;
  EXPECT_EQ(both.err, "azulejo: gone.obj: can't open: No such file or directory\n");
}

TEST_F(CliModel, NoOperationTakesTheNameOfASharedOption) {
  for (const Operation* each : operations()) {
    const Outcome outcome = run({each->name, "--help"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
}

TEST_F(CliModel, PictureDrawsWhatThereIsToDraw) {
  write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const Outcome topology = run({"topology", "open.obj", "--picture", "faults.png"});
  EXPECT_EQ(topology.status, 3) << topology.err;
  const Json report = Json::parse(topology.out, "topology");
  EXPECT_EQ(report["border_edges"].number(), 3);
  EXPECT_EQ(report["marked"]["border_edges"]["marks"].number(), 3);
  EXPECT_EQ(report["marked"]["border_edges"]["color"].text(), "#0b5fff");
  const Image faults = read_image(path("faults.png"));
  EXPECT_EQ(faults.width(), 1024);
  // Somewhere it is of the color that the report tells.
  bool found = false;
  const auto view = faults.view<std::uint8_t>();
  for (int y = 0; y < faults.height(); ++y) {
    for (int x = 0; x < faults.width(); ++x) {
      const std::uint8_t* const pixel = view.row(y) + 4 * x;
      found = found || (pixel[0] == 0x0B && pixel[1] == 0x5F && pixel[2] == 0xFF && pixel[3] == 255);
    }
  }
  EXPECT_TRUE(found);

  EXPECT_EQ(run({"run", "primitive:kind=cube", "--picture", "cube.png"}).status, 0);
  EXPECT_GT(read_image(path("cube.png")).width(), 0);
  const Outcome none = run({"statistics", "cube.png", "--picture", "x.png"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("expected what can be drawn"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace azulejo
