#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace azulejo::kernels {

/// A step of a sorting network: the smaller of two values goes to place a, the greater to b, but only what is used later.
struct Exchange {
  std::int16_t a = 0;
  std::int16_t b = 0;
  bool low = true;       ///< what goes to a is used
  bool high = true;      ///< what goes to b is used
  bool first_a = false;  ///< nothing was done with a before
  bool first_b = false;
};

/// Exchanges in their order, and the place where the wanted value is afterwards.
template <int kCapacity>
struct Network {
  std::array<Exchange, kCapacity> steps{};
  int count = 0;
  int result = 0;

  constexpr void exchange(int a, int b) {
    steps[static_cast<std::size_t>(count++)] = {static_cast<std::int16_t>(a), static_cast<std::int16_t>(b)};
  }
};

namespace network {

/// Places in ascending order of what is in them.
struct Places {
  std::array<std::int16_t, 128> at{};
  int count = 0;
  constexpr void add(int place) { at[static_cast<std::size_t>(count++)] = static_cast<std::int16_t>(place); }
  constexpr int operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
};

/// Every second one.
constexpr Places every_second(const Places& places, int first) {
  Places part;
  for (int i = first; i < places.count; i += 2) part.add(places[i]);
  return part;
}

/// Batcher's odd-even merge of two sorted lists of any lengths. Source: Knuth, The Art of Computer Programming 3, 5.3.4.
template <class Net>
constexpr Places merge(Net& net, const Places& a, const Places& b) {
  if (a.count == 0) return b;
  if (b.count == 0) return a;
  Places merged;
  if (a.count == 1 && b.count == 1) {
    net.exchange(a[0], b[0]);
    merged.add(a[0]);
    merged.add(b[0]);
    return merged;
  }
  const Places even = merge(net, every_second(a, 0), every_second(b, 0));
  const Places odd = merge(net, every_second(a, 1), every_second(b, 1));
  merged.add(even[0]);
  for (int i = 1; i < even.count || i <= odd.count; ++i) {
    if (i < even.count && i <= odd.count) net.exchange(odd[i - 1], even[i]);
    if (i <= odd.count) merged.add(odd[i - 1]);
    if (i < even.count) merged.add(even[i]);
  }
  return merged;
}

/// Sorts by merging halves.
template <class Net>
constexpr Places sort(Net& net, const Places& places) {
  if (places.count < 2) return places;
  Places left;
  Places right;
  for (int i = 0; i < places.count; ++i) (i < places.count / 2 ? left : right).add(places[i]);
  return merge(net, sort(net, left), sort(net, right));
}

/// Brings the greatest `wanted` values behind the others, one after the other, or the least in front.
template <class Net>
constexpr Places select(Net& net, Places places, int wanted, bool greatest) {
  const int last = places.count - 1;
  for (int pass = 0; pass < wanted; ++pass) {
    for (int i = 0; i < last - pass; ++i) {
      greatest ? net.exchange(places[i], places[i + 1]) : net.exchange(places[last - i - 1], places[last - i]);
    }
  }
  return places;
}

/// Tells where each place is met first.
template <class Net>
constexpr Net marked(Net net) {
  std::array<bool, 128> met{};
  for (int s = 0; s < net.count; ++s) {
    Exchange& step = net.steps[static_cast<std::size_t>(s)];
    step.first_a = !met[static_cast<std::size_t>(step.a)];
    step.first_b = !met[static_cast<std::size_t>(step.b)];
    met[static_cast<std::size_t>(step.a)] = met[static_cast<std::size_t>(step.b)] = true;
  }
  return net;
}

/// Leaves out what the values at these places don't depend on.
template <class Net>
constexpr Net pruned(const Net& net, const Places& wanted) {
  std::array<bool, 128> used{};
  for (int i = 0; i < wanted.count; ++i) used[static_cast<std::size_t>(wanted[i])] = true;
  Net backwards;
  for (int s = net.count - 1; s >= 0; --s) {
    Exchange step = net.steps[static_cast<std::size_t>(s)];
    step.low = used[static_cast<std::size_t>(step.a)];
    step.high = used[static_cast<std::size_t>(step.b)];
    if (!step.low && !step.high) continue;
    used[static_cast<std::size_t>(step.a)] = used[static_cast<std::size_t>(step.b)] = true;
    backwards.steps[static_cast<std::size_t>(backwards.count++)] = step;
  }
  Net net_pruned;
  net_pruned.result = net.result;
  for (int s = backwards.count - 1; s >= 0; --s) {
    net_pruned.steps[static_cast<std::size_t>(net_pruned.count++)] = backwards.steps[static_cast<std::size_t>(s)];
  }
  return net_pruned;
}

/// Minima and maxima that it takes.
template <class Net>
constexpr int operations(const Net& net) {
  int count = 0;
  for (int s = 0; s < net.count; ++s) {
    const Exchange& step = net.steps[static_cast<std::size_t>(s)];
    count += (step.low ? 1 : 0) + (step.high ? 1 : 0);
  }
  return count;
}

/// The values first … last of the sorted ones, by the way that takes fewer operations: all are sorted, or those at an
/// end are brought there.
template <class Net>
constexpr Places some_sorted(Net& net, const Places& places, int first, int last) {
  const auto part = [&](const Places& sorted) {
    Places wanted;
    for (int i = first; i <= last; ++i) wanted.add(sorted[i]);
    return wanted;
  };
  const bool greatest = last == places.count - 1;
  if (greatest || first == 0) {
    const int wanted = greatest ? places.count - first : last + 1;
    Net sorting;
    const Places sorted = part(sort(sorting, places));
    Net selecting;
    const Places selected = part(select(selecting, places, wanted, greatest));
    if (operations(pruned(selecting, selected)) < operations(pruned(sorting, sorted))) {
      return part(select(net, places, wanted, greatest));
    }
  }
  return part(sort(net, places));
}

}  // namespace network

