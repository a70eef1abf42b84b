#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"

namespace azulejo {

/// Runs body(task, worker) for every task in [0, tasks) on `thread_count(run)` threads.
///
/// worker  in [0, thread_count): no two tasks run at the same time with the same worker
/// Throws  what a task threw (of several, the one with the lowest task number); Error(Cancelled)
/// Cost    about 1 µs, nothing for a single task: that one runs on the caller's thread
AZULEJO_EXPORT void parallel_tasks(std::size_t tasks, const Run& run,
                                   const std::function<void(std::size_t task, int worker)>& body);

/// Loops over [0, count) in chunks of `chunk`: body(begin, end). The chunks depend on the size only.
AZULEJO_EXPORT void parallel_for(std::size_t count, std::size_t chunk, const Run& run,
                                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Reduces [0, count): map(begin, end) for each chunk, then combine(left, right) in the order of the chunks,
/// so floating-point sums have the same bytes for any number of threads.
template <class T, class Map, class Combine>
T parallel_reduce(std::size_t count, std::size_t chunk, const Run& run, T identity, Map map, Combine combine) {
  const std::size_t step = std::max<std::size_t>(chunk, 1);
  std::vector<T> partial((count + step - 1) / step, identity);
  parallel_for(count, step, run, [&](std::size_t begin, std::size_t end) { partial[begin / step] = map(begin, end); });
  T total = std::move(identity);
  for (T& each : partial) total = combine(std::move(total), std::move(each));
  return total;
}

/// Sorts stably: chunks on all threads, then merged pairwise. The result is that of std::stable_sort.
template <class Iterator, class Less = std::less<>>
void parallel_sort(Iterator first, Iterator last, const Run& run, Less less = {}) {
  constexpr std::size_t kChunk = std::size_t{1} << 15;
  const auto count = static_cast<std::size_t>(std::distance(first, last));
  const auto at = [&](std::size_t index) {
    return first + static_cast<typename std::iterator_traits<Iterator>::difference_type>(std::min(index, count));
  };
  parallel_for(count, kChunk, run,
               [&](std::size_t begin, std::size_t end) { std::stable_sort(at(begin), at(end), less); });
  for (std::size_t width = kChunk; width < count; width *= 2) {
    parallel_for((count + 2 * width - 1) / (2 * width), 1, run, [&](std::size_t pair, std::size_t) {
      const std::size_t begin = pair * 2 * width;
      std::inplace_merge(at(begin), at(begin + width), at(begin + 2 * width), less);
    });
  }
}

}  // namespace azulejo
