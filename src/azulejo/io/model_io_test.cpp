#include "azulejo/io/model_io.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/input.h"
#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/model_testing.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, gone at its end.
class ModelIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("azulejo_model_io_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  std::string write_packed(const std::string& name, const std::string& text) const {
    const gzFile file = gzopen(path(name).c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path(name);
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path folder_;
};

Mesh mesh_at(const std::string& path) { return std::get<Mesh>(read_model(path)); }

std::string file_of(const std::string& format) { return text_of(encode_model(random_mesh(20, 30, true, 1), format)); }

TEST_F(ModelIo, WritesBesideAndRenames) {
  const Mesh mesh = random_mesh(20, 30, true, 1);
  write_model(mesh, path("a.ply"));
  write_model(mesh, path("a.PLY"), {.ascii = true});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.PLY", "a.ply"}));
  EXPECT_TRUE(same_mesh(mesh_at(path("a.ply")), mesh));
  EXPECT_TRUE(same_mesh(mesh_at(path("a.PLY")), mesh));
  EXPECT_EQ(kind_of_error([&] { write_model(mesh, path("missing/a.ply")); }), Error::Io);
}

TEST_F(ModelIo, IsRecognizedByBytesAndNotByName) {
  for (const char* format : {"ply", "off", "stl"}) {
    const std::string file = file_of(format);
    for (const char* name : {"a.stl", "a.off", "a", "a.png"}) {
      EXPECT_EQ(mesh_at(write(name, file)).face_count(), 30U) << format << " as " << name;
    }
    EXPECT_EQ(mesh_at(write_packed("a.gz", file)).face_count(), 30U) << format;
  }
}

TEST_F(ModelIo, WhatIsNoModelIsSaid) {
  EXPECT_EQ(error_of([&] { read_model(write("a.ply", "")); }), path("a.ply") + ": byte 0: the file is empty");
  EXPECT_EQ(error_of([&] { read_model(write("a.ply", "plyx")); }),
            path("a.ply") + ": byte 0: a file of format ply doesn't begin like this");
  EXPECT_EQ(kind_of_error([&] { read_model(write("a.xyz", "1 2 3\n")); }), Error::Unsupported);
  EXPECT_EQ(kind_of_error([&] { read_model(path("missing.ply")); }), Error::Io);
  EXPECT_EQ(kind_of_error([&] { read_model(folder_.string()); }), Error::Io);
  EXPECT_EQ(error_of([&] { read_model(write("a.ply.gz", "\x1F\x8B nonsense")); }).find(path("a.ply.gz") + ": byte "),
            0U);
}

TEST_F(ModelIo, ModelsAndImagesAreToldApart) {
  for (const char* format : {"ply", "off", "stl"}) {
    EXPECT_TRUE(is_model_file(write("a.bin", file_of(format)))) << format;
    EXPECT_TRUE(is_model_file(write(std::string("a.") + format, "damaged"))) << "by its ending";
  }
  EXPECT_TRUE(is_model_file(write_packed("a.ply.gz", file_of("ply"))));
  EXPECT_TRUE(is_model_file(write_packed("a.stl.gz", file_of("stl")))) << "by its ending below .gz";
  const Image image = random_image({7, 5, 3, PixelType::U8, ColorState::Srgb, AlphaState::None}, 1);
  for (const char* format : {"png", "jpg", "tif", "exr", "ppm", "hdr", "webp", "bmp", "tga"}) {
    const std::vector<std::byte> bytes = encode_image(image, format);
    EXPECT_FALSE(is_model_file(write(std::string("a.") + format, text_of(bytes)))) << format;
    EXPECT_EQ(is_model_file(write("a.xyz", text_of(bytes))), false) << format;
  }
  EXPECT_FALSE(is_model_file(write("a.txt", "hello")));
  EXPECT_EQ(kind_of_error([&] { is_model_file(path("missing.ply")); }), Error::Io);
}

TEST_F(ModelIo, WhatIsOpenIsLookedAtAndRead) {
  for (const char* format : {"ply", "off", "stl"}) {
    const std::string file = file_of(format);
    const auto input = memory_input(std::as_bytes(std::span(file)), "standard input");
    EXPECT_TRUE(is_model_file(*input)) << format;
    EXPECT_EQ(model_format(*input), format);
    EXPECT_EQ(std::get<Mesh>(read_model(input)).vertex_count(), std::get<Mesh>(read_model(input)).vertex_count());
  }
  EXPECT_EQ(open_input(write("a.ply", file_of("ply")), 1)->folder() + "/a.ply", path("a.ply"));
}

TEST_F(ModelIo, ObjWithoutAnEndingIsKnownByItsFirstLine) {
  const auto is_obj = [](const std::string& text) {
    return is_model_file(*memory_input(std::as_bytes(std::span(text)), "standard input"));
  };
  EXPECT_TRUE(is_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_TRUE(is_obj("# made by hand\r\n\r\n  mtllib a.mtl\r\n"));
  EXPECT_FALSE(is_obj("# nothing but this"));
  EXPECT_FALSE(is_obj("victory 1 2 3\n"));
  EXPECT_FALSE(is_obj("v"));
  EXPECT_FALSE(is_obj(""));
}

TEST_F(ModelIo, EndingsTellWhatIsWritten) {
  for (const char* name : {"a.ply", "b/a.STL", "a.off"}) EXPECT_TRUE(is_model_path(name)) << name;
  for (const char* name : {"a.png", "ply", "a.ply/b", "a.", ""}) EXPECT_FALSE(is_model_path(name)) << name;
  const Mesh mesh = random_mesh(3, 1, true, 1);
  EXPECT_EQ(error_of([&] { encode_model(mesh, "png"); }).find("png: models are not written as 'png'; expected one of "),
            0U);
  EXPECT_EQ(kind_of_error([&] { write_model(mesh, path("a")); }), Error::Argument);
  EXPECT_EQ(kind_of_error([&] { encode_model(scene_of(mesh.clone()), "stl"); }), Error::Argument);
}

TEST_F(ModelIo, OptionsSayTheSpace) {
  const std::string file = write("a.ply", file_of("ply"));
  EXPECT_EQ(mesh_at(file).space, Space{});
  const Model model = read_model(file, {.up = UpAxis::Z, .metres_per_unit = 0.5F});
  EXPECT_EQ(std::get<Mesh>(model).space, (Space{UpAxis::Z, 0.5F}));
}

class OpenBeside : public ModelIo {
 protected:
  void SetUp() override {
    ModelIo::SetUp();
    write("model/a b.png", "here");
    write("model/maps/c.png", "below");
    write("model/a%20c.png", "as it stands");
    write("other/secret.png", "outside");
    model_ = {open_input(write("model/m.obj", "v 0 0 0\n"), 1000), path("model")};
  }
  /// What the file holds, or "missing".
  std::string content(const std::string& name, const ModelReadOptions& options = {}) const {
    const auto input = open_beside(model_, name, options, {});
    return input == nullptr ? "missing" : text_of(input->read_all(1000));
  }
  ModelFile model_;
};

TEST_F(OpenBeside, NamesAsProgramsWriteThem) {
  EXPECT_EQ(content("a b.png"), "here");
  EXPECT_EQ(content("a%20b.png"), "here");
  EXPECT_EQ(content("a%20c.png"), "as it stands");
  EXPECT_EQ(content("maps/c.png"), "below");
  EXPECT_EQ(content("maps\\c.png"), "below");
  EXPECT_EQ(content("./maps/../maps//c.png"), "below");
  EXPECT_EQ(content(path("model/maps/c.png")), "below");
  for (const char* name : {"", "A b.png", "maps", "a%2", "%zz", ".", "maps/c.png/d", "a\nb", "a%00b"}) {
    EXPECT_EQ(content(name), "missing") << name;
  }
  EXPECT_EQ(content(std::string("a b.png\0", 8)), "missing");
  EXPECT_EQ(content(std::string(5000, 'x')), "missing");
}

TEST_F(OpenBeside, StaysInTheFolder) {
  fs::create_symlink(path("other"), path("model/link"));
  fs::create_symlink(path("other/secret.png"), path("model/link.png"));
  fs::create_symlink(path("model/maps"), path("model/inside"));
  fs::create_symlink(path("model/loop"), path("model/loop"));
  for (const std::string& name : {std::string("../other/secret.png"), std::string("..\\other\\secret.png"),
                                  std::string("%2e%2e/other/secret.png"), std::string("link/secret.png"),
                                  std::string("link.png"), path("other/secret.png"), std::string("../model.png"),
                                  std::string("../modelx/a"), std::string("/etc/passwd")}) {
    EXPECT_EQ(kind_of_error([&] { content(name); }), Error::Data) << name;
  }
  EXPECT_EQ(content("inside/c.png"), "below");
  EXPECT_EQ(content("loop"), "missing");
  EXPECT_EQ(content("../other/secret.png", {.outside = true}), "outside");
  EXPECT_EQ(content("link.png", {.outside = true}), "outside");
  EXPECT_EQ(content("../other/none.png", {.outside = true}), "missing");
}

TEST_F(OpenBeside, TheModelsFolderMayBeALink) {
  fs::create_symlink(path("model"), path("way"));
  model_.folder = path("way");
  EXPECT_EQ(content("maps/c.png"), "below");
  model_.folder = path("way/");
  EXPECT_EQ(content("maps/c.png"), "below");
  model_.folder = "";
  EXPECT_EQ(content("maps/c.png"), "missing") << "from memory, a model names no files";
}

}  // namespace
}  // namespace azulejo
