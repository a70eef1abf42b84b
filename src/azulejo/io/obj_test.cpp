// What OBJ files say, against what is made of it.

#include "azulejo/io/obj.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "azulejo/data/no_material.h"
#include "azulejo/io/io_testing.h"
#include "azulejo/io/obj_parse.h"

namespace azulejo {
namespace {

Scene read(const std::string& text, const azulejo::Run& run = {}) {
  return std::get<Scene>(read_model(as_bytes(text), "test.obj", {}, run));
}

/// The only mesh of a text.
const Mesh& only(const Scene& scene) {
  EXPECT_EQ(scene.meshes.size(), 1U);
  return *scene.meshes.at(0);
}

std::string message_of(const std::string& text) {
  try {
    read(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Data);
    return error.what();
  }
  ADD_FAILURE() << "no error was thrown";
  return {};
}

template <class T>
std::vector<T> values(const Array<T>& array) {
  return {array.begin(), array.end()};
}

std::vector<float> floats(const Mesh& mesh, const char* name, Domain domain) {
  const Attribute* const found = mesh.find(name);
  if (found == nullptr || found->domain != domain) return {};
  return values(*found->get<float>());
}

using Numbers = std::vector<std::uint32_t>;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, AnUnknownMaterialIsGrayUnlessVerticesHaveColors) {
  EXPECT_EQ(read(kSquare + "usemtl lost\nf 1 2 3 4\n").materials.at(0).base_color, kNoMaterialColor);
  EXPECT_EQ(read("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nusemtl lost\nf 1 2 3\n").materials.at(0).base_color,
            glm::vec4(1));
}

TEST(Obj, FacesHaveAnyNumberOfCorners) {
  const Scene triangles = read(kSquare + "f 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(values(only(triangles).corners), (Numbers{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(only(triangles).all_triangles());
  EXPECT_TRUE(only(triangles).material.empty());
  EXPECT_TRUE(only(triangles).attributes.empty());
  EXPECT_EQ(only(triangles).positions[2], glm::vec3(1, 1, 0));
  const Scene polygons = read(kSquare + "f 1 2 3 4\nf 1 2 3\n");
  EXPECT_EQ(values(only(polygons).face_offsets), (Numbers{0, 4, 7}));
  const Scene forward = read("f 1 2 3\n" + kSquare);
  EXPECT_EQ(values(only(forward).corners), (Numbers{0, 1, 2})) << "vertices may follow";
}

TEST(Obj, CornersInAllForms) {
  const std::string lists = kSquare + "vt 0.25 0.25\nvt 0.5 1\nvn 0 0 1\nvn 0 1 0\n";
  const Scene both = read(lists + "f 1/1/1 2/2/1 3/1/2 4/2/2\n");
  EXPECT_EQ(floats(only(both), "TEXCOORD_0", Domain::Vertex),
            (std::vector<float>{.25F, .75F, .5F, 0, .25F, .75F, .5F, 0}))
      << "v counts down";
  EXPECT_EQ(floats(only(both), "NORMAL", Domain::Vertex), (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0}));
  const Scene normals = read(lists + "f 1//1 2//1 3//2\nf 1//2 3//2 4//2\n");
  EXPECT_EQ(only(normals).find("TEXCOORD_0"), nullptr);
  EXPECT_EQ(floats(only(normals), "NORMAL", Domain::Corner),
            (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}))
      << "vertex 1 has two";
  const Scene empty = read(lists + "f 1// 2// 3//\nf 1/ 3/ 4/\n");
  EXPECT_TRUE(only(empty).attributes.empty());
  EXPECT_EQ(only(empty).face_count(), 2U);
  const Scene mixed = read(lists + "f 1/1 2 3/2\n");
  EXPECT_EQ(floats(only(mixed), "TEXCOORD_0", Domain::Vertex), (std::vector<float>{.25F, .75F, 0, 0, .5F, 0, 0, 0}))
      << "zeros where a corner names none";
  const Scene negative = read(lists + "f -4/-2/-2 -3/-1/-2 -2/-2/-1 -1/-1/-1\n");
  EXPECT_EQ(values(only(negative).corners), values(only(both).corners));
  EXPECT_EQ(floats(only(negative), "NORMAL", Domain::Vertex), floats(only(both), "NORMAL", Domain::Vertex));
}

TEST(Obj, NegativeIndicesCountFromWhereTheyStand) {
  const Scene scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nf -3 -2 -1\n");
  EXPECT_EQ(values(only(scene).corners), (Numbers{0, 1, 2, 1, 2, 3}));
}

