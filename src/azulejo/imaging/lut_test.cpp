#include "azulejo/imaging/lut.h"

#include <filesystem>
#include <fstream>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

/// A file that is gone with the test.
class LutFile {
 public:
  explicit LutFile(const std::string& text) {
    path_ = testing::TempDir() + "azulejo_lut_" + testing::UnitTest::GetInstance()->current_test_info()->name() +
            std::to_string(++count) + ".txt";
    std::ofstream(path_) << text;
  }
  ~LutFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  inline static int count = 0;
  std::string path_;
};

PointOperation with_file(const std::string& path) {
  return [path](const Image& source) { return lut(source, {.file = path}); };
}

PointOperation with_curve(const NumberGrid& curve) {
  return [curve](const Image& source) { return lut(source, {.curve = curve}); };
}

/// Lines between points, in double precision.
double between(const std::vector<std::pair<double, double>>& points, double v) {
  if (v <= points.front().first) return points.front().second;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto& [x0, y0] = points[i - 1];
    const auto& [x1, y1] = points[i];
    if (v <= x1) return y0 + (y1 - y0) * (v - x0) / (x1 - x0);
  }
  return points.back().second;
}

TEST(Lut, CurvesAreLinesBetweenTheirPoints) {
  // Exact binary fractions, so that the grid holds what the definition gets.
  const NumberGrid grid{4, 2, {0.125F, 0.25F, 0.25F, 0.875F, 0.75F, 0.5F, 0.875F, 1}};
  const std::vector<std::pair<double, double>> points{{0.125, 0.25}, {0.25, 0.875}, {0.75, 0.5}, {0.875, 1}};
  const auto exact = [&](double v) { return between(points, v); };
  // Rounded three times, where the slope is 5 at most.
  expect_rounded(with_curve(grid), exact, PixelType::U8, 1e-3);
  expect_rounded(with_curve(grid), exact, PixelType::U16, 0.03);
  expect_real(with_curve(grid), exact, 5e-7, 0);
}

TEST(Lut, ByDefaultChangesNothing) {
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    expect_rounded([](const Image& source) { return lut(source); }, [](double v) { return v; }, type, 1e-6);
  }
}

TEST(Lut, TablesOfBytesAreLookedUp) {
  std::string text = "# any permutation\n\n";
  for (int v = 0; v < 256; ++v) text += std::to_string(v * 37 % 256) + "\n";
  const LutFile file(text);
  expect_rounded(
      with_file(file.path()), [](double v) { return static_cast<int>(v * 255 + 0.5) * 37 % 256 / 255.0; },
      PixelType::U8, 1e-3);
}

TEST(Lut, TablesOfAnyLengthAreLinesBetweenTheirValues) {
  const LutFile file("0.5 # the first\r\n 1\n\t.25\n0");  // no line's end at the end
  const std::vector<std::pair<double, double>> points{{0, 0.5}, {1 / 3.0, 1}, {2 / 3.0, 0.25}, {1, 0}};
  const auto exact = [&](double v) { return between(points, v); };
  expect_rounded(with_file(file.path()), exact, PixelType::U8, 1e-3);
  expect_rounded(with_file(file.path()), exact, PixelType::U16, 0.03);
  expect_real(with_file(file.path()), exact, 5e-7, 0);
}

TEST(Lut, TheLargestNumberOrTheOptionTellsTheScale) {
  Image white(1, 1, 1, PixelType::F32);
  white.view<float>()(0, 0) = 1;
  const auto of_white = [&](const std::string& last, std::optional<float> scale = {}) {
    const LutFile file("0\n" + last);
    return lut(white, {.file = file.path(), .scale = scale}).view<float>()(0, 0);
  };
  EXPECT_EQ(of_white("0.5"), 0.5F);
  EXPECT_EQ(of_white("1"), 1.0F);
  EXPECT_EQ(of_white("51"), 0.2F);
  EXPECT_EQ(of_white("255"), 1.0F);
  EXPECT_EQ(of_white("13107"), 0.2F);
  EXPECT_EQ(of_white("1", 4.0F), 0.25F);
}

