#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "azulejo/core/export.h"

namespace azulejo {

class Stages;

/// Bounds that untrusted input can't push past; passing one is `Error::Resource`.
struct Limits {
  std::int64_t pixels = std::int64_t{1} << 32;            ///< of one image
  std::int64_t memory_bytes = std::int64_t{8} << 30;      ///< images held at once by one call; beyond: temporary files
  std::int64_t temporary_bytes = std::int64_t{64} << 30;  ///< temporary files of one call
  std::string temporary_folder = {};                      ///< empty: $TMPDIR, else /tmp
};

/// A switch shared between the caller and a running operation. Copies are the same switch.
class CancelToken {
 public:
  CancelToken() : cancelled_(std::make_shared<std::atomic<bool>>(false)) {}
  void cancel() const { cancelled_->store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_->load(std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> cancelled_;
};

/// Knobs that no user needs and every test does.
struct Testing {
  int tile_width = 0;      ///< 0: chosen by the executor
  int tile_height = 0;     ///< 0: chosen by the executor
  bool fuse = true;        ///< false: every intermediate is materialized
  bool reference = false;  ///< true: the plain scalar definitions instead of the vector kernels
};

/// The context of a call, every operation's last parameter. Results never depend on it.
struct Run {
  int threads = 0;                                            ///< 0: all of the machine
  const CancelToken* cancel = nullptr;                        ///< looked at between tiles
  std::function<void(double fraction)> progress = {};         ///< 0–1, never from two threads at once
  std::function<void(const std::string& message)> warn = {};  ///< one line each; never from two threads at once
  Stages* stages = nullptr;                                   ///< receives named intermediate results
  Limits limits = {};
  Testing testing = {};
};

/// Calls `run.warn` if there is one.
inline void warn(const Run& run, const std::string& message) {
  if (run.warn) run.warn(message);
}

/// Throws Error(Cancelled) if the caller asked for it.
AZULEJO_EXPORT void check_cancelled(const Run& run);

/// `run.threads`, or the machine's processors (those this process may use) where it is 0.
AZULEJO_EXPORT int thread_count(const Run& run);

}  // namespace azulejo
