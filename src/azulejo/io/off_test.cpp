#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/model_testing.h"

namespace azulejo {
namespace {

using Corner = glm::vec3;
using Indices = std::vector<std::uint32_t>;
using Bytes = std::vector<std::uint8_t>;
using Floats = std::vector<float>;

Mesh quiet_mesh(const std::string& file) {
  Warnings warnings;
  Mesh mesh = mesh_of(file, "x.off", {}, warnings.run());
  EXPECT_TRUE(warnings.lines.empty()) << warnings.lines.front();
  return mesh;
}

std::string error_message(const std::string& file) {
  return error_of([&] { mesh_of(file, "x.off"); });
}

void expect_square(const Mesh& mesh) {
  EXPECT_EQ(listed(mesh.positions), (std::vector<Corner>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(listed(mesh.corners), (Indices{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(mesh.all_triangles());
}

const std::string kRows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

TEST(Off, HeadersInManyShapes) {
  for (const char* header : {"OFF\n4 2 0\n", "OFF 4 2 0\n", "OFF\n4 2\n", "OFF\n4 2 5 # edges\n",
                             "# first\n\n#second\nOFF # third\n\n4 2 0\n\n", "4 2 0\n", "nOFF\n3\n4 2 0\n",
                             "nOFF 3 4 2 0\n", "\n OFF\n4\n2\n"}) {
    SCOPED_TRACE(header);
    expect_square(quiet_mesh(header + kRows));
  }
}

TEST(Off, RowsInManyShapes) {
  std::string windows = "OFF\n4 2 0\n" + kRows;
  for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) windows.replace(at, 1, "\r\n");
  expect_square(quiet_mesh(windows));
  std::string macintosh = "OFF\n4 2 0\n" + kRows;
  std::replace(macintosh.begin(), macintosh.end(), '\n', '\r');
  expect_square(quiet_mesh(macintosh));
  expect_square(quiet_mesh("OFF\n4 2 0\n0 0 0#a\n# 9 9 9\n\n1 0 0 # b\n1 1 0 \n0 1 0\n#\n3 0 1 2#\n  # x\n3 0 2 3"));
}

TEST(Off, Polygons) {
  const Mesh mesh = quiet_mesh("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n2 0 1\n1 3\n");
  EXPECT_EQ(listed(mesh.face_offsets), (Indices{0, 4, 6, 7}));
}

TEST(Off, ColorsOfVertices) {
  const auto colors = [](const std::string& a, const std::string& b) {
    return values_of<std::uint8_t>(quiet_mesh("COFF\n2 0 0\n0 0 0 " + a + "\n1 0 0 " + b + "\n"), "COLOR_0");
  };
  EXPECT_EQ(colors("255 128 0 7", "1 2 3 4"), (Bytes{255, 128, 0, 7, 1, 2, 3, 4}));
  EXPECT_EQ(colors("255 128 0", "1 2 3"), (Bytes{255, 128, 0, 1, 2, 3}));
  EXPECT_EQ(colors("0.5 0 1 1.0", "1 0 0 0"), (Bytes{128, 0, 255, 255, 255, 0, 0, 0}));
  EXPECT_EQ(colors("1 0 0", "0 1 1"), (Bytes{255, 0, 0, 0, 255, 255})) << "reals written like integers";
  EXPECT_EQ(colors("255 128 0 7", "1 2 3"), (Bytes{255, 128, 0, 7, 1, 2, 3, 255})) << "no alpha: opaque";
  EXPECT_EQ(colors("9 9 9", "# none"), (Bytes{9, 9, 9, 255, 255, 255})) << "none: white";
}

TEST(Off, ColorsOfFaces) {
  const std::string vertices = "OFF\n3 3 0\n0 0 0\n1 0 0\n1 1 0\n";
  const Mesh mesh = quiet_mesh(vertices + "3 0 1 2\n3 0 1 2 10 20 30\n3 0 2 1 1 2 3 4 # and more\n");
  EXPECT_EQ(values_of<std::uint8_t>(mesh, "COLOR_0"), (Bytes{255, 255, 255, 255, 10, 20, 30, 255, 1, 2, 3, 4}));
  EXPECT_EQ(mesh.find("COLOR_0")->domain, Domain::Face);
  Warnings warnings;
  EXPECT_TRUE(mesh_of(vertices + "3 0 1 2 5\n3 0 1 2 7\n3 0 1 2\n", "x.off", {}, warnings.run()).attributes.empty());
  EXPECT_EQ(warnings.lines,
            std::vector<std::string>{
                "x.off: colors of a face that are numbers in a table are left out: the file doesn't have the table"});
}

TEST(Off, NormalsAndTextureCoordinates) {
  const Mesh mesh = quiet_mesh("STCNOFF\n2 0 0\n1 2 3 0 0 1 10 20 30 40 0.25 0.25\n4 5 6 0 1 0 1 2 3 4 0 1\n");
  EXPECT_EQ(values_of<float>(mesh, "NORMAL"), (Floats{0, 0, 1, 0, 1, 0}));
  EXPECT_EQ(values_of<float>(mesh, "TEXCOORD_0"), (Floats{0.25F, 0.75F, 0, 0}));
  EXPECT_EQ(values_of<std::uint8_t>(mesh, "COLOR_0"), (Bytes{10, 20, 30, 40, 1, 2, 3, 4}));
  EXPECT_EQ(values_of<float>(quiet_mesh("NOFF\n2 0 0\n1 2 3 0 0 1\n1 2 3\n"), "NORMAL"), (Floats{0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(values_of<float>(quiet_mesh("NCOFF\n1 0 0\n1 2 3 0 0 1 5 6 7\n"), "NORMAL"), (Floats{0, 0, 1}));
}

std::string big(std::int32_t value) {
  std::array<std::byte, 4> bytes;
  store_number(bytes.data(), value, std::endian::big);
  return text_of(bytes);
}
std::string big(float value) { return big(std::bit_cast<std::int32_t>(value)); }

TEST(Off, Binary) {
  const std::string file = "CNOFF BINARY\n" + big(2) + big(2) + big(0) + big(1.0F) + big(2.0F) + big(3.0F) + big(0.0F) +
                           big(0.0F) + big(1.0F) + big(0.5F) + big(1.0F) + big(0.0F) + big(1.0F) + big(4.0F) +
                           big(5.0F) + big(6.0F) + big(0.0F) + big(1.0F) + big(0.0F) + big(0.0F) + big(0.0F) +
                           big(0.0F) + big(1.0F) + big(3) + big(0) + big(1) + big(0) + big(0) + big(1) + big(1) +
                           big(3) + big(1.0F) + big(0.0F) + big(0.5F);
  const Mesh mesh = quiet_mesh(file);
  EXPECT_EQ(listed(mesh.positions), (std::vector<Corner>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(listed(mesh.face_offsets), (Indices{0, 3, 4}));
  EXPECT_EQ(values_of<float>(mesh, "NORMAL"), (Floats{0, 0, 1, 0, 1, 0}));
  EXPECT_EQ(values_of<std::uint8_t>(mesh, "COLOR_0"), (Bytes{128, 255, 0, 255, 0, 0, 0, 255}));
  EXPECT_EQ(listed(*mesh.attributes.back().get<std::uint8_t>()), (Bytes{255, 255, 255, 255, 0, 128}));
  for (std::size_t length = 14; length < file.size(); ++length) {
    EXPECT_NE(error_message(file.substr(0, length)), "") << length;
  }
}

TEST(Off, ErrorsSayWhere) {
  EXPECT_EQ(error_message("4OFF\n4 2 0\n"), "x.off: vertices of four coordinates, expected three");
  EXPECT_EQ(error_message("nOFF\n5\n4 2 0\n"), "x.off: vertices of 5 coordinates, expected three");
  EXPECT_EQ(kind_of_error([] { mesh_of("4OFF\n4 2 0\n", "x.off"); }), Error::Unsupported);
  EXPECT_EQ(error_message("OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n"), "x.off: byte 24: 'x', expected a coordinate");
  EXPECT_EQ(error_message("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"),
            "x.off: byte 33: the row ends, expected the number of a vertex");
  EXPECT_EQ(error_message("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            "x.off: corner 2 names vertex 3, of 3 vertices");
  EXPECT_EQ(error_message("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n300000 0 1 2\n"),
            "x.off: byte 34: a face of 300000 corners");
  EXPECT_EQ(error_message("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
            "x.off: byte 36: the file ends too early: 4 rows, expected 3 vertices and 2 faces");
  EXPECT_EQ(error_message("OFF\n3535235358 6 0\n0 0 0\n"),
            "x.off: byte 25: the file ends too early: 3535235358 vertices and 6 faces don't fit 6 bytes");
  EXPECT_EQ(error_message("OFF\n18446744073709551615 18446744073709551615 0\n0 0 0\n").find("x.off: byte"), 0U);
  EXPECT_EQ(error_message("OFF\nmany 6 0\n"), "x.off: byte 8: 'many', expected the number of vertices");
}

TEST(Off, IsReadBackAsWritten) {
  for (const bool triangles : {false, true}) {
    Mesh mesh = random_mesh(40'000, 60'000, triangles, 21);
    mesh.attributes.push_back(random_attribute<float>(mesh, "NORMAL", Domain::Vertex, 3, 1));
    mesh.attributes.push_back(random_attribute<float>(mesh, "TEXCOORD_0", Domain::Vertex, 2, 2));
    mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Vertex, 4, 3));
    mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Face, 3, 4));
    for (const int threads : {1, 2, 7}) {
      azulejo::Run run;
      run.threads = threads;
      EXPECT_TRUE(same_mesh(mesh_of(text_of(encode_model(mesh, "off", {}, run)), "x.off", {}, run), mesh)) << threads;
    }
  }
}

TEST(Off, LinearColorsBecomeShades) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}};
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 4, Array<float>{1, 0.21404114F, -1, 0.5F}});
  EXPECT_EQ(values_of<std::uint8_t>(quiet_mesh(text_of(encode_model(mesh, "off"))), "COLOR_0"),
            (Bytes{255, 128, 0, 128}));
}

TEST(Off, WhatItCantHoldIsSaid) {
  Mesh mesh = random_mesh(3, 1, true, 1);
  mesh.lines = {0, 1};
  mesh.attributes.push_back(random_attribute<float>(mesh, "quality", Domain::Vertex, 1, 1));
  Warnings warnings;
  encode_model(mesh, "off", {}, warnings.run());
  EXPECT_EQ(warnings.lines, (std::vector<std::string>{"off: OFF holds no attribute quality (vertex); left out",
                                                      "off: OFF holds no lines; left out"}));
}

}  // namespace
}  // namespace azulejo
