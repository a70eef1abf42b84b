// Every OBJ file of the shared set: what it gives, by its description, or why it is refused.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/shared_images_table.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

struct SharedObj {
  const char* path;
  std::size_t meshes;    ///< 0 where refused
  std::size_t vertices;  ///< of all meshes; of a file with several, those used, counted by each
  std::size_t faces;     ///< of three corners or more
  std::size_t lines;
  std::size_t materials;
  std::size_t images;  ///< textures that are there
  Outcome outcome;
};

// clang-format off
constexpr SharedObj kSharedObjs[] = {
    {"meshes/broken/box_UTF16BE.obj", 1, 8, 6, 0, 1, 0, Outcome::Clean},
    {"meshes/broken/box_longline.obj", 1, 8, 6, 0, 1, 0, Outcome::Clean},
    {"meshes/broken/box_without_lineending.obj", 1, 8, 6, 0, 1, 0, Outcome::Clean},
    {"meshes/broken/concave_polygon.obj", 1, 64, 1, 0, 1, 0, Outcome::Warned},
    {"meshes/broken/cube-vertexcol.obj", 1, 8, 6, 0, 3, 0, Outcome::Warned},
    {"meshes/broken/deg_faces.obj", 1, 6, 4, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/degenerate_mesh.obj", 1, 3, 1, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/eof_test.obj", 1, 3, 1, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/inf_nan.obj", 1, 3, 1, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/invalid-face-definition.obj", 1, 8, 0, 0, 1, 0, Outcome::Warned},
    {"meshes/broken/issue-140-zero-face-idx.obj", 0, 0, 0, 0, 0, 0, Outcome::Data},
    {"meshes/broken/issue-295-trianguation-failure.obj", 1, 16, 14, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/malformed.obj", 0, 0, 0, 0, 0, 0, Outcome::Data},
    {"meshes/broken/missing_material_file.obj", 8, 72, 18, 0, 5, 0, Outcome::Clean},
    {"meshes/broken/negative_indices.obj", 1, 8, 6, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/non_manifold_wrap.obj", 1, 10, 12, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/notenoughindices.obj", 1, 3, 1, 0, 1, 0, Outcome::Warned},
    {"meshes/broken/number_formats.obj", 1, 15, 1, 0, 0, 0, Outcome::Warned},
    {"meshes/broken/obj_points.obj", 1, 8, 0, 0, 0, 0, Outcome::Clean},
    {"meshes/broken/obj_wireframe.obj", 1, 8, 0, 12, 0, 0, Outcome::Clean},
    {"meshes/broken/polygonfaces.obj", 1, 5, 1, 0, 1, 0, Outcome::Warned},
    {"meshes/broken/test-nan.obj", 8, 72, 18, 0, 5, 0, Outcome::Warned},
    {"meshes/classic/cow.obj", 1, 2903, 5804, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/fandisk.obj", 1, 6475, 12946, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/human_man.obj", 1, 6890, 13776, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/penguin_control_mesh.obj", 1, 201, 221, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/rocker_arm.obj", 1, 10044, 20088, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/spot_control_mesh.obj", 1, 188, 180, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/spot_quadrangulated.obj", 1, 2930, 2928, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/spot_triangulated.obj", 1, 2930, 5856, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/suzanne.obj", 1, 507, 500, 0, 0, 0, Outcome::Clean},
    {"meshes/classic/utah_teapot.obj", 1, 3644, 6320, 0, 0, 0, Outcome::Clean},
    {"meshes/genus/torus_stein.obj", 1, 2304, 4608, 0, 0, 0, Outcome::Clean},
    {"meshes/multishell/groups.obj", 2, 1165, 2308, 0, 0, 0, Outcome::Clean},
    {"meshes/multishell/joined_tetrahedra.obj", 2, 8, 8, 0, 0, 0, Outcome::Clean},
    {"meshes/multishell/multiple_tetrahedrons.obj", 1, 20, 20, 0, 0, 0, Outcome::Clean},
    {"meshes/multishell/two_objects.obj", 2, 12, 16, 0, 0, 0, Outcome::Clean},
    {"meshes/scans/mountain_with_boundary.obj", 1, 25600, 50562, 0, 0, 0, Outcome::Clean},
    {"meshes/scans/skull_100k.obj", 1, 49999, 100002, 0, 0, 0, Outcome::Clean},
    {"meshes/scans/stanford_armadillo_86k.obj", 1, 43243, 86482, 0, 0, 0, Outcome::Clean},
    {"meshes/textured/bunny10k/bunny10k_textured.obj", 1, 5051, 9999, 0, 1, 1, Outcome::Clean},
    {"meshes/textured/capsule/capsule.obj", 1, 5252, 10200, 0, 1, 1, Outcome::Clean},
    {"meshes/textured/spider/spider.obj", 1, 762, 1368, 0, 5, 5, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_back.obj", 1, 4, 1, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_ceiling.obj", 1, 8, 2, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_floor.obj", 1, 12, 1, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_greenwall.obj", 1, 4, 1, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_largebox.obj", 1, 24, 12, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_luminaire.obj", 1, 4, 1, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_redwall.obj", 1, 4, 1, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_mitsuba/meshes/cbox_smallbox.obj", 1, 24, 12, 0, 0, 0, Outcome::Clean},
    {"scenes/cornell_box_obj/cornell_box.obj", 8, 72, 18, 0, 5, 0, Outcome::Clean},
    {"scenes/mitsuba/common/meshes/rectangle.obj", 1, 4, 2, 0, 0, 0, Outcome::Clean},
    {"scenes/mitsuba/common/meshes/sphere.obj", 1, 16258, 32512, 0, 0, 0, Outcome::Clean},
    {"scenes/veach_mis/floor.obj", 1, 12, 4, 0, 0, 0, Outcome::Clean},
    {"scenes/veach_mis/plate1.obj", 1, 6, 2, 0, 0, 0, Outcome::Clean},
    {"scenes/veach_mis/plate2.obj", 1, 6, 2, 0, 0, 0, Outcome::Clean},
    {"scenes/veach_mis/plate3.obj", 1, 6, 2, 0, 0, 0, Outcome::Clean},
    {"scenes/veach_mis/plate4.obj", 1, 6, 2, 0, 0, 0, Outcome::Clean},
};
// clang-format on

class SharedObjs : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder())) GTEST_SKIP() << "the shared sample files are not there: " << folder();
  }
  static fs::path folder() { return fs::path(AZULEJO_SOURCE_FOLDER).parent_path() / "shared" / "data"; }
  static Scene read(const std::string& path) { return std::get<Scene>(read_model((folder() / path).string())); }
};

