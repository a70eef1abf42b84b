#include "azulejo/imaging/dither_masks.h"

#include <algorithm>
#include <array>
#include <vector>

#include "azulejo/math/exponential.h"
#include "azulejo/math/random.h"

namespace azulejo {
namespace {

constexpr int kBayer = 8;
constexpr int kSide = 64;
constexpr std::size_t kArea = kSide * kSide;

std::array<std::uint16_t, kBayer * kBayer> make_bayer() {
  std::array<std::uint16_t, kBayer * kBayer> ranks{};
  for (unsigned y = 0; y < kBayer; ++y) {
    for (unsigned x = 0; x < kBayer; ++x) {
      // Each halving of the square is two bits: quarters in the order of a Z of which one stroke is mirrored.
      unsigned rank = 0;
      for (unsigned bit = 0; bit < 3; ++bit) {
        const unsigned across = x >> bit & 1;
        const unsigned down = y >> bit & 1;
        rank = rank << 2 | (across ^ down) << 1 | down;
      }
      ranks[y * kBayer + x] = static_cast<std::uint16_t>(rank);
    }
  }
  return ranks;
}

/// Dots on a torus, and how close each pixel is to them. Whole numbers, so that taking a dot away undoes it exactly.
class Dots {
 public:
  Dots() : energy_(kArea), set_(kArea) {
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x) {
        weights_.push_back(static_cast<std::int32_t>(65536 * exp_deterministic(-(x * x + y * y) / (2 * 1.5 * 1.5))));
      }
    }
  }

  bool has(std::size_t at) const { return set_[at] != 0; }
  void put(std::size_t at) { change(at, 1); }
  void take(std::size_t at) { change(at, -1); }

  /// The pixel without a dot that is farthest from them, and the dot that is closest to others; the first of several.
  std::size_t largest_void() const {
    std::size_t best = kArea;
    for (std::size_t i = 0; i < kArea; ++i) {
      if (!has(i) && (best == kArea || energy_[i] < energy_[best])) best = i;
    }
    return best;
  }
  std::size_t tightest_cluster() const {
    std::size_t best = kArea;
    for (std::size_t i = 0; i < kArea; ++i) {
      if (has(i) && (best == kArea || energy_[i] > energy_[best])) best = i;
    }
    return best;
  }

 private:
  static constexpr int kReach = 8;  // weights beyond are below 1

  void change(std::size_t at, int sign) {
    set_[at] = sign > 0;
    const int column = static_cast<int>(at) % kSide;
    const int row = static_cast<int>(at) / kSide;
    std::size_t k = 0;
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x, ++k) {
        const int place = ((row + y) & (kSide - 1)) * kSide + ((column + x) & (kSide - 1));
        energy_[static_cast<std::size_t>(place)] += sign * weights_[k];
      }
    }
  }

  std::vector<std::int32_t> weights_;
  std::vector<std::int32_t> energy_;
  std::vector<std::uint8_t> set_;
};

std::vector<std::uint16_t> make_blue_noise() {
  Dots dots;
  constexpr std::size_t kFirst = kArea / 10;
  for (std::uint32_t i = 0, count = 0; count < kFirst; ++i) {
    const std::size_t at = philox({i, 0, 0, 0}, {0, 0})[0] % kArea;
    if (dots.has(at)) continue;
    dots.put(at);
    ++count;
  }
  // The tightest dot goes into the largest void, until that is where it came from.
  for (;;) {
    const std::size_t dot = dots.tightest_cluster();
    dots.take(dot);
    const std::size_t place = dots.largest_void();
    dots.put(place);
    if (place == dot) break;
  }
  std::vector<std::uint16_t> ranks(kArea);
  Dots fewer = dots;
  for (std::size_t rank = kFirst; rank-- > 0;) {
    const std::size_t dot = fewer.tightest_cluster();
    fewer.take(dot);
    ranks[dot] = static_cast<std::uint16_t>(rank);
  }
  for (std::size_t rank = kFirst; rank < kArea; ++rank) {
    const std::size_t place = dots.largest_void();
    dots.put(place);
    ranks[place] = static_cast<std::uint16_t>(rank);
  }
  return ranks;
}

}  // namespace

DitherMask bayer_mask() {
  static const auto ranks = make_bayer();
  return {kBayer, ranks};
}

DitherMask blue_noise_mask() {
  static const auto ranks = make_blue_noise();
  return {kSide, ranks};
}

}  // namespace azulejo
