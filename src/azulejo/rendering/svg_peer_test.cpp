// Drawings of other programs, read and drawn, beside what librsvg's rsvg-convert draws of the same files.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "azulejo/io/image_io.h"
#include "azulejo/io/model_io.h"
#include "azulejo/rendering/draw.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 128;
constexpr std::size_t kFilesAFolder = 40;

/// Some of the icons of a theme, all over it.
std::vector<fs::path> some_icons(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code absent;
  for (auto each = fs::recursive_directory_iterator(folder, absent); each != fs::recursive_directory_iterator();
       ++each) {
    if (each->is_regular_file() && each->path().extension() == ".svg") all.push_back(each->path());
  }
  std::sort(all.begin(), all.end());
  std::vector<fs::path> some;
  const std::size_t step = std::max<std::size_t>(1, all.size() / kFilesAFolder);
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

/// How far two pictures are from each other: of premultiplied channels in 255ths.
struct Distance {
  double mean = 0;
  double far = 0;  ///< share of channels that differ by more than 24
};

Distance distance(const Image& a, const Image& b) {
  const auto left = a.view<std::uint8_t>();
  const auto right = b.view<std::uint8_t>();
  Distance result;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const std::uint8_t* const p = left.row(y) + 4 * x;
      const std::uint8_t* const q = right.row(y) + 4 * x;
      for (int c = 0; c < 4; ++c) {
        const double difference = std::abs(p[c] * (c < 3 ? p[3] / 255.0 : 1) - q[c] * (c < 3 ? q[3] / 255.0 : 1));
        result.mean += difference / (kSide * kSide * 4);
        result.far += difference > 24 ? 1.0 / (kSide * kSide * 4) : 0;
      }
    }
  }
  return result;
}

class SvgPeer : public testing::TestWithParam<const char*> {};

/// Both take the area that a path covers of a pixel, librsvg on a grid of 4 × 17 samples: an edge is off by up to a
/// twentieth of 255, and circles of its cubics by more in small icons made large.
TEST_P(SvgPeer, DrawsTheSame) {
  if (std::system("rsvg-convert --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "skipped: no rsvg-convert";
  const std::vector<fs::path> icons = some_icons(GetParam());
  if (icons.empty()) GTEST_SKIP() << "skipped: no drawings in " << GetParam();
  const fs::path picture = fs::temp_directory_path() / ("azulejo_svg_peer_" + std::to_string(getpid()) + ".png");
  std::size_t compared = 0;
  for (const fs::path& icon : icons) {
    bool whole = true;
    azulejo::Run run;
    run.warn = [&](const std::string&) { whole = false; };
    const Drawing drawing = std::get<Drawing>(read_model(icon.string(), {}, run));
    if (!whole) continue;
    const std::string side = std::to_string(kSide);
    const std::string command =
        "rsvg-convert -w " + side + " -h " + side + " -o '" + picture.string() + "' '" + icon.string() + "'";
    if (std::system(command.c_str()) != 0) continue;
    const Image theirs = read_image(picture.string());
    if (theirs.width() != kSide || theirs.height() != kSide || theirs.channels() != 4) continue;
    const Distance found = distance(draw(drawing, {.width = kSide, .height = kSide}), theirs);
    EXPECT_LT(found.mean, 0.6) << icon;
    EXPECT_LT(found.far, 0.005) << icon;
    ++compared;
  }
  fs::remove(picture);
  EXPECT_GT(compared, icons.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Themes, SvgPeer,
                         testing::Values("/usr/share/icons/Adwaita/scalable", "/usr/share/icons/Papirus/64x64",
                                         "/usr/share/icons/Papirus/16x16"));

}  // namespace
}  // namespace azulejo