void expect_as_listed(const SharedObj& row, const std::string& path) {
  Warnings warnings;
  const Scene scene = std::get<Scene>(read_model(path, {}, warnings.run()));
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t lines = 0;
  for (const auto& mesh : scene.meshes) {
    vertices += mesh->vertex_count();
    faces += mesh->face_count();
    lines += mesh->lines.size() / 2;
  }
  std::size_t images = 0;
  for (const Texture& each : scene.textures) images += each.image != nullptr ? 1 : 0;
  EXPECT_EQ(scene.meshes.size(), row.meshes);
  EXPECT_EQ(vertices, row.vertices);
  EXPECT_EQ(faces, row.faces);
  EXPECT_EQ(lines, row.lines);
  EXPECT_EQ(scene.materials.size(), row.materials);
  EXPECT_EQ(images, row.images);
  EXPECT_EQ(warnings.lines.empty(), row.outcome == Outcome::Clean) << (warnings.lines.empty() ? "" : warnings.lines[0]);
}

TEST_F(SharedObjs, EachGivesWhatIsListed) {
  for (const SharedObj& row : kSharedObjs) {
    SCOPED_TRACE(row.path);
    const std::string path = (folder() / row.path).string();
    if (row.outcome == Outcome::Data) {
      EXPECT_EQ(kind_of_error([&] { read(row.path); }), Error::Data);
    } else {
      expect_as_listed(row, path);
    }
  }
}

TEST_F(SharedObjs, NoneIsLeftOut) {
  std::set<std::string> listed;
  for (const SharedObj& row : kSharedObjs) listed.insert(row.path);
  for (const auto& entry : fs::recursive_directory_iterator(folder())) {
    if (entry.path().extension() != ".obj") continue;
    EXPECT_TRUE(listed.contains(fs::relative(entry.path(), folder()).generic_string())) << entry.path();
  }
}

TEST_F(SharedObjs, Utf16GivesWhatPlainTextGives) {
  const Scene wide = read("meshes/broken/box_UTF16BE.obj");
  const Scene plain = read("meshes/broken/box_without_lineending.obj");
  EXPECT_EQ(wide.meshes[0]->positions, plain.meshes[0]->positions);
  EXPECT_EQ(wide.meshes[0]->corners, plain.meshes[0]->corners);
  EXPECT_EQ(wide.meshes[0]->name, "1");
}

TEST_F(SharedObjs, MaterialsAreThoseOfTheFile) {
  const Scene box = read("scenes/cornell_box_obj/cornell_box.obj");
  ASSERT_EQ(box.materials.size(), 5U);
  EXPECT_EQ(box.meshes[4]->name, "green_wall");
  ASSERT_FALSE(box.meshes[4]->material.empty());
  EXPECT_EQ(box.materials[box.meshes[4]->material[0]].name, "green");
  EXPECT_EQ(box.materials[2].base_color, glm::vec4(0, 1, 0, 1));
  const Scene spider = read("meshes/textured/spider/spider.obj");
  for (const Material& each : spider.materials) EXPECT_TRUE(each.base_color_texture.texture) << each.name;
  const Scene capsule = read("meshes/textured/capsule/capsule.obj");
  EXPECT_EQ(capsule.materials[0].base_color.w, 1) << "Tr 1 is opaque";
  EXPECT_EQ(capsule.meshes[0]->find("TEXCOORD_0")->domain, Domain::Vertex);
}

}  // namespace
}  // namespace azulejo
