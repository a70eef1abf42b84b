#include "azulejo/math/predicates.h"

#include <array>
#include <cstddef>

namespace azulejo::predicates {
namespace {

/// high + low is what was to be computed, exactly; high is that, rounded.
struct Pair {
  double high = 0;
  double low = 0;
};

/// Knuth's two-sum (theorem 7 of the paper).
Pair two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  const double a_part = high - b_part;
  return {high, (a - a_part) + (b - b_part)};
}

Pair two_difference(double a, double b) { return two_sum(a, -b); }

/// Dekker's split: two halves of 26 bits.
Pair split(double a) {
  const double scaled = 0x1.0000002p27 * a;  // 2²⁷ + 1
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

/// Veltkamp's two-product (theorem 18).
Pair two_product(double a, double b) {
  const double high = a * b;
  const Pair as = split(a);
  const Pair bs = split(b);
  const double error = ((high - as.high * bs.high) - as.low * bs.high) - as.high * bs.low;
  return {high, as.low * bs.low - error};
}

/// A number as the sum of doubles whose bits don't overlap, by rising size, none of them zero.
template <std::size_t N>
struct Expansion {
  std::array<double, N> parts;
  std::size_t count = 0;

  void push(double part) {
    if (part < 0 || part > 0) parts[count++] = part;  // what isn't a number is left out: there is no room for it
  }
  /// The part with the most weight has the sign of all, and all others together are less than its last place.
  double value() const {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += parts[i];
    return sum;
  }
};

Expansion<2> expansion(const Pair& pair) {
  Expansion<2> result;
  result.push(pair.low);
  result.push(pair.high);
  return result;
}

/// Fast-expansion-sum (theorem 13): merged by size, then swept once.
template <std::size_t N, std::size_t M>
Expansion<N + M> sum(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<N + M> result;
  std::size_t i = 0;
  std::size_t j = 0;
  double total = 0;
  while (i < a.count || j < b.count) {
    const bool take_a = j == b.count || (i < a.count && std::abs(a.parts[i]) < std::abs(b.parts[j]));
    const Pair next = two_sum(total, take_a ? a.parts[i++] : b.parts[j++]);
    result.push(next.low);
    total = next.high;
  }
  result.push(total);
  return result;
}

template <std::size_t N>
Expansion<N> negative(Expansion<N> a) {
  for (std::size_t i = 0; i < a.count; ++i) a.parts[i] = -a.parts[i];
  return a;
}

/// Scale-expansion (theorem 19).
template <std::size_t N>
Expansion<2 * N> scaled(const Expansion<N>& a, double factor) {
  Expansion<2 * N> result;
  double total = 0;
  for (std::size_t i = 0; i < a.count; ++i) {
    const Pair product = two_product(a.parts[i], factor);
    const Pair low = two_sum(total, product.low);
    result.push(low.low);
    const Pair high = two_sum(product.high, low.high);
    result.push(high.low);
    total = high.high;
  }
  result.push(total);
  return result;
}

/// Part by part of the second factor.
template <std::size_t N, std::size_t M>
Expansion<2 * N * M> product(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<2 * N * M> total;
  for (std::size_t j = 0; j < b.count; ++j) {
    const auto next = sum(total, scaled(a, b.parts[j]));
    total.count = next.count;  // at most 2 N a part
    for (std::size_t i = 0; i < next.count; ++i) total.parts[i] = next.parts[i];
  }
  return total;
}

using Difference = Expansion<2>;
struct Differences {
  Difference x;
  Difference y;
};
Differences differences(const glm::dvec2& a, const glm::dvec2& origin) {
  return {expansion(two_difference(a.x, origin.x)), expansion(two_difference(a.y, origin.y))};
}

/// a.x b.y − b.x a.y
Expansion<16> cross(const Differences& a, const Differences& b) {
  return sum(product(a.x, b.y), negative(product(b.x, a.y)));
}

}  // namespace

double exact_orient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return cross(differences(a, c), differences(b, c)).value();
}

double exact_orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const Differences ad = differences(glm::dvec2(a.x, a.y), glm::dvec2(d.x, d.y));
  const Differences bd = differences(glm::dvec2(b.x, b.y), glm::dvec2(d.x, d.y));
  const Differences cd = differences(glm::dvec2(c.x, c.y), glm::dvec2(d.x, d.y));
  const auto term = [&](double z, const Expansion<16>& minor) {
    return product(minor, expansion(two_difference(z, d.z)));
  };
  return sum(sum(term(a.z, cross(bd, cd)), term(b.z, cross(cd, ad))), term(c.z, cross(ad, bd))).value();
}

double exact_incircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const Differences ad = differences(a, d);
  const Differences bd = differences(b, d);
  const Differences cd = differences(c, d);
  const auto term = [](const Differences& lifted, const Expansion<16>& minor) {
    return product(minor, sum(product(lifted.x, lifted.x), product(lifted.y, lifted.y)));
  };
  return sum(sum(term(ad, cross(bd, cd)), term(bd, cross(cd, ad))), term(cd, cross(ad, bd))).value();
}

}  // namespace azulejo::predicates