TEST(Lut, CubeFilesHaveATableForEachChannelAndADomain) {
  const LutFile file(
      "TITLE \"each its own\"\nLUT_1D_SIZE 3\nDOMAIN_MIN 0 0 0.25\nDOMAIN_MAX 1 2 0.75\n0 1 0\n0.5 0.5 1\n1 0 0\n");
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {3, 4}) {
      const Image source = random_image(
          {83, 3, channels, type, ColorState::Srgb, channels == 4 ? AlphaState::Straight : AlphaState::None}, 5);
      const Image result = lut(source, {.file = file.path()});
      visit(result.any(), [&](auto view) {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
        const double top = static_cast<double>(full_range(type));
        const double tolerance = type == PixelType::F32 ? 1e-6 : 0.51;
        for (int y = 0; y < 3; ++y) {
          for (int x = 0; x < 83; ++x) {
            const auto v = [&](int c) { return static_cast<double>(source.view<T>()(x, y, c)) / top; };
            EXPECT_NEAR(view(x, y, 0), v(0) * top, tolerance);
            EXPECT_NEAR(view(x, y, 1), (1 - v(1) / 2) * top, tolerance);
            EXPECT_NEAR(view(x, y, 2), std::max(0.0, 1 - std::abs(v(2) - 0.5) * 4) * top, tolerance);
            if (channels == 4) {
              EXPECT_EQ(view(x, y, 3), source.view<T>()(x, y, 3));
            }
          }
        }
      });
    }
  }
  EXPECT_THROW(lut(Image(1, 1, 1), {.file = file.path()}), Error);
}

TEST(Lut, CubeFilesOfEqualColumnsTakeGray) {
  const LutFile file("LUT_1D_SIZE 2\nLUT_1D_INPUT_RANGE 0 1\n1 1 1\n0 0 0\n");
  expect_rounded(
      with_file(file.path()), [](double v) { return 1 - v; }, PixelType::U8, 1e-3);
}

TEST(Lut, RefusesFilesThatAreNoTables) {
  const Image source(1, 1, 3);
  const auto kind_of = [&](const std::string& text) {
    const LutFile file(text);
    try {
      lut(source, {.file = file.path()});
    } catch (const Error& error) {
      return error.kind();
    }
    ADD_FAILURE() << text;
    return Error::Io;
  };
  for (const char* text :
       {"", "1\n", "1 2\n3 4\n", "0\nx\n", "0\nnan\n", "0\n1e99\n", "0\n1,5\n", "LUT_1D_SIZE 3\n0 0 0\n1 1 1\n",
        "LUT_1D_SIZE 2\n0 0\n1 1\n", "LUT_1D_SIZE 1\n0 0 0\n", "LUT_1D_SIZE 2.5\n", "0\n1\nLUT_1D_SIZE 2\n",
        "LUT_1D_SIZE 2\nDOMAIN_MIN 1 1 1\n0 0 0\n1 1 1\n", "WHAT 3\n0\n1\n"}) {
    EXPECT_EQ(kind_of(text), Error::Data) << text;
  }
  EXPECT_EQ(kind_of("LUT_3D_SIZE 2\n0 0 0\n"), Error::Unsupported);
  EXPECT_THROW(lut(source, {.file = "/no/such/file"}), Error);
  const LutFile table("0\n1\n");
  EXPECT_THROW(lut(source, {.file = table.path(), .curve = {2, 2, {0, 1, 1, 0}}}), Error);
  try {
    lut(source, {.file = LutFile("\x1B[2J" + std::string(1000, '1')).path()});
    ADD_FAILURE();
  } catch (const Error& error) {
    const std::string_view message = error.what();
    EXPECT_NE(message.find("\"?[2J1"), std::string_view::npos) << message;
    EXPECT_LT(message.size(), 400U) << message;
  }
}

TEST(Lut, RefusesAScaleWithoutAFile) {
  EXPECT_THROW(lut(Image(1, 1, 1), {.scale = 2.0F}), Error);
  EXPECT_NO_THROW(lut(Image(1, 1, 1), {}));
}

TEST(Lut, RefusesCurvesThatAreNone) {
  const Image source(1, 1, 1);
  for (const NumberGrid& curve :
       {NumberGrid{1, 2, {0, 0}}, NumberGrid{2, 1, {0, 1}}, NumberGrid{2, 2, {0, 0, 0, 1}},
        NumberGrid{2, 2, {0.5F, 0, 0.25F, 1}}, NumberGrid{2, 2, {0, 0, 2, 1}}, NumberGrid{}}) {
    EXPECT_THROW(lut(source, {.curve = curve}), Error);
  }
}

TEST(Lut, LeavesAlphaAlone) {
  expect_alpha_is_left_alone(with_curve({3, 2, {0, 1, 0.5F, 0, 1, 0.5F}}));
  const LutFile file("LUT_1D_SIZE 2\n0 1 0.5\n1 0 1\n");
  expect_alpha_is_left_alone(with_file(file.path()));
}

TEST(Lut, NaNStaysNaN) {
  const LutFile file("0\n1\n");
  EXPECT_TRUE(std::isnan(of_one(with_file(file.path()), kNaN)));
  EXPECT_TRUE(std::isnan(of_one(with_curve({2, 2, {0, 0, 1, 1}}), kNaN)));
  EXPECT_EQ(of_one(with_file(file.path()), kInfinity), 1.0F);
}

}  // namespace
}  // namespace azulejo
