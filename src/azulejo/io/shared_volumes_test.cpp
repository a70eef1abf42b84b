// What each of the shared sample volumes gives.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "azulejo/io/volume_testing.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

struct SharedVolume {
  const char* path;
  std::optional<Error::Kind> refused;
  glm::ivec3 size;
  glm::vec3 spacing;
  glm::vec3 origin;
  float metres_per_unit;
  float lowest;
  float highest;
  bool warned;
};

// Sizes, steps and origins as the files' headers say in bytes; the extrema were found by a script of a few lines.
// clang-format off
const SharedVolume kSharedVolumes[] = {
    {"bucky_32x32x32_uint8.raw", {}, {32, 32, 32}, {1, 1, 1}, {0, 0, 0}, 0, 1, 248, false},
    {"ch2bet.nii.gz", {}, {181, 217, 181}, {1, 1, 1}, {-90, -125, -71}, 0, 0, 133, false},
    {"ct_avm.nii.gz", {}, {256, 242, 154}, {0.719943F, 0.720914F, 1}, {-73.3977F, -69.6942F, -64.11F}, 1e-3F, 0, 563.2F, false},
    {"headsq_64x64x93_int16le.raw", {}, {64, 64, 93}, {1, 1, 1}, {0, 0, 0}, 0, 0, 3926, false},
    {"iguana.nii.gz", {}, {210, 256, 179}, {0.1018F, 0.1018F, 0.1018F}, {-10.3156F, -11.5061F, -15.1803F}, 1e-3F, 0, 229, false},
    {"skull_2.9.inr", {}, {64, 64, 64}, {3.94305F, 3.94305F, 3.65079F}, {0, 0, 0}, 0, 2.1714552e-13F, 5.4288F, false},
    {"stent.npz", Error::Unsupported, {}, {}, {}, 0, 0, 0, false},
    {"torus_sdf.vol", {}, {40, 40, 40}, {1, 1, 1}, {0, 0, 0}, 0, -4, 23.0982F, true},  // its box has integers for floats
};
// clang-format on

fs::path folder() { return shared_images().parent_path() / "volumes"; }

ModelReadOptions layout_of(const std::string& name) {
  if (name.starts_with("bucky")) return {.raw = RawVolume{.width = 32, .height = 32, .depth = 32}};
  if (name.starts_with("headsq"))
    return {.raw = RawVolume{.width = 64, .height = 64, .depth = 93, .type = SampleType::I16}};
  return {};
}

void expect_near(const glm::vec3& value, const glm::vec3& wanted) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], wanted[i], 1e-5F * std::max(1.0F, std::abs(wanted[i])));
}

void expect_volume(const Volume& volume, const SharedVolume& wanted) {
  EXPECT_EQ(glm::ivec3(volume.width, volume.height, volume.depth), wanted.size);
  expect_near(volume.spacing, wanted.spacing);
  expect_near(volume.origin, wanted.origin);
  EXPECT_EQ(volume.metres_per_unit, wanted.metres_per_unit);
  const auto [low, high] = std::minmax_element(volume.samples.begin(), volume.samples.end());
  EXPECT_NEAR(*low, wanted.lowest, 1e-6F * std::abs(wanted.lowest));
  EXPECT_NEAR(*high, wanted.highest, 1e-5F * std::abs(wanted.highest));
}

TEST(SharedVolumes, GiveWhatTheTableSays) {
  if (!fs::is_directory(folder())) GTEST_SKIP() << "skipped: " << folder() << " absent";
  for (const SharedVolume& wanted : kSharedVolumes) {
    SCOPED_TRACE(wanted.path);
    Warnings heard;
    try {
      const Model model = read_model((folder() / wanted.path).string(), layout_of(wanted.path), heard.run());
      EXPECT_FALSE(wanted.refused);
      expect_volume(std::get<Volume>(model), wanted);
      EXPECT_EQ(!heard.lines.empty(), wanted.warned);
    } catch (const Error& error) {
      EXPECT_EQ(wanted.refused, error.kind()) << error.what();
    }
  }
}

TEST(SharedVolumes, AreAllInTheTable) {
  if (!fs::is_directory(folder())) GTEST_SKIP() << "skipped: " << folder() << " absent";
  std::set<std::string> listed;
  for (const SharedVolume& each : kSharedVolumes) listed.insert(each.path);
  for (const auto& entry : fs::directory_iterator(folder())) {
    EXPECT_TRUE(listed.contains(entry.path().filename().string())) << entry.path();
  }
}

}  // namespace
}  // namespace azulejo