TEST(Obj, LayoutDoesNotMatter) {
  const Scene plain = read(kSquare + "f 1 2 3 4\n");
  for (const std::string& text : {
           std::string("v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n"),
           std::string("v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4"),
           "\xEF\xBB\xBF# a mark first\n\n  \t\n" + kSquare + "f 1 2 3 4 # a square",
           std::string("  v\t0  0 0 \n v 1 0 0\nv 1 1 0#c\nv 0 1 0\n\tf \t1 2 3 4 "),
           std::string("v 0 \\\n0 0\nv 1 0\\\r\n 0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n 3 \\\n\\\n4\n"),
           std::string("# C:\\models\\\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\\"),
           std::string(3'000'000, '#') + "\n" + kSquare + "f 1 2 3 4\n",
       }) {
    const Scene scene = read(text);
    const std::string shown = text.substr(0, 80);
    EXPECT_EQ(values(only(scene).corners), values(only(plain).corners)) << shown;
    EXPECT_EQ(values(only(scene).positions), values(only(plain).positions)) << shown;
  }
}

TEST(Obj, Utf16IsConverted) {
  const std::string text = "o b\xC3\xBC\xF0\x9F\x98\x80x\n" + kSquare + "f 1 2 3 4";
  std::u16string wide = u"o b\u00FC\U0001F600x\n";
  for (const char c : kSquare + "f 1 2 3 4") wide += static_cast<char16_t>(c);
  for (const bool big : {false, true}) {
    std::string bytes = big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char16_t unit : wide) {
      const char high = static_cast<char>(unit >> 8);
      const char low = static_cast<char>(unit & 0xFF);
      bytes += big ? std::string{high, low} : std::string{low, high};
    }
    const Scene scene = read(bytes);
    EXPECT_EQ(only(scene).name, only(read(text)).name) << big;
    EXPECT_EQ(only(scene).face_count(), 1U);
  }
}

TEST(Obj, NumbersInAllForms) {
  Warnings warnings;
  const Scene scene =
      read("v 1 +2. -.5\nv 1e2 1E-2 +3.1e+2\nv nan inf -Inf\nv 1.#IND -1.#INF 1.#QNAN\n", warnings.run());
  const auto& at = only(scene).positions;
  EXPECT_EQ(at[0], glm::vec3(1, 2, -.5F));
  EXPECT_EQ(at[1], glm::vec3(100, .01F, 310));
  EXPECT_TRUE(std::isnan(at[2].x) && at[2].y > 1e38F && at[2].z < -1e38F);
  EXPECT_TRUE(std::isnan(at[3].x) && at[3].y < -1e38F && std::isnan(at[3].z));
  EXPECT_TRUE(warnings.lines.empty());
  read("v 1 2 3.1+e2\nv 3,5 1 2\n", warnings.run());
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_NE(warnings.lines[0].find("line 1: '3.1+e2'"), std::string::npos) << warnings.lines[0];
}

TEST(Obj, ColorsBecomeLinear) {
  const Scene scene = read("v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1\nv 0 1 0\n");
  const std::vector<float> colors = floats(only(scene), "COLOR_0", Domain::Vertex);
  ASSERT_EQ(colors.size(), 9U);
  EXPECT_NEAR(colors[1], 0.21404114, 1e-6) << "sRGB 0.5";
  EXPECT_NEAR(colors[5], 1, 1e-6);
  EXPECT_NEAR(colors[8], 1, 1e-6) << "white where none is given";
  const Scene bytes = read("v 0 0 0 255 127.5 0\nv 1 0 0 0 0 255\n");
  EXPECT_NEAR(floats(only(bytes), "COLOR_0", Domain::Vertex)[1], 0.21404114, 1e-6);
  EXPECT_EQ(only(read("v 0 0 0 1\n")).find("COLOR_0"), nullptr) << "a weight";
}

TEST(Obj, NormalsHaveUnitLength) {
  const Scene scene = read(kSquare + "vn 0 0 7\nvn 0 0 0\nvn 0.6 0.8 0\nf 1//1 2//2 3//3\n");
  EXPECT_EQ(floats(only(scene), "NORMAL", Domain::Vertex),
            (std::vector<float>{0, 0, 1, 0, 0, 0, .6F, .8F, 0, 0, 0, 0}));
}

