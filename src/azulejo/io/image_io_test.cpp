#include "azulejo/io/image_io.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/orientation.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, gone at its end.
class ImageIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("azulejo_image_io_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
  fs::path folder_;
};

Image rgb_image() { return random_image({19, 33, 3, PixelType::U8, ColorState::Srgb, AlphaState::None}, 4); }

/// An EXIF block that says an orientation.
std::vector<std::uint8_t> oriented(std::uint8_t orientation) {
  return {'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12, 1, 3, 0, 1, 0, 0, 0, orientation, 0, 0, 0, 0, 0, 0, 0};
}

TEST_F(ImageIo, WritesBesideAndRenames) {
  write_image(rgb_image(), path("a.png"));
  EXPECT_EQ(files(), std::vector<std::string>{"a.png"});
  EXPECT_TRUE(same_pixels(read_image(path("a.png")), rgb_image()));
}

TEST_F(ImageIo, NothingIsLeftOfAFileThatWasNotFinished) {
  const Image image = rgb_image();
  write_image(image, path("a.png"));
  {
    const auto sink = create_image(path("a.png"), image.info(), {});
    sink->write(image.any().crop({0, 0, image.width(), 10}));
    EXPECT_EQ(files().size(), 2U) << "the new file grows beside the old one";
    EXPECT_TRUE(same_pixels(read_image(path("a.png")), image)) << "which stays whole";
    EXPECT_EQ(kind_of_error([&] { sink->finish(); }), Error::Argument);
  }
  EXPECT_EQ(files(), std::vector<std::string>{"a.png"});
}

TEST_F(ImageIo, LinksAndPermissionsStay) {
  write_image(rgb_image(), path("real.png"));
  fs::permissions(path("real.png"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(path("real.png"), path("link.png"));
  const Image other = random_image({5, 5, 1}, 1);
  write_image(other, path("link.png"));
  EXPECT_TRUE(fs::is_symlink(path("link.png")));
  EXPECT_TRUE(same_pixels(read_image(path("real.png")), other));
  EXPECT_EQ(fs::status(path("real.png")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(ImageIo, LongNames) {
  const std::string name = std::string(250, 'n') + ".png";
  write_image(rgb_image(), path(name));
  EXPECT_EQ(files(), std::vector<std::string>{name});
}

TEST_F(ImageIo, SystemErrorsNameTheFile) {
  EXPECT_EQ(kind_of_error([&] { read_image(path("absent.png")); }), Error::Io);
  EXPECT_EQ(kind_of_error([&] { read_image(folder_.string()); }), Error::Io);
  EXPECT_EQ(kind_of_error([&] { write_image(rgb_image(), path("no/folder/a.png")); }), Error::Io);
  EXPECT_EQ(kind_of_error([&] { write_image(rgb_image(), path("a.xyz")); }), Error::Argument);
  EXPECT_EQ(kind_of_error([&] { write_image(Image(), path("a.png")); }), Error::Argument);
}

TEST_F(ImageIo, FilesAreRecognizedByTheirBytes) {
  write_image(rgb_image(), path("a.png"));
  fs::rename(path("a.png"), path("a.jpg"));
  EXPECT_EQ(image_file(path("a.jpg")).format, "png");
  std::ofstream(path("empty.png")).close();
  EXPECT_EQ(kind_of_error([&] { read_image(path("empty.png")); }), Error::Data);
  std::ofstream(path("words.png")) << "these are words and no picture at all";
  EXPECT_EQ(kind_of_error([&] { read_image(path("words.png")); }), Error::Data);
  std::ofstream(path("words.txt")) << "these are words and no picture at all";
  EXPECT_EQ(kind_of_error([&] { read_image(path("words.txt")); }), Error::Unsupported);
}

TEST_F(ImageIo, RowsOfASourceAreThoseOfTheImage) {
  for (const char* name : {"a.png", "a.ppm", "a.tif", "a.bmp"}) {
    write_image(rgb_image(), path(name));
    const Image whole = read_image(path(name));
    const auto source = open_image(path(name));
    EXPECT_EQ(source->info(), whole.info());
    for (int pass = 0; pass < 2; ++pass) {
      const auto reader = source->rows({});
      Image part(whole.info());
      for (const int y : {0, 1, 7, 20}) {  // rows between 2 and 7, 12 and 20 are passed over
        const Rect rows = {0, y, whole.width(), y == 0 ? 1 : y == 1 ? 1 : 5};
        reader->read(y, part.any().crop(rows));
        for (int row = y; row < rows.bottom(); ++row) {
          ASSERT_EQ(std::memcmp(part.any().row(row), whole.any().row(row), whole.info().row_bytes()), 0)
              << name << " pass " << pass << " row " << row;
        }
      }
    }
  }
}

TEST_F(ImageIo, ASourceWarnsOnceInAllItsPasses) {
  Image image = rgb_image();
  write_image(image, path("a.png"));
  std::string bytes(fs::file_size(path("a.png")), '\0');
  std::ifstream(path("a.png"), std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const std::string chunk("\0\0\0\1sRGB", 8);
  const std::size_t at = bytes.find(chunk);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 8] = 9;  // a rendering intent that isn't there; the checksum follows
  const std::string sum("\xD7\x12\xA4\x4D", 4);
  bytes.replace(at + 9, 4, sum);
  std::ofstream(path("b.png"), std::ios::binary) << bytes;
  Warnings warnings;
  const auto source = open_image(path("b.png"), {}, warnings.run());
  Image rows(source->info());
  for (int pass = 0; pass < 3; ++pass) source->rows(warnings.run())->read(0, rows.any());
  EXPECT_EQ(warnings.lines.size(), 1U);
}

TEST_F(ImageIo, AllOrientationsStandUpright) {
  // The upright image counts 1–6 along its rows; what each orientation stores is from the table of the standard.
  const std::map<int, std::pair<int, std::vector<std::uint8_t>>> stored = {
      {1, {3, {1, 2, 3, 4, 5, 6}}}, {2, {3, {3, 2, 1, 6, 5, 4}}}, {3, {3, {6, 5, 4, 3, 2, 1}}},
      {4, {3, {4, 5, 6, 1, 2, 3}}}, {5, {2, {1, 4, 2, 5, 3, 6}}}, {6, {2, {3, 6, 2, 5, 1, 4}}},
      {7, {2, {6, 3, 5, 2, 4, 1}}}, {8, {2, {4, 1, 5, 2, 6, 3}}}};
  Image upright(3, 2, 1);
  for (int i = 0; i < 6; ++i) upright.view<std::uint8_t>()(i % 3, i / 3) = static_cast<std::uint8_t>(i + 1);
  for (const auto& [orientation, each] : stored) {
    Image image(each.first, 6 / each.first, 1);
    for (int i = 0; i < 6; ++i) {
      image.view<std::uint8_t>()(i % each.first, i / each.first) = each.second[static_cast<std::size_t>(i)];
    }
    Metadata metadata;
    metadata.exif = oriented(static_cast<std::uint8_t>(orientation));
    image.set_metadata(metadata);
    write_image(image, path("o.png"));
    const Image back = read_image(path("o.png"));
    EXPECT_TRUE(same_pixels(back, upright)) << orientation;
    EXPECT_EQ(back.metadata().exif, oriented(1)) << "or it would be turned twice";
    const ImageFile file = image_file(path("o.png"));
    EXPECT_EQ(file.orientation, orientation);
    EXPECT_EQ(file.info.width, 3);
    EXPECT_EQ(file.stored_width, each.first);
    EXPECT_EQ(file.streamed, orientation == 1);
    const auto source = open_image(path("o.png"));
    Image row(3, 1, 1);
    source->rows({})->read(1, row.any());
    EXPECT_EQ(row.view<std::uint8_t>()(0, 0), 4) << orientation;
  }
}

TEST_F(ImageIo, TurningKeepsEveryPixelType) {
  for (const int channels : {1, 2, 3, 4}) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
      const AlphaState alpha = channels % 2 == 0 ? AlphaState::Straight : AlphaState::None;
      const Image image = random_image({7, 5, channels, type, ColorState::Srgb, alpha}, 2);
      // Turning by 6 and then by 8 comes back.
      Image turned(turned_info(image.info(), 6));
      place_turned_rows(image.any(), 0, 6, turned.any());
      Image back(image.info());
      place_turned_rows(std::as_const(turned).any(), 0, 8, back.any());
      EXPECT_TRUE(same_pixels(image, back));
    }
  }
}

TEST_F(ImageIo, LargeImagesGoToTemporaryFiles) {
  Metadata metadata;
  metadata.exif = oriented(6);
  Image image = rgb_image();
  image.set_metadata(metadata);
  write_image(image, path("a.png"));
  azulejo::Run small;
  small.limits.memory_bytes = 100;
  small.limits.temporary_folder = folder_.string();
  EXPECT_TRUE(same_pixels(read_image(path("a.png"), {}, small), read_image(path("a.png"))));
  const auto source = open_image(path("a.png"), {}, small);
  Image rows(source->info());
  source->rows(small)->read(0, rows.any());
  EXPECT_EQ(source->image(), nullptr) << "it isn't in memory";
  EXPECT_TRUE(same_pixels(rows, read_image(path("a.png"))));
  small.limits.temporary_bytes = 100;
  EXPECT_EQ(kind_of_error([&] { read_image(path("a.png"), {}, small); }), Error::Resource);
  small.limits.pixels = 100;
  EXPECT_EQ(kind_of_error([&] { open_image(path("a.png"), {}, small); }), Error::Resource);
}

TEST_F(ImageIo, SinksTakeRowsInAnyGroups) {
  const Image image = rgb_image();
  for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.webp", "a.bmp", "a.tga", "a.pfm"}) {
    write_image(image, path(name));
    const auto sink = create_image(path(std::string("rows_") + name), image.info(), {});
    int y = 0;
    for (const int rows : {1, 2, 17, 13}) {
      sink->write(image.any().crop({0, y, image.width(), rows}));
      y += rows;
    }
    sink->finish();
    EXPECT_TRUE(same_pixels(read_image(path(name)), read_image(path(std::string("rows_") + name)))) << name;
  }
}

TEST_F(ImageIo, NormalizeStretchesWholeOrInRows) {
  Image image = random_image({9, 9, 1, PixelType::F32, ColorState::Data, AlphaState::None}, 8);
  image.view<float>()(4, 4) = -3;
  image.view<float>()(5, 4) = 5;
  const WriteOptions options = {.type = PixelType::U8, .normalize = true};
  write_image(image, path("whole.png"), options);
  const Image whole = read_image(path("whole.png"));
  EXPECT_EQ(whole.view<std::uint8_t>()(4, 4), 0);
  EXPECT_EQ(whole.view<std::uint8_t>()(5, 4), 255);
  const auto sink = create_image(path("rows.png"), image.info(), {}, options);
  for (int y = 0; y < 9; y += 3) sink->write(image.any().crop({0, y, 9, 3}));
  sink->finish();
  EXPECT_TRUE(same_pixels(whole, read_image(path("rows.png"))));
}

TEST_F(ImageIo, EveryEndingThatIsWrittenIsRead) {
  const Image image = rgb_image();
  for (const std::string& ending : image_endings_written()) {
    const std::string name = path("a." + ending);
    EXPECT_TRUE(is_image_path(name));
    write_image(image, name);
    const Image back = read_image(name);
    EXPECT_EQ(back.width(), image.width()) << ending;
    EXPECT_EQ(back.height(), image.height()) << ending;
    EXPECT_EQ(image_file(name).info, back.info()) << ending;
  }
  EXPECT_FALSE(is_image_path("a.stl"));
  EXPECT_FALSE(is_image_path("png"));
}

TEST_F(ImageIo, StandardStreamsAndPipes) {
  // A pipe can be read once only: what it gives is kept.
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto bytes = encode_image(rgb_image(), "ppm");
  const pid_t child = fork();
  if (child == 0) {
    std::ofstream(pipe, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    _exit(0);
  }
  EXPECT_TRUE(same_pixels(read_image(pipe), rgb_image()));
}

}  // namespace
}  // namespace azulejo
