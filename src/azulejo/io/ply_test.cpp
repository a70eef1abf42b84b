#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
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
using Indices = std::vector<std::uint32_t>;
using Bytes = std::vector<std::uint8_t>;
using Floats = std::vector<float>;

const std::string kVertex = "property float x\nproperty float y\nproperty float z\n";
const std::string kFace = "property list uchar int vertex_indices\n";

std::string text_file(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

Mesh quiet_mesh(const std::string& file) {
  Warnings warnings;
  Mesh mesh = mesh_of(file, "x.ply", {}, warnings.run());
  EXPECT_TRUE(warnings.lines.empty()) << warnings.lines.front();
  return mesh;
}

std::string warning_of(const std::string& file) {
  Warnings warnings;
  mesh_of(file, "x.ply", {}, warnings.run());
  EXPECT_EQ(warnings.lines.size(), 1U);
  return warnings.lines.empty() ? "" : warnings.lines.front();
}

std::string error_message(const std::string& file) {
  return error_of([&] { mesh_of(file, "x.ply"); });
}

/// The bytes of numbers, one behind the other, in an order of bytes.
class Binary {
 public:
  explicit Binary(std::endian order) : order_(order) {}
  template <class T>
  Binary& put(std::initializer_list<T> values) {
    for (const T value : values) {
      std::array<std::byte, sizeof(T)> bytes;
      store_number(bytes.data(), value, order_);
      text_.append(reinterpret_cast<const char*>(bytes.data()), sizeof(T));
    }
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::endian order_;
  std::string text_;
};

const std::string kSquareElements = "element vertex 4\n" + kVertex + "element face 2\n" + kFace;
const std::string kSquareBody = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

void expect_square(const Mesh& mesh) {
  EXPECT_EQ(listed(mesh.positions), (std::vector<Corner>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(listed(mesh.corners), (Indices{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(mesh.all_triangles());
}

TEST(Ply, Text) {
  const Mesh mesh = quiet_mesh(text_file(kSquareElements, kSquareBody));
  expect_square(mesh);
  EXPECT_EQ(mesh.space, Space{});
}

TEST(Ply, TextIsTakenInManyShapes) {
  const std::string file = text_file(kSquareElements, kSquareBody);
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = file;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
    return text;
  };
  expect_square(quiet_mesh("\n" + file));
  expect_square(quiet_mesh("\xEF\xBB\xBF" + file));
  expect_square(quiet_mesh(replaced("\n", "\r\n")));
  expect_square(quiet_mesh(replaced("\n", "\r")));
  expect_square(quiet_mesh(replaced("\n", " \n")));
  expect_square(quiet_mesh(replaced("3 0 1 2\n", "\n\n 3  0\t1 2 \n\n")));
  expect_square(quiet_mesh(replaced("element", "comment element x 99\nobj_info num_cols 5\nelement")));
  expect_square(quiet_mesh(replaced("3 0 1 2", "3 0.0 1. 2e0")));
  expect_square(quiet_mesh(replaced("float", "float32")));
  expect_square(quiet_mesh(replaced("uchar int vertex_indices", "int uint8 vertex_index")));
  expect_square(quiet_mesh(file.substr(0, file.size() - 1)));
}

TEST(Ply, BinaryOfBothOrdersAndAllTypes) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string format = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    const std::string header = "ply\nformat " + format +
                               " 1.0\nelement vertex 3\nproperty double x\nproperty short y\nproperty int8 z\n"
                               "element face 1\nproperty uint16 u16\nproperty list short ushort vertex_indices\n"
                               "property uint u32\nproperty int i32\nproperty char i8\nproperty uchar u8\n"
                               "property double f64\nend_header\n";
    Binary body(order);
    for (const int i : {0, 1, 2}) {
      body.put<double>({0.5 * i}).put<std::int16_t>({static_cast<std::int16_t>(-300 * i)});
      body.put<std::int8_t>({static_cast<std::int8_t>(-i)});
    }
    body.put<std::uint16_t>({65535}).put<std::int16_t>({3}).put<std::uint16_t>({2, 1, 0});
    body.put<std::uint32_t>({4000000000}).put<std::int32_t>({-70000}).put<std::int8_t>({-5}).put<std::uint8_t>({200});
    body.put<double>({0.25});
    const Mesh mesh = quiet_mesh(header + body.text());
    EXPECT_EQ(listed(mesh.positions), (std::vector<Corner>{{0, 0, 0}, {0.5F, -300, -1}, {1, -600, -2}}));
    EXPECT_EQ(listed(mesh.corners), (Indices{2, 1, 0}));
    EXPECT_EQ(values_of<std::uint32_t>(mesh, "u16"), Indices{65535});
    EXPECT_EQ(values_of<std::uint32_t>(mesh, "u32"), Indices{4000000000});
    EXPECT_EQ(values_of<float>(mesh, "i32"), Floats{-70000});
    EXPECT_EQ(values_of<float>(mesh, "i8"), Floats{-5});
    EXPECT_EQ(values_of<std::uint8_t>(mesh, "u8"), Bytes{200});
    EXPECT_EQ(values_of<float>(mesh, "f64"), Floats{0.25F});
    EXPECT_EQ(mesh.find("u8")->domain, Domain::Face);
    // The same with the line end of Windows behind the header, and data that begins with a line end.
    std::string windows = header;
    windows.replace(windows.size() - 1, 1, "\r\n");
    EXPECT_TRUE(same_mesh(quiet_mesh(windows + body.text()), mesh));
  }
}

TEST(Ply, DataMayBeginWithALineEnd) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "end_header\n";
  EXPECT_EQ(quiet_mesh(header + "\n\r\n").positions[0], Corner(10, 13, 10));
}

TEST(Ply, ElementsInAnyOrderAndUnknownOnes) {
  const std::string elements = "element face 1\n" + kFace +
                               "element odd 2\nproperty list uchar double a\nproperty list int short b\n"
                               "property char c\nelement nothing 3\nelement vertex 3\n" +
                               kVertex + "property list uchar int neighbors\nelement last 1\nproperty float q\n";
  const Mesh text =
      quiet_mesh(text_file(elements, "3 2 1 0\n2 1.5 2.5 0 7\n0 1 5 7\n0 0 0 1 5\n1 0 0 0\n0 1 0 2 3 4\n9\n"));
  EXPECT_EQ(listed(text.corners), (Indices{2, 1, 0}));
  EXPECT_EQ(text.positions[2], Corner(0, 1, 0));
  EXPECT_TRUE(text.attributes.empty());
  Binary body(std::endian::big);
  body.put<std::uint8_t>({3}).put<std::int32_t>({2, 1, 0});
  body.put<std::uint8_t>({2}).put<double>({1.5, 2.5}).put<std::int32_t>({0}).put<std::int8_t>({7});
  body.put<std::uint8_t>({0}).put<std::int32_t>({1}).put<std::int16_t>({5}).put<std::int8_t>({7});
  body.put<float>({0, 0, 0}).put<std::uint8_t>({1}).put<std::int32_t>({5});
  body.put<float>({1, 0, 0}).put<std::uint8_t>({0});
  body.put<float>({0, 1, 0}).put<std::uint8_t>({2}).put<std::int32_t>({3, 4}).put<float>({9});
  EXPECT_TRUE(
      same_mesh(quiet_mesh("ply\nformat binary_big_endian 1.0\n" + elements + "end_header\n" + body.text()), text));
}

TEST(Ply, PolygonsAndWhatIsNone) {
  const Mesh mesh = quiet_mesh(text_file("element vertex 4\n" + kVertex + "element face 4\n" + kFace,
                                         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n0\n2 0 1\n3 0 1 2\n"));
  EXPECT_EQ(listed(mesh.face_offsets), (Indices{0, 4, 4, 6, 9}));
  EXPECT_EQ(listed(mesh.corners), (Indices{0, 1, 2, 3, 0, 1, 0, 1, 2}));
}

TEST(Ply, KnownAttributesOfVertices) {
  const std::string elements = "element vertex 2\n" + kVertex +
                               "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
                               "property uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float s\n"
                               "property float t\nproperty float quality\nproperty int label\n";
  const Mesh mesh = quiet_mesh(text_file(elements,
                                         "0 0 0 0 0 1 255 128 0 7 0.25 0.25 0.5 -3\n"
                                         "1 0 0 0 1 0 1 2 3 4 0 1 0.75 9\n"));
  EXPECT_EQ(values_of<float>(mesh, "NORMAL"), (Floats{0, 0, 1, 0, 1, 0}));
  EXPECT_EQ(values_of<std::uint8_t>(mesh, "COLOR_0"), (Bytes{255, 128, 0, 7, 1, 2, 3, 4}));
  EXPECT_EQ(mesh.find("COLOR_0")->components, 4);
  EXPECT_EQ(values_of<float>(mesh, "TEXCOORD_0"), (Floats{0.25F, 0.75F, 0, 0}));
  EXPECT_EQ(values_of<float>(mesh, "quality"), (Floats{0.5F, 0.75F}));
  EXPECT_EQ(values_of<float>(mesh, "label"), (Floats{-3, 9}));
}

TEST(Ply, ColorsOfAllTypes) {
  const auto colored = [&](const std::string& type, const std::string& values) {
    return quiet_mesh(text_file("element vertex 1\n" + kVertex + "property " + type + " red\nproperty " + type +
                                    " green\nproperty " + type + " blue\n",
                                "0 0 0 " + values + "\n"));
  };
  EXPECT_EQ(values_of<std::uint8_t>(colored("ushort", "0 32896 65535"), "COLOR_0"), (Bytes{0, 128, 255}));
  EXPECT_EQ(values_of<std::uint8_t>(colored("int", "-4 128 300"), "COLOR_0"), (Bytes{0, 128, 255}));
  EXPECT_EQ(values_of<float>(colored("float", "0 0.5 1"), "COLOR_0"), (Floats{0, 0.5F, 1}));
}

TEST(Ply, NamesThatMeanSomethingElseHere) {
  const Mesh mesh = quiet_mesh(text_file(
      "element vertex 1\n" + kVertex + "property float NORMAL\nproperty uchar COLOR_0\nproperty float COLOR_x\n",
      "0 0 0 5 6 7\n"));
  EXPECT_EQ(mesh.find("NORMAL"), nullptr);
  EXPECT_EQ(values_of<float>(mesh, "ply_NORMAL"), Floats{5});
  EXPECT_EQ(values_of<std::uint8_t>(mesh, "ply_COLOR_0"), Bytes{6});
  EXPECT_EQ(values_of<float>(mesh, "COLOR_x"), Floats{7});
}

TEST(Ply, WedgeTextureCoordinates) {
  const std::string elements = kSquareElements + "property list uchar float texcoord\n";
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const Mesh mesh =
      quiet_mesh(text_file(elements, vertices + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0.25 0.5 0.75 0 1\n"));
  EXPECT_EQ(values_of<float>(mesh, "TEXCOORD_0"), (Floats{0, 1, 1, 1, 1, 0, 0, 0.75F, 0.5F, 0.25F, 0, 0}));
  EXPECT_EQ(mesh.find("TEXCOORD_0")->domain, Domain::Corner);
  EXPECT_EQ(warning_of(text_file(elements, vertices + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n")),
            "x.ply: face 1 has 0 texture coordinates for 3 corners: those of all faces are left out");
}

TEST(Ply, TriangleStrips) {
  const std::string elements =
      "element vertex 6\n" + kVertex + "element tristrips 2\nproperty list int int vertex_indices\n";
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
  const Mesh mesh = quiet_mesh(text_file(elements, vertices + "9 0 1 2 3 -1 2 3 4 5\n5 0 1 1 2 3\n"));
  EXPECT_EQ(listed(mesh.corners), (Indices{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 1, 2, 3}));
}

TEST(Ply, EdgesAreLines) {
  const Mesh mesh =
      quiet_mesh(text_file("element vertex 3\n" + kVertex +
                               "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n",
                           "0 0 0\n1 0 0\n0 1 0\n0 1 9\n2 1 9\n"));
  EXPECT_EQ(listed(mesh.lines), (Indices{0, 1, 2, 1}));
  EXPECT_EQ(mesh.face_count(), 0U);
}

TEST(Ply, ValuesThatFloatsCantHold) {
  const std::string elements = "element vertex 1\n" + kVertex + "property int id\n";
  EXPECT_EQ(warning_of(text_file(elements, "0.1 0.2 0.3 16777217\n")),
            "x.ply: property id of element vertex: not all values of type int are kept exactly in 32-bit floats");
  EXPECT_EQ(values_of<float>(quiet_mesh(text_file(elements, "0.1 0.2 0.3 16777216\n")), "id"), Floats{16777216});
}

TEST(Ply, ErrorsSayWhere) {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const auto of_body = [&](const std::string& body) { return error_message(text_file(kSquareElements, body)); };
  EXPECT_EQ(of_body(vertices + "3 0 1 2\n3 0 2 4\n"), "x.ply: corner 5 names vertex 4, of 4 vertices");
  EXPECT_EQ(of_body(vertices + "3 0 1 2\n3 0 2 -1\n"), "x.ply: corner 5 names vertex 4294967295, of 4 vertices");
  EXPECT_EQ(of_body(vertices + "3 0 1 2\n3 0 2\n"),
            "x.ply: byte 191: the row ends, expected a value of property vertex_indices");
  EXPECT_EQ(of_body(vertices + "3 0 1 2\n300 0 2 3\n"),
            "x.ply: byte 189: a list of 300 values of property vertex_indices of element face");
  EXPECT_EQ(of_body(vertices + "3 0 1 2\n3 0 2 3 7\n"),
            "x.ply: byte 194: '7' behind the last value of a row of element face");
  EXPECT_EQ(of_body("0 0 0\n1 0 b\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"),
            "x.ply: byte 164: 'b', expected a value of property z");
  EXPECT_EQ(of_body(vertices + "3 0 1 2\n\n\n\n"),
            "x.ply: byte 189: the file ends too early: 1 of 2 rows of element face");
  EXPECT_EQ(warning_of(text_file(kSquareElements, kSquareBody + "3 0 1 2\n")),
            "x.ply: 1 lines behind the last element are not read");
  EXPECT_EQ(error_message("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
            "x.ply: element vertex has no properties x, y and z");
  EXPECT_EQ(error_message("ply\nformat asci 1.0\n"),
            "x.ply: byte 4: format 'asci', expected ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(error_message("ply\nformat ascii 1.0\nproperty float x\n"),
            "x.ply: byte 21: a property stands before the first element");
  EXPECT_EQ(error_message("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n"),
            "x.ply: byte 38: unknown type 'quad'");
  EXPECT_EQ(error_message("ply\nend_header\n"), "x.ply: byte 4: the header has no line \"format\"");
  EXPECT_EQ(warning_of("ply\nformat ascii 1.0\nend_header\n"), "x.ply: holds no vertices");
}

TEST(Ply, CountsAreNotTrusted) {
  const auto with_count = [&](const std::string& format, const std::string& count) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + count + "\n" + kVertex + "end_header\n0 0 0\n";
  };
  for (const char* format : {"ascii", "binary_little_endian"}) {
    for (const char* count : {"2000000000", "18446744073709551615"}) {
      EXPECT_NE(error_message(with_count(format, count)).find("the file ends too early"), std::string::npos);
    }
    EXPECT_NE(error_message(with_count(format, "99999999999999999999")).find("expected a number"), std::string::npos);
  }
  // Elements without properties take no room: any number of them is no work either.
  EXPECT_NE(warning_of("ply\nformat binary_little_endian 1.0\nelement x 18446744073709551615\nend_header\n"), "");
  const std::string lists =
      "ply\nformat binary_little_endian 1.0\nelement face 1\n"
      "property list int int vertex_indices\nend_header\n";
  EXPECT_NE(error_message(lists + "\xFF\xFF\xFF\x7F").find("the file ends too early"), std::string::npos);
  EXPECT_NE(error_message(lists + "\xFF\xFF\xFF\xFF").find("a list of -1 values"), std::string::npos);
}

Mesh rich_mesh(std::size_t vertices, std::size_t faces, bool triangles) {
  Mesh mesh = random_mesh(vertices, faces, triangles, 11);
  for (std::uint32_t i = 0; i < 50; ++i) mesh.lines.push_back(i);
  mesh.attributes.push_back(random_attribute<float>(mesh, "NORMAL", Domain::Vertex, 3, 1));
  mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Vertex, 4, 2));
  mesh.attributes.push_back(random_attribute<float>(mesh, "quality", Domain::Vertex, 1, 4));
  mesh.attributes.push_back(random_attribute<std::uint32_t>(mesh, "label", Domain::Vertex, 1, 5));
  mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Face, 3, 6));
  mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "flags", Domain::Face, 1, 7));
  mesh.attributes.push_back(random_attribute<float>(mesh, "TEXCOORD_0", Domain::Corner, 2, 3));
  return mesh;
}

TEST(Ply, IsReadBackAsWritten) {
  for (const bool triangles : {false, true}) {
    const Mesh mesh = rich_mesh(700, 30'000, triangles);
    for (const bool ascii : {false, true}) {
      for (const int threads : {1, 2, 7}) {
        azulejo::Run run;
        run.threads = threads;
        const std::string file = text_of(encode_model(mesh, "ply", {.ascii = ascii}, run));
        EXPECT_TRUE(same_mesh(mesh_of(file, "x.ply", {}, run), mesh)) << ascii << " " << threads;
      }
    }
  }
}

TEST(Ply, VertexTextureCoordinatesAreReadBack) {
  Mesh mesh = random_mesh(300, 0, true, 12);
  mesh.attributes.push_back(random_attribute<float>(mesh, "TEXCOORD_0", Domain::Vertex, 2, 1));
  mesh.attributes.push_back(random_attribute<float>(mesh, "COLOR_0", Domain::Vertex, 3, 2));
  std::swap(mesh.attributes[0], mesh.attributes[1]);  // the order in which they are found
  EXPECT_TRUE(same_mesh(quiet_mesh(text_of(encode_model(mesh, "ply"))), mesh));
}

TEST(Ply, LongFacesAreReadBack) {
  Mesh mesh = random_mesh(400, 2, false, 13);
  for (std::uint32_t i = 0; i < 400; ++i) mesh.corners.push_back(i);
  mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  EXPECT_TRUE(same_mesh(quiet_mesh(text_of(encode_model(mesh, "ply"))), mesh));
}

TEST(Ply, SpecialCoordinatesAreReadBack) {
  Mesh mesh;
  const float inf = std::numeric_limits<float>::infinity();
  mesh.positions = {{inf, -inf, -0.0F}, {1e-45F, 3.4028235e38F, 0.1F}};
  for (const bool ascii : {false, true}) {
    EXPECT_TRUE(same_mesh(quiet_mesh(text_of(encode_model(mesh, "ply", {.ascii = ascii}))), mesh));
  }
}

TEST(Ply, WhatItCantHoldIsSaid) {
  Mesh mesh = random_mesh(3, 1, true, 1);
  mesh.material = {0};
  mesh.attributes.push_back(random_attribute<float>(mesh, "NORMAL", Domain::Corner, 3, 1));
  mesh.attributes.push_back(random_attribute<float>(mesh, "TANGENT", Domain::Vertex, 4, 1));
  Warnings warnings;
  const std::string file = text_of(encode_model(mesh, "ply", {}, warnings.run()));
  EXPECT_EQ(warnings.lines, (std::vector<std::string>{"ply: PLY holds no NORMAL of corners; it is left out",
                                                      "ply: PLY holds no materials; they are left out"}));
  EXPECT_EQ(values_of<float>(quiet_mesh(file), "TANGENT_3").size(), 3U);
}

}  // namespace
}  // namespace azulejo