TEST(Obj, LinesAndPoints) {
  const Scene lines = read(kSquare + "l 1 2 3\nl 4/1 1/2\nl 2\n");
  EXPECT_EQ(values(only(lines).lines), (Numbers{0, 1, 1, 2, 3, 0}));
  Warnings warnings;
  const Scene points = read(kSquare + "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 1 0\np 1 2\np -1\n", warnings.run());
  EXPECT_EQ(only(points).vertex_count(), 4U);
  EXPECT_EQ(only(points).face_count(), 0U);
  EXPECT_EQ(floats(only(points), "NORMAL", Domain::Vertex).size(), 12U) << "a normal a point";
  EXPECT_TRUE(warnings.lines.empty());
  read(kSquare + "f 1 2 3\np 4\n", warnings.run());
  EXPECT_EQ(warnings.lines.size(), 1U);
}

TEST(Obj, ObjectsBecomeMeshes) {
  const Scene scene = read(
      "v 0 0 0\nv 1 0 0\no first part\nv 0 1 0\nf 1 2 3\no empty\no second\nv 9 9 9\nv 8 8 8\nf 5 4 2\nf 4 5 2 1\n"
      "o cloud\nv 7 7 7\nv 6 6 6\np 6 7\no unused\nv 3 3 3\no third\nv 4 4 4\nl 9 1\n");
  ASSERT_EQ(scene.meshes.size(), 4U);
  ASSERT_EQ(scene.nodes.size(), 4U);
  EXPECT_EQ(scene.roots.size(), 4U);
  EXPECT_EQ(scene.meshes[0]->name, "first part");
  EXPECT_EQ(scene.nodes[0].name, "first part");
  EXPECT_EQ(values(scene.meshes[0]->corners), (Numbers{0, 1, 2}));
  EXPECT_EQ(scene.meshes[1]->name, "second");
  EXPECT_EQ(values(scene.meshes[1]->corners), (Numbers{3, 2, 1, 2, 3, 1, 0})) << "in the order of the file";
  EXPECT_EQ(values(scene.meshes[1]->face_offsets), (Numbers{0, 3, 7}));
  EXPECT_EQ(scene.meshes[1]->positions[2], glm::vec3(9));
  EXPECT_EQ(scene.meshes[2]->name, "cloud");
  EXPECT_EQ(scene.meshes[2]->vertex_count(), 2U);
  EXPECT_EQ(scene.meshes[3]->name, "third");
  EXPECT_EQ(values(scene.meshes[3]->lines), (Numbers{1, 0}));
  const Scene clouds = read("v 0 0 0\no a\nv 1 1 1\nv 2 2 2\no b\nv 3 3 3\no none\n");
  ASSERT_EQ(clouds.meshes.size(), 3U) << "without any elements";
  EXPECT_EQ(values(clouds.meshes[1]->positions), (std::vector<glm::vec3>{glm::vec3(1), glm::vec3(2)}));
}

TEST(Obj, AttributesOfObjectsAreTheirOwn) {
  const Scene scene =
      read(kSquare + "vt 0 1\nvt 1 1\nvt 0 0\no a\nf 1/1 2/2 3/3\no b\nf 2/1 3/2 4/3\nf 2/3 3/2 4/1\no c\nf 1 2 3\n");
  EXPECT_EQ(floats(*scene.meshes[0], "TEXCOORD_0", Domain::Vertex), (std::vector<float>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(floats(*scene.meshes[1], "TEXCOORD_0", Domain::Corner),
            (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 0}));
  EXPECT_EQ(scene.meshes[2]->find("TEXCOORD_0"), nullptr);
}

TEST(Obj, OneObjectKeepsAllVertices) {
  EXPECT_EQ(only(read("o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\ng x\nf 1 2 3\ng y\nf 1 3 2\n")).vertex_count(), 4U);
  EXPECT_EQ(only(read(kSquare)).vertex_count(), 4U) << "without elements a point cloud";
  EXPECT_EQ(only(read("o a\n" + kSquare)).name, "a");
}

TEST(Obj, FarApartVerticesAreRenumbered) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += fmt::format("v {} 0 0\n", i);
  const Scene scene = read(text + "o a\nf 5000 1 2500\no b\nf 2 3 4\n");
  EXPECT_EQ(values(scene.meshes[0]->corners), (Numbers{2, 0, 1}));
  EXPECT_EQ(scene.meshes[0]->positions[1].x, 2499);
  EXPECT_EQ(values(scene.meshes[1]->corners), (Numbers{0, 1, 2}));
}