/// Sorts the values at places 0 … kCount − 1.
template <int kCount>
struct Sorting {
  Network<kCount * kCount> net;
  network::Places order;  ///< where they are then, in ascending order
};

template <int kCount>
constexpr Sorting<kCount> sorting_network() {
  Sorting<kCount> sorting{};
  for (int i = 0; i < kCount; ++i) sorting.order.add(i);
  sorting.order = network::sort(sorting.net, sorting.order);
  sorting.net = network::marked(sorting.net);
  return sorting;
}

/// The median of kSide² values in sorted columns: value i of column j is at place i · kSide + j.
///
/// Rows are sorted, too, which leaves columns sorted. Then value (i, j) is at least as great as the (i + 1)(j + 1) values
/// up to it in rows and columns, and likewise from the other end: only those that may be in the middle go on, as many are
/// left out below as above, and the sorted rests of rows are merged.
template <int kSide>
constexpr auto median_network() {
  constexpr int kHalf = kSide * kSide / 2;
  Network<16 * kSide * kSide> net;
  const auto sorted_rest = [&](int i) {
    network::Places row;
    int first = kSide;
    int last = 0;
    for (int j = 0; j < kSide; ++j) {
      row.add(i * kSide + j);
      const bool too_great = (i + 1) * (j + 1) > kHalf + 1;
      const bool too_small = (kSide - i) * (kSide - j) > kHalf + 1;
      if (too_great || too_small) continue;
      first = std::min(first, j);
      last = j;
    }
    return network::some_sorted(net, row, first, last);
  };
  // Opposite rows, which have as many left, together; then always the shortest two. A row is sorted as late as can be.
  constexpr int kLists = kSide / 2 + 1;
  std::array<network::Places, kLists> lists{};
  for (int i = 0; i < kLists; ++i) {
    lists[static_cast<std::size_t>(i)] = sorted_rest(i);
    if (i == kSide / 2) break;
    lists[static_cast<std::size_t>(i)] =
        network::merge(net, lists[static_cast<std::size_t>(i)], sorted_rest(kSide - 1 - i));
  }
  for (int left = kLists; left > 1; --left) {
    for (int last = left - 2; last < left; ++last) {  // the two shortest to the end
      for (int i = 0; i < last; ++i) {
        if (lists[static_cast<std::size_t>(i)].count < lists[static_cast<std::size_t>(last)].count) {
          std::swap(lists[static_cast<std::size_t>(i)], lists[static_cast<std::size_t>(last)]);
        }
      }
    }
    network::Places& shortest = lists[static_cast<std::size_t>(left - 1)];
    network::Places& second = lists[static_cast<std::size_t>(left - 2)];
    second = network::merge(net, shortest, second);
  }
  net.result = lists[0][lists[0].count / 2];
  network::Places result;
  result.add(net.result);
  return network::marked(network::pruned(net, result));
}

}  // namespace azulejo::kernels
