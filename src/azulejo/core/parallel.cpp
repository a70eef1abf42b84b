#include "azulejo/core/parallel.h"

#include <sched.h>

#include <atomic>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "azulejo/core/error.h"

#if defined(AZULEJO_THREAD_SANITIZER)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace azulejo {
namespace {

// ThreadSanitizer can't see into libtbb. So this file, the only one that includes TBB, is built without it, and says
// here what comes before what; all that runs inside the loops is looked at.
#if defined(AZULEJO_THREAD_SANITIZER)
void comes_before(void* address) { __tsan_release(address); }
void comes_after(void* address) { __tsan_acquire(address); }
#else
void comes_before(void*) {}
void comes_after(void*) {}
#endif

int machine_threads() {
  static const int count = [] {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0) return CPU_COUNT(&set);
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }();
  return count;
}

/// Keeps the failure with the lowest task number.
class FirstFailure {
 public:
  void keep(std::size_t task) {
    const std::lock_guard lock(mutex_);
    if (task < task_) {
      task_ = task;
      failure_ = std::current_exception();
    }
    failed_.store(true, std::memory_order_relaxed);
  }
  bool failed() const { return failed_.load(std::memory_order_relaxed); }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::atomic<bool> failed_ = false;
  std::size_t task_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr failure_;
};

/// The arena for so many threads. Making one costs several microseconds, so they are kept for the next call.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static auto* const arenas = new std::map<int, tbb::task_arena>;  // outlives TBB's own shutdown
  const std::lock_guard lock(mutex);
  return arenas->try_emplace(threads, threads).first->second;
}

}  // namespace

void check_cancelled(const Run& run) {
  if (run.cancel != nullptr && run.cancel->cancelled()) throw Error(Error::Cancelled, "cancelled");
}

int thread_count(const Run& run) { return run.threads > 0 ? run.threads : machine_threads(); }

void parallel_tasks(std::size_t tasks, const Run& run, const std::function<void(std::size_t task, int worker)>& body) {
  const int threads = static_cast<int>(std::min<std::size_t>(tasks, static_cast<std::size_t>(thread_count(run))));
  if (threads <= 1) {
    for (std::size_t task = 0; task < tasks; ++task) {
      check_cancelled(run);
      body(task, 0);
    }
    return;
  }

  // TBB runs at most one thread per processor unless told that more are wanted.
  std::optional<tbb::global_control> more;
  if (threads > machine_threads()) {
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }

  // Each worker takes the next task from a shared counter: the lowest numbers first, so a caller that
  // writes in order finds its tasks done in about that order.
  // The two counters also order memory, so nothing rests on how TBB does it.
  std::atomic<std::size_t> next;
  next.store(0, std::memory_order_release);
  std::atomic<int> finished = 0;
  FirstFailure failure;
  comes_before(&next);
  arena_of(threads).execute([&] {
    tbb::parallel_for(
        0, threads,
        [&](int worker) {
          comes_after(&next);
          for (;;) {
            const std::size_t task = next.fetch_add(1, std::memory_order_acq_rel);
            if (task >= tasks || failure.failed()) break;
            try {
              check_cancelled(run);
              body(task, worker);
            } catch (...) {
              failure.keep(task);
            }
          }
          comes_before(&finished);
          finished.fetch_add(1, std::memory_order_release);
        },
        tbb::simple_partitioner());
  });
  static_cast<void>(finished.load(std::memory_order_acquire));
  comes_after(&finished);
  failure.rethrow();
}

void parallel_for(std::size_t count, std::size_t chunk, const Run& run,
                  const std::function<void(std::size_t begin, std::size_t end)>& body) {
  const std::size_t step = std::max<std::size_t>(chunk, 1);
  parallel_tasks((count + step - 1) / step, run,
                 [&](std::size_t task, int) { body(task * step, std::min(count, (task + 1) * step)); });
}

}  // namespace azulejo
