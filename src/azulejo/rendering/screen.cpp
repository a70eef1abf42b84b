#include "azulejo/rendering/screen.h"

namespace azulejo {
namespace {

constexpr SamplePoint at(int x, int y) { return {kSubpixels / 2 + x * 16, kSubpixels / 2 + y * 16}; }

constexpr std::array kOne{at(0, 0)};
constexpr std::array kFour{at(-2, -6), at(6, -2), at(-6, 2), at(2, 6)};
constexpr std::array kEight{at(1, -3), at(-1, 3), at(5, 1), at(-3, -5), at(-5, 5), at(-7, -1), at(3, 7), at(7, -7)};
constexpr std::array kSixteen{at(1, 1),  at(-1, -3), at(-3, 2), at(4, -1), at(-5, -2), at(2, 5),
                              at(5, 3),  at(3, -5),  at(-2, 6), at(0, -7), at(-4, -6), at(-6, 4),
                              at(-8, 0), at(7, -4),  at(6, 7),  at(-7, -8)};

}  // namespace

std::span<const SamplePoint> sample_pattern(int samples) {
  switch (samples) {
    case 4: return kFour;
    case 8: return kEight;
    case 16: return kSixteen;
    default: return kOne;
  }
}

}  // namespace azulejo
