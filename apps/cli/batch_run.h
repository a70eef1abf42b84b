#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "batch.h"
#include "command_line.h"
#include "progress_bar.h"

namespace azulejo::cli {

/// Text to standard output. Throws Error(Io).
void print(const std::string& text);

/// What the command line says of threads, limits and warnings.
Run make_run(const CommandLine& line, const CancelToken& cancel, ProgressBar& bar);

/// Works through the items of a batch: those that are done already are left out, failures are said and counted, a
/// summary ends it.
class BatchRun {
 public:
  /// Does an item; false: its verdict is no.
  using Work = std::function<bool(std::size_t item, const Run& run)>;

  /// `inputs` are words of the command line on which the results of an item depend only if it names them.
  BatchRun(const CommandLine& line, const std::vector<std::string>& inputs, std::vector<Manifest::Item> items,
           const CancelToken& cancel);

  /// Each with a thread of its own, where there are enough of them. Returns the exit status.
  int side_by_side(const Work& work);
  /// One after the other, on all threads; a wrong call (Error::Argument) of one is wrong for all and ends it.
  int in_turn(const Work& work);

 private:
  int finish(const std::function<void()>& loop);
  void run_item(std::size_t index, const Work& work, const Run& run, bool stop_at_wrong_call);
  void fail(const std::string& message);
  void summary(const std::string& before);

  const CommandLine& line_;
  ProgressBar bar_;
  Run run_;
  std::vector<Manifest::Item> items_;
  Manifest manifest_;
  std::atomic<int> done_ = 0;
  std::atomic<int> skipped_ = 0;
  std::atomic<int> failed_ = 0;
  std::atomic<int> verdict_no_ = 0;
  std::mutex said_mutex_;
  std::string said_;  ///< of the failure that was printed last
};

}  // namespace azulejo::cli
