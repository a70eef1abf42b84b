// Paints a wall of azulejos with the library alone: the picture that the tour works on.
//   azulejos OUTPUT [WIDTH HEIGHT]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/resize.h"
#include "azulejo/io/image_io.h"

namespace {

using Color = std::array<float, 3>;  // linear light

constexpr Color kGlaze{0.86F, 0.85F, 0.80F};
constexpr Color kCobalt{0.02F, 0.07F, 0.36F};
constexpr Color kSky{0.18F, 0.38F, 0.70F};
constexpr Color kYellow{0.80F, 0.50F, 0.05F};
constexpr Color kGrout{0.30F, 0.28F, 0.25F};

/// A hash of a tile's place: no two glazes came out of the kiln alike.
float shade(int column, int row) {
  unsigned x = static_cast<unsigned>(column) * 0x9E3779B1U ^ static_cast<unsigned>(row) * 0x85EBCA77U;
  x = (x ^ (x >> 15)) * 0x2C1B3C6DU;
  x ^= x >> 12;
  return static_cast<float>(x & 0xFFFFU) / 65535.0F;
}

/// The motif at (x, y) in [−1, 1]²: a rosette in the middle, quarter rosettes at the corners, a border.
Color motif(float x, float y) {
  const float edge = std::max(std::abs(x), std::abs(y));
  if (edge > 0.975F) return kGrout;
  if (edge > 0.90F) return kCobalt;
  const float angle = std::atan2(y, x);
  const float radius = std::hypot(x, y);
  const float petals = 0.34F + 0.20F * std::cos(8 * angle);
  if (radius < 0.10F) return kYellow;
  if (radius < 0.14F) return kCobalt;
  if (radius < petals) return radius > petals - 0.06F ? kCobalt : kSky;
  if (std::abs(radius - 0.66F) < 0.02F) return kCobalt;
  const float corner = std::hypot(1 - std::abs(x), 1 - std::abs(y));
  const float corner_angle = std::atan2(1 - std::abs(y), 1 - std::abs(x));
  const float leaves = 0.36F + 0.12F * std::cos(6 * corner_angle);
  if (corner < 0.15F) return kYellow;
  if (corner < leaves) return corner > leaves - 0.06F ? kCobalt : kSky;
  return kGlaze;
}

Color wall(float x, float y, int width, int height) {
  const float size = static_cast<float>(height) / 4;
  const int column = static_cast<int>(x / size);
  const int row = static_cast<int>(y / size);
  Color color = motif(2 * (x / size - static_cast<float>(column)) - 1, 2 * (y / size - static_cast<float>(row)) - 1);
  // Light falls in from the top left.
  const float across = x / static_cast<float>(width);
  const float down = y / static_cast<float>(height);
  const float light =
      (0.35F + 0.65F * std::exp(-1.6F * (across * across + down * down))) * (0.88F + 0.12F * shade(column, row));
  for (float& channel : color) channel *= light;
  return color;
}

azulejo::Image paint(int width, int height) {
  constexpr int kSamples = 3;  // each way; the shrinking averages them, in linear light
  azulejo::Image fine({kSamples * width, kSamples * height, 3, azulejo::PixelType::F32, azulejo::ColorState::Linear,
                       azulejo::AlphaState::None});
  const auto view = fine.view<float>();
  azulejo::parallel_for(static_cast<std::size_t>(view.height), 16, {}, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < view.width; ++x) {
        const Color color = wall(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, view.width, view.height);
        std::copy(color.begin(), color.end(), &view(x, y));
      }
    }
  });
  return azulejo::resize(fine, {.width = width, .height = height, .filter = azulejo::ResizeFilter::Area});
}

}  // namespace

int main(int count, char** words) {
  if (count != 2 && count != 4) {
    std::cerr << "usage: azulejos OUTPUT [WIDTH HEIGHT]\n";
    return 2;
  }
  try {
    const int width = count == 4 ? std::atoi(words[2]) : 720;
    const int height = count == 4 ? std::atoi(words[3]) : 480;
    azulejo::write_image(paint(width, height), words[1], {.type = azulejo::PixelType::U8});
  } catch (const azulejo::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
