#include "azulejo/io/stl.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
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

std::string little(std::uint32_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255);
  return text;
}

std::string little(const Corner& vector) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) text += little(std::bit_cast<std::uint32_t>(vector[axis]), 4);
  return text;
}

struct Facet {
  Corner normal;
  Corner a;
  Corner b;
  Corner c;
  std::uint32_t attribute = 0;
};

std::string binary(const std::vector<Facet>& facets, const std::string& header = "made by hand") {
  std::string text = header;
  text.resize(80, ' ');
  text += little(static_cast<std::uint32_t>(facets.size()), 4);
  for (const Facet& f : facets)
    text += little(f.normal) + little(f.a) + little(f.b) + little(f.c) + little(f.attribute, 2);
  return text;
}

/// Two triangles over a unit square that share an edge.
std::vector<Facet> square() {
  return {{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 1}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
}

const char kSquareText[] =
    "solid a square \n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 1 0\n  endloop\n"
    " endfacet\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 1 0\n   vertex 0 1 0\n  endloop\n"
    " endfacet\nendsolid a square\n";

void expect_square(const Mesh& mesh) {
  EXPECT_EQ(listed(mesh.positions), (std::vector<Corner>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(listed(mesh.corners), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(mesh.all_triangles());
}

Mesh quiet_mesh(const std::string& file, const ModelReadOptions& options = {}) {
  Warnings warnings;
  Mesh mesh = mesh_of(file, "x.stl", options, warnings.run());
  EXPECT_TRUE(warnings.lines.empty()) << warnings.lines.front();
  return mesh;
}

/// The warning that reading gives: exactly one.
std::string warning_of(const std::string& file) {
  Warnings warnings;
  mesh_of(file, "x.stl", {}, warnings.run());
  EXPECT_EQ(warnings.lines.size(), 1U);
  return warnings.lines.empty() ? "" : warnings.lines.front();
}

std::string error_message(const std::string& file) {
  return error_of([&] { mesh_of(file, "x.stl"); });
}

TEST(Stl, BinaryAndTextAreTheSameMesh) {
  expect_square(quiet_mesh(binary(square())));
  const Mesh text = quiet_mesh(kSquareText);
  expect_square(text);
  EXPECT_EQ(text.name, "a square");
  EXPECT_EQ(text.space.up, UpAxis::Z);
  EXPECT_EQ(text.space.metres_per_unit, 0);
}

TEST(Stl, OptionsSayTheSpace) {
  const Mesh mesh = quiet_mesh(kSquareText, {.up = UpAxis::Y, .metres_per_unit = 0.001F});
  EXPECT_EQ(mesh.space, (Space{UpAxis::Y, 0.001F}));
}

TEST(Stl, WithoutWeldingCornersAreVertices) {
  const Mesh mesh = quiet_mesh(binary(square()), {.weld = false});
  EXPECT_EQ(mesh.vertex_count(), 6U);
  EXPECT_EQ(listed(mesh.corners), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Stl, TextIsTakenInAnyShape) {
  const std::string square(kSquareText);
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = square;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
    return text;
  };
  expect_square(quiet_mesh(replaced("\n", "\r\n")));
  expect_square(quiet_mesh(replaced("\n", "\r")));
  expect_square(quiet_mesh(replaced("\n", "\n\n\t ")));
  expect_square(quiet_mesh(replaced(" ", " \t ")));
  expect_square(quiet_mesh("\xEF\xBB\xBF" + square));
  expect_square(quiet_mesh("\n  " + square));
  expect_square(quiet_mesh(replaced("endfacet", "end facet")));
  expect_square(quiet_mesh(replaced("endloop", "END LOOP")));
  expect_square(quiet_mesh(replaced("outer loop\n", "")));
  expect_square(quiet_mesh(replaced("normal 0 0 1", "")));
  expect_square(quiet_mesh(replaced("vertex 1 1 0", "vertex +1. 10e-1 -0.0")));
  expect_square(quiet_mesh(square.substr(0, square.size() - 1)));
  expect_square(quiet_mesh(replaced("endsolid a square\n", "endsolid")));
  std::string upper = square;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
  expect_square(quiet_mesh(upper));
  std::string one_line = square;
  std::replace(one_line.begin() + 16, one_line.end(), '\n', ' ');
  expect_square(quiet_mesh(one_line));
}

TEST(Stl, SolidsAreJoined) {
  const std::string two = std::string(kSquareText) + "solid\nendsolid\n" + std::string(kSquareText);
  const Mesh mesh = quiet_mesh(two);
  EXPECT_EQ(mesh.face_count(), 4U);
  EXPECT_EQ(mesh.vertex_count(), 4U);
  EXPECT_EQ(mesh.name, "a square");
  EXPECT_EQ(quiet_mesh("solid nothing\nendsolid nothing\n").vertex_count(), 0U);
  EXPECT_EQ(quiet_mesh("solid facet normal vertex 1 2 3\nendsolid facet\n").face_count(), 0U);
}

TEST(Stl, PolygonsInTextBecomeFans) {
  const std::string quad =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n"
      "endsolid\n";
  expect_square(quiet_mesh(quad));
}

TEST(Stl, BinaryThatBeginsWithSolid) {
  expect_square(quiet_mesh(binary(square(), "solid model exported by a program")));
  // Even with bytes behind it, as long as it doesn't look like text.
  const std::string longer = binary(square(), "solid") + "x";
  EXPECT_NE(warning_of(longer).find("1 bytes behind the last triangle"), std::string::npos);
}

TEST(Stl, CountsThatAreNotTheTruth) {
  std::string file = binary(square());
  file.replace(80, 4, little(0, 4));
  EXPECT_EQ(warning_of(file), "x.stl: byte 80: counts 0 triangles, but has 2, which are read");
  file.replace(80, 4, little(~0U, 4));
  EXPECT_EQ(warning_of(file), "x.stl: byte 80: counts 4294967295 triangles, but has 2, which are read");
  file.replace(80, 4, little(3, 4));
  EXPECT_EQ(error_message(file), "x.stl: byte 184: the file ends too early: 2 triangles, expected 3");
  file.replace(80, 4, little(1, 4));
  EXPECT_EQ(warning_of(file), "x.stl: byte 134: 50 bytes behind the last triangle are not read");
}

TEST(Stl, ErrorsSayWhere) {
  EXPECT_EQ(error_message("x"),
            "x.stl: byte 1: the file ends too early: neither text that begins with \"solid\" nor the 84 bytes of a "
            "binary header");
  const std::string facet = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  EXPECT_EQ(error_message(facet + "vertex 1 one 0\n"), "x.stl: byte 71: 'one', expected a number");
  EXPECT_EQ(error_message(facet + "vertex 1 0,5 0\n"), "x.stl: byte 71: '0,5', expected a number");
  EXPECT_EQ(error_message(facet + "vertex 1 1\n"), "x.stl: byte 73: the file ends where a number is expected");
  EXPECT_EQ(error_message(facet + "endloop\nendfacet\n"), "x.stl: byte 78: a facet of 2 vertices, expected 3");
  EXPECT_EQ(error_message("solid\nfacets\n"), "x.stl: byte 6: 'facets', expected facet, solid or endsolid");
  EXPECT_NE(warning_of("solid\n").find("ends without endsolid"), std::string::npos);
}

TEST(Stl, NormalsThatPointTheOtherWay) {
  std::vector<Facet> facets = square();
  facets[1].normal = {0, 0, -1};
  EXPECT_EQ(warning_of(binary(facets)),
            "x.stl: 1 of 2 stored normals point against the winding of their triangles, which holds");
  facets[1].normal = {0, 0, 0};
  quiet_mesh(binary(facets));
  facets[1].normal = {std::numeric_limits<float>::quiet_NaN(), 0, -1};
  quiet_mesh(binary(facets));
}

TEST(Stl, ColorsOfViscam) {
  std::vector<Facet> facets = square();
  facets[0].attribute = 1U << 15 | 31U << 10 | 16U << 5 | 1U;  // red, green, blue from the top
  EXPECT_EQ(values_of<std::uint8_t>(quiet_mesh(binary(facets)), "COLOR_0"),
            (std::vector<std::uint8_t>{255, 131, 8, 255, 255, 255}));
  EXPECT_EQ(quiet_mesh(binary(facets)).find("COLOR_0")->domain, Domain::Face);
  facets[0].attribute = 31U;  // not valid
  EXPECT_EQ(quiet_mesh(binary(facets)).find("COLOR_0"), nullptr);
}

TEST(Stl, ColorsOfMaterialise) {
  const std::string header = "part COLOR=\x10\x20\x30\x40,MATERIAL=";
  std::vector<Facet> facets = square();
  EXPECT_EQ(values_of<std::uint8_t>(quiet_mesh(binary(facets, header)), "COLOR_0"),
            (std::vector<std::uint8_t>{16, 32, 48, 16, 32, 48}));
  facets[0].attribute = 31U << 10 | 16U << 5 | 1U;  // blue, green, red from the top
  facets[1].attribute = 1U << 15;                   // the object's
  EXPECT_EQ(values_of<std::uint8_t>(quiet_mesh(binary(facets, header)), "COLOR_0"),
            (std::vector<std::uint8_t>{8, 131, 255, 16, 32, 48}));
}

TEST(Stl, MoreThanMemoryHoldsIsRefused) {
  azulejo::Run run;
  run.limits.memory_bytes = 200;
  EXPECT_EQ(kind_of_error([&] { mesh_of(binary(square()), "x.stl", {}, run); }), Error::Resource);
  run.limits.memory_bytes = 300;
  expect_square(mesh_of(binary(square()), "x.stl", {}, run));
}

TEST(Stl, IsReadBackAsWritten) {
  for (const bool ascii : {false, true}) {
    Mesh mesh = random_mesh(700, 40'000, true, 3);
    if (!ascii) {
      mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Face, 3, 4));
      for (std::uint8_t& value : std::get<Array<std::uint8_t>>(mesh.attributes[0].values)) {
        value = static_cast<std::uint8_t>(value / 8 * 255 / 31);  // as 5 bits hold it
      }
    }
    const std::string first = text_of(encode_model(mesh, "stl", {.ascii = ascii}));
    const Mesh read = quiet_mesh(first);
    EXPECT_EQ(read.face_count(), mesh.face_count());
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
      ASSERT_EQ(read.positions[read.corners[i]], mesh.positions[mesh.corners[i]]) << i;
    }
    // Vertices are in the order of their first use now, so a second time changes nothing.
    EXPECT_EQ(text_of(encode_model(read, "stl", {.ascii = ascii})), first);
    EXPECT_TRUE(ascii || values_of<std::uint8_t>(read, "COLOR_0") == values_of<std::uint8_t>(mesh, "COLOR_0"));
  }
}

TEST(Stl, ThreadsDontMatter) {
  const Mesh mesh = random_mesh(70'000, 200'000, true, 5);
  for (const bool ascii : {false, true}) {
    std::vector<std::string> files;
    std::vector<Mesh> meshes;
    for (const int threads : {1, 2, 7}) {
      azulejo::Run run;
      run.threads = threads;
      files.push_back(text_of(encode_model(mesh, "stl", {.ascii = ascii}, run)));
      meshes.push_back(mesh_of(files[0], "x.stl", {}, run));
    }
    EXPECT_TRUE(files[0] == files[1] && files[0] == files[2]);
    EXPECT_TRUE(same_mesh(meshes[0], meshes[1]));
    EXPECT_TRUE(same_mesh(meshes[0], meshes[2]));
  }
}

TEST(Stl, WrittenNormalsAreOfUnitLength) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1e-20F, 0, 0}, {0, 1e-20F, 0}, {3e18F, 0, 0}, {0, 0, 2e18F}};
  mesh.corners = {0, 1, 2, 0, 4, 3, 0, 1, 1};
  const std::string file = text_of(encode_model(mesh, "stl"));
  const auto normal = [&](std::size_t triangle) {
    const std::byte* const bytes = bytes_of(file).data() + 84 + 50 * triangle;
    const auto number = [&](int i) { return load_number<float>(bytes + 4 * i, std::endian::little); };
    return Corner(number(0), number(1), number(2));
  };
  EXPECT_EQ(normal(0), Corner(0, 0, 1));
  EXPECT_EQ(normal(1), Corner(0, 1, 0));
  EXPECT_EQ(normal(2), Corner(0, 0, 0));
}

TEST(Stl, FacesAreWrittenAsFans) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2, 3, 0, 1};
  mesh.face_offsets = {0, 4, 6};
  Warnings warnings;
  const std::string file = text_of(encode_model(mesh, "stl", {}, warnings.run()));
  EXPECT_EQ(warnings.lines, std::vector<std::string>{"stl: 1 faces of fewer than three corners are left out"});
  expect_square(quiet_mesh(file));
}

TEST(Stl, SoupsUseTheirMemoryAgain) {
  const auto folder = std::filesystem::temp_directory_path() / ("azulejo_stl_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "a.stl").string();
  for (const bool ascii : {false, true}) {
    std::ofstream(path, std::ios::binary) << (ascii ? std::string(kSquareText) : binary(square()));
    Array<glm::vec3> corners(100);
    const glm::vec3* const memory = corners.data();
    read_stl_soup(path, corners);
    EXPECT_EQ(corners.data(), memory);
    EXPECT_EQ(listed(corners), (std::vector<Corner>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace azulejo
