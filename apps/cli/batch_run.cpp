#include "batch_run.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "azulejo/core/error.h"
#include "azulejo/core/json.h"
#include "azulejo/core/parallel.h"

namespace azulejo::cli {
namespace {

/// What the result of a batch's item depends on beside its input: all words but the inputs.
std::string batch_command(const CommandLine& line, const std::vector<std::string>& inputs) {
  std::string command = std::string("azulejo ") + AZULEJO_VERSION;
  const std::vector<std::string> ignored = {"--force", "--quiet", "-q", "--verbose", "-v", "--json"};
  for (const std::string& word : line.words) {
    const bool input = std::find(inputs.begin(), inputs.end(), word) != inputs.end();
    if (!input && std::find(ignored.begin(), ignored.end(), word) == ignored.end()) command += " " + word;
  }
  return command;
}

std::string manifest_path(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return (folder.empty() ? std::filesystem::path(".") : folder) / ".azulejo-batch.jsonl";
}

}  // namespace

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (std::fflush(stdout) != 0) throw Error(Error::Io, "standard output: can't write");
}

Run make_run(const CommandLine& line, const CancelToken& cancel, ProgressBar& bar) {
  Run run;
  run.threads = line.threads;
  run.cancel = &cancel;
  run.limits = line.limits;
  if (line.strict) {
    run.warn = [](const std::string& message) { throw Error(Error::Data, message + " (--strict)"); };
  } else if (!line.quiet) {
    run.warn = [&bar](const std::string& message) { bar.print("azulejo: warning: " + message); };
  }
  return run;
}

BatchRun::BatchRun(const CommandLine& line, const std::vector<std::string>& inputs, std::vector<Manifest::Item> items,
                   const CancelToken& cancel)
    : line_(line),
      bar_(!line.quiet),
      run_(make_run(line, cancel, bar_)),
      items_(std::move(items)),
      manifest_(manifest_path(items_[0].files[0]), batch_command(line, inputs)) {}

int BatchRun::side_by_side(const Work& work) {
  // Small images keep all threads busy best when each thread has an image of its own.
  const bool enough = items_.size() >= static_cast<std::size_t>(thread_count(run_));
  Run inner = run_;
  Run loop = run_;
  (enough ? inner : loop).threads = 1;
  return finish(
      [&] { parallel_tasks(items_.size(), loop, [&](std::size_t i, int) { run_item(i, work, inner, false); }); });
}

int BatchRun::in_turn(const Work& work) {
  return finish([&] {
    for (std::size_t i = 0; i < items_.size(); ++i) {
      check_cancelled(run_);
      run_item(i, work, run_, true);
    }
  });
}

int BatchRun::finish(const std::function<void()>& loop) {
  try {
    loop();
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled) summary("cancelled: ");
    throw;
  }
  manifest_.compact();
  summary("");
  return failed_ > 0 ? 1 : verdict_no_ > 0 ? 3 : 0;
}

void BatchRun::run_item(std::size_t index, const Work& work, const Run& run, bool stop_at_wrong_call) {
  const Manifest::Item& item = items_[index];
  bar_.show(static_cast<double>(done_ + skipped_ + failed_) / static_cast<double>(items_.size()), item.files[0]);
  if (!line_.force && manifest_.is_done(item)) {
    ++skipped_;
    return;
  }
  try {
    for (const std::string& file : item.files) {
      const std::filesystem::path folder = std::filesystem::path(file).parent_path();
      if (!folder.empty()) std::filesystem::create_directories(folder);
    }
    manifest_.begin(item);
    if (!work(index, run)) ++verdict_no_;
    manifest_.done(item);
    ++done_;
    if (line_.verbose) bar_.print(fmt::format("{} → {}", item.input, fmt::join(item.files, ", ")));
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled || (stop_at_wrong_call && error.kind() == Error::Argument)) throw;
    fail(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    fail(fmt::format("{}: {}", error.path1().string(), error.code().message()));
  }
}

/// Many items may fail for one reason: it is said once.
void BatchRun::fail(const std::string& message) {
  ++failed_;
  const std::lock_guard lock(said_mutex_);
  if (message != said_) bar_.print("azulejo: " + message);
  said_ = message;
}

void BatchRun::summary(const std::string& before) {
  if (line_.json) {
    print(Json::object()
              .set("azulejo", AZULEJO_VERSION)
              .set("done", done_.load())
              .set("skipped", skipped_.load())
              .set("failed", failed_.load())
              .set("items", static_cast<std::int64_t>(items_.size()))
              .dump() +
          "\n");
  } else if (!line_.quiet) {
    bar_.print(fmt::format("azulejo: {}{} done, {} done before, {} failed, {} in all", before, done_.load(),
                           skipped_.load(), failed_.load(), items_.size()));
  }
}

}  // namespace azulejo::cli