TEST(Obj, SmoothingGroupsThatDifferAreKept) {
  const std::string two = "f 1 2 3\nf 1 3 4\n";
  EXPECT_EQ(only(read(kSquare + "s 1\n" + two)).find("SMOOTHING_GROUP"), nullptr);
  EXPECT_EQ(only(read(kSquare + "s off\n" + two)).find("SMOOTHING_GROUP"), nullptr);
  const Scene scene = read(kSquare + "f 1 2 4\ns 3\n" + two + "s off\nf 1 2 4\n");
  const Attribute* const groups = only(scene).find("SMOOTHING_GROUP");
  ASSERT_NE(groups, nullptr);
  EXPECT_EQ(groups->domain, Domain::Face);
  EXPECT_EQ(values(*groups->get<std::uint32_t>()), (Numbers{0, 3, 3, 0}));
}

TEST(Obj, FacesNameMaterials) {
  Warnings warnings;
  const Scene scene = read(kSquare +
                               "mtllib none.mtl\nf 1 2 3\nusemtl red paint\nf 1 3 4\nusemtl b\nf 1 2 4\nusemtl red "
                               "paint\nf 2 3 4\nusemtl\nf 2 3 1\n",
                           warnings.run());
  EXPECT_EQ(values(only(scene).material), (Numbers{MaterialId::kNone, 0, 1, 0, MaterialId::kNone}));
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.materials[0].name, "red paint");
  EXPECT_TRUE(scene.materials[0].double_sided);
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_NE(warnings.lines[0].find("none.mtl"), std::string::npos);
  const Scene objects = read(kSquare + "usemtl a\no x\nf 1 2 3\no y\nf 1 2 3\nusemtl b\no z\nf 1 2 4\n");
  EXPECT_EQ(values(objects.meshes[1]->material), (Numbers{0})) << "goes on into the next object";
  EXPECT_EQ(values(objects.meshes[2]->material), (Numbers{1}));
}

TEST(Obj, ErrorsNameTheLine) {
  EXPECT_EQ(message_of("v 0 0 0\nv 1 0 0\nv 0 1 0\r\n\r\nf 1 2 4\n"), "test.obj: line 5: vertex 4, of 3");
  EXPECT_EQ(message_of(kSquare + "f 1 2 4294967295\n"), "test.obj: line 5: vertex 4294967295, of 4");
  EXPECT_EQ(message_of(kSquare + "f 1 2 99999999999999999999999\n"),
            "test.obj: line 5: vertex 99999999999999999999999, of 4");
  EXPECT_EQ(message_of(kSquare + "f 1 2 -5\n"), "test.obj: line 5: vertex -5, of 4");
  EXPECT_EQ(message_of(kSquare + "f 1 2 -4294967296\n"), "test.obj: line 5: vertex -4294967296, of 4");
  EXPECT_EQ(message_of(kSquare + "f 1 2 9\nf 0 1 2\n"), "test.obj: line 5: vertex 9, of 4") << "the first";
  EXPECT_EQ(message_of(kSquare + "f 0 1 2\n"), "test.obj: line 5: vertex 0: they count from 1");
  EXPECT_EQ(message_of(kSquare + "vt 0 0\nf 1/1 2/2 3/1\n"), "test.obj: line 6: texture coordinate 2, of 1");
  EXPECT_EQ(message_of(kSquare + "f 1//1 2//1 3//1\n"), "test.obj: line 5: normal 1, of 0");
  EXPECT_EQ(message_of(kSquare + "l 1 9\n"), "test.obj: line 5: vertex 9, of 4");
  EXPECT_EQ(message_of(kSquare + "f 1 b 3\n"), "test.obj: line 5: 'b', the number of a vertex expected");
  EXPECT_EQ(message_of(kSquare + "f 1 2x 3\n"), "test.obj: line 5: 'x' behind a corner of a face");
  EXPECT_EQ(message_of("v 0 0\n"), "test.obj: line 1: v has 2 numbers, 3 expected");
  EXPECT_EQ(message_of("v 0 zero 0\n"), "test.obj: line 1: 'zero', a number expected");
  EXPECT_EQ(message_of("# nothing\n"), "test.obj: there are no vertices");
}

TEST(Obj, WhatIsSkippedIsSaidOnce) {
  Warnings warnings;
  const Scene scene =
      read(kSquare + "f 1 2\nf\nf 1 2 3\nvp 0 1\ncstype bezier\ndeg 3\nend\nfoo 1\nbar\nfoo 2\nlod 3\ng a b\n",
           warnings.run());
  EXPECT_EQ(only(scene).face_count(), 1U);
  ASSERT_EQ(warnings.lines.size(), 3U);
  EXPECT_EQ(warnings.lines[0], "test.obj: line 12: unknown statements are skipped: foo, bar");
  EXPECT_EQ(warnings.lines[1], "test.obj: curves and surfaces are skipped: 4 statements");
  EXPECT_EQ(warnings.lines[2], "test.obj: 2 faces of fewer than three corners are left out");
}

/// Vertices in rings with everything that counts across pieces: negative indices, objects, materials, groups.
std::string long_text() {
  std::string text = "mtllib x.mtl\n";
  for (int i = 0; i < 60'000; ++i) {
    if (i % 20'000 == 0) text += fmt::format("o part{}\n", i);
    text += fmt::format("v {} {} {}\nvt {} {}\nvn 0 {} 1\n", i * 0.37, i * -1.25e-3, i, i / 6e4, 1 - i / 6e4, i % 7);
    if (i < 3) continue;
    if (i % 5 == 0) text += fmt::format("usemtl m{}\ns {}\n", i % 3, i % 4);
    text += i % 2 == 0 ? fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", i + 1, i, i - 1)
                       : "f -1/-1/-1 -2/-2/-2 \\\n-3/-3/-3 -4/-4/-4\n";
  }
  return text;
}

TEST(Obj, PiecesJoinAndThreadsDoNotMatter) {
  const std::string text = long_text();
  ASSERT_GT(text.size(), std::size_t{4} << 20) << "several pieces";
  azulejo::Run one;
  one.threads = 1;
  const Scene first = read(text, one);
  ASSERT_EQ(first.meshes.size(), 3U);
  EXPECT_EQ(first.meshes[0]->face_count(), 19'997U);
  EXPECT_EQ(first.meshes[2]->face_count(), 20'000U);
  EXPECT_EQ(first.meshes[2]->positions.back(), glm::vec3(59'999 * 0.37F, 59'999 * -1.25e-3F, 59'999));
  const Mesh& last = *first.meshes[2];
  for (std::size_t f = 0; f < last.face_count(); f += 500) {
    // Face f of the last part is that of vertex 40,000 + f, which is its first corner.
    EXPECT_EQ(last.positions[last.corners[last.face_begin(f)]].z, static_cast<float>(40'000 + f));
  }
  for (const int threads : {2, 7}) {
    azulejo::Run run;
    run.threads = threads;
    const Scene again = read(text, run);
    for (std::size_t m = 0; m < first.meshes.size(); ++m) {
      const Mesh& a = *first.meshes[m];
      const Mesh& b = *again.meshes[m];
      EXPECT_EQ(values(a.positions), values(b.positions));
      EXPECT_EQ(values(a.corners), values(b.corners));
      EXPECT_EQ(values(a.face_offsets), values(b.face_offsets));
      EXPECT_EQ(values(a.material), values(b.material));
      ASSERT_EQ(a.attributes.size(), b.attributes.size());
      for (std::size_t i = 0; i < a.attributes.size(); ++i) EXPECT_EQ(a.attributes[i].values, b.attributes[i].values);
    }
  }
}

TEST(Obj, ErrorsInLaterPiecesNameTheLineToo) {
  std::string text;
  for (int i = 1; i <= 200'000; ++i) text += "v 1.25 2.5 3.75\n";
  EXPECT_EQ(message_of(text + "f -1 -2 -3\nf -1 -2 -200001\n"), "test.obj: line 200002: vertex -200001, of 200000");
}

TEST(Obj, HostileFilesStayWithinMemory) {
  std::string many = kSquare + "f";
  for (int i = 0; i < 1'000'000; ++i) many += " 1";
  EXPECT_EQ(only(read(many)).corner_count(), 1'000'000U);
  std::string objects = kSquare;
  for (int i = 0; i < 100'000; ++i) objects += "o\nf 1 2 3\n";
  azulejo::Run run;
  run.limits.memory_bytes = 1 << 24;
  EXPECT_EQ(kind_of_error([&] { read(objects, run); }), Error::Resource);
  std::string materials = kSquare;
  for (int i = 0; i < 100'000; ++i) materials += fmt::format("usemtl {}\nf 1 2 3\n", i);
  EXPECT_EQ(kind_of_error([&] { read(materials, run); }), Error::Resource);
  EXPECT_EQ(read(objects).meshes.size(), 100'000U);
}

}  // namespace
}  // namespace azulejo
