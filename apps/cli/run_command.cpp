#include "run_command.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/core/text.h"
#include "azulejo/pipeline.h"
#include "batch.h"
#include "progress_bar.h"
#include "stage_folder.h"

namespace azulejo::cli {
namespace {

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (std::fflush(stdout) != 0) throw Error(Error::Io, "standard output: can't write");
}

/// Whether a positional of `run` is a stage and not a file: stages win over files.
bool is_stage(const std::string& text) {
  if (text.starts_with('@') || text.starts_with("as:")) return true;
  const std::string name = text.substr(0, text.find(':'));
  return find_operation(name) != nullptr;
}

/// The positionals taken apart: what is read, and the stages.
struct Work {
  std::vector<std::string> inputs;
  std::vector<std::string> stages;
};

Work split(const CommandLine& line) {
  Work work;
  if (line.operation != nullptr) {
    work.inputs = line.positionals;
    return work;
  }
  const auto first_stage = std::find_if(line.positionals.begin(), line.positionals.end(), is_stage);
  work.inputs.assign(line.positionals.begin(), first_stage);
  work.stages.assign(first_stage, line.positionals.end());
  return work;
}

/// A word behind the first stage that is neither a stage nor a file: said here, where the list of names is known.
void check_stages(const Work& work) {
  std::vector<std::string> names;
  for (const Operation* each : operations()) names.push_back(each->name);
  const auto refuse = [&](const std::string& text) {
    const std::string name = text.substr(0, text.find(':'));
    throw Error(Error::Argument,
                fmt::format("{}: no such operation{}; azulejo ops lists them", name, did_you_mean(name, names)));
  };
  for (const std::string& text : work.stages) {
    if (!is_stage(text)) refuse(text);
  }
  // Several inputs and no file of that name: most likely a misspelt stage.
  for (std::size_t i = 1; i < work.inputs.size(); ++i) {
    std::error_code ignored;
    if (!std::filesystem::exists(work.inputs[i], ignored)) refuse(work.inputs[i]);
  }
}

Pipeline build(const CommandLine& line, const Work& work, const std::vector<std::string>& inputs,
               const std::vector<std::string>& outputs, const Run& run) {
  Pipeline pipeline(run, {line.read, line.write, line.read_model, line.write_model});
  std::vector<Pipeline::Place> places;
  places.reserve(inputs.size());
  for (const std::string& input : inputs) places.push_back(pipeline.add_file(input));
  if (line.operation != nullptr) {
    std::vector<std::pair<std::string, std::string>> arguments = line.arguments;
    pipeline.add_operation(*line.operation, arguments, places);
  }
  for (const std::string& stage : work.stages) pipeline.add_stage(stage);
  for (const std::string& output : outputs) pipeline.add_output(output);
  if (!pipeline.has_output()) throw Error(Error::Argument, "-o: missing, expected where the result goes");
  return pipeline;
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

int run_one(const CommandLine& line, const Work& work, const CancelToken& cancel) {
  ProgressBar bar(!line.quiet);
  Run run = make_run(line, cancel, bar);
  run.progress = [&bar](double fraction) { bar.show(fraction, ""); };
  std::optional<StageFolder> stages;
  if (!line.stages.empty() && !line.explain) {
    stages.emplace(line.stages);
    run.stages = &*stages;
  }
  if (line.operation == nullptr && work.inputs.size() > 1) {
    throw Error(Error::Argument,
                fmt::format("{} inputs, expected one; -o with {{name}} in it makes a batch", work.inputs.size()));
  }
  Pipeline pipeline = build(line, work, work.inputs, line.outputs, run);
  if (line.explain) {
    print(pipeline.explain());
    return 0;
  }
  const bool verdict = pipeline.execute(print);
  if (stages) stages->finish();
  return verdict ? 0 : 3;
}

/// What the result of a batch's item depends on beside its input: all words but the inputs.
std::string batch_command(const CommandLine& line, const Work& work) {
  std::string command = std::string("azulejo ") + AZULEJO_VERSION;
  const std::vector<std::string> ignored = {"--force", "--quiet", "-q", "--verbose", "-v", "--json"};
  for (const std::string& word : line.words) {
    const bool input = std::find(work.inputs.begin(), work.inputs.end(), word) != work.inputs.end();
    if (!input && std::find(ignored.begin(), ignored.end(), word) == ignored.end()) command += " " + word;
  }
  return command;
}

std::vector<Manifest::Item> batch_items(const CommandLine& line, const Work& work) {
  std::vector<Manifest::Item> items;
  std::map<std::string, std::string> writer;
  for (const std::string& input : work.inputs) {
    Manifest::Item item{input, {}};
    for (const std::string& output : outputs_for(line.outputs, input)) item.files.push_back(path_of_output(output));
    for (const std::string& file : item.files) {
      const auto [same, added] = writer.emplace(file, input);
      if (!added)
        throw Error(Error::Argument,
                    fmt::format("{}: would be written from {} and from {}", file, same->second, input));
    }
    items.push_back(std::move(item));
  }
  return items;
}

class Batch {
 public:
  Batch(const CommandLine& line, const Work& work, const CancelToken& cancel)
      : line_(line),
        work_(work),
        cancel_(cancel),
        bar_(!line.quiet),
        items_(batch_items(line, work)),
        manifest_(manifest_path(items_[0].files[0]), batch_command(line, work)) {}

  int run() {
    // Small images keep all threads busy best when each thread has an image of its own.
    const Run outer = make_run(line_, cancel_, bar_);
    const bool side_by_side = items_.size() >= static_cast<std::size_t>(thread_count(outer));
    Run inner = outer;
    if (side_by_side) inner.threads = 1;
    Run loop = outer;
    if (!side_by_side) loop.threads = 1;
    try {
      parallel_tasks(items_.size(), loop, [&](std::size_t i, int) { run_item(items_[i], inner); });
    } catch (const Error& error) {
      if (error.kind() != Error::Cancelled) throw;
      summary("cancelled: ");
      throw;
    }
    manifest_.compact();
    summary("");
    return failed_ > 0 ? 1 : verdict_no_ > 0 ? 3 : 0;
  }

 private:
  static std::string manifest_path(const std::string& file) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    return (folder.empty() ? std::filesystem::path(".") : folder) / ".azulejo-batch.jsonl";
  }

  void run_item(const Manifest::Item& item, const Run& run) {
    bar_.show(static_cast<double>(done_ + skipped_ + failed_) / static_cast<double>(items_.size()), item.input);
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
      Pipeline pipeline = build(line_, work_, {item.input}, outputs_for(line_.outputs, item.input), run);
      if (!pipeline.execute(print)) ++verdict_no_;
      manifest_.done(item);
      ++done_;
      if (line_.verbose) bar_.print(fmt::format("{} → {}", item.input, fmt::join(item.files, ", ")));
    } catch (const Error& error) {
      if (error.kind() == Error::Cancelled) throw;
      ++failed_;
      bar_.print(fmt::format("azulejo: {}", error.what()));
    } catch (const std::filesystem::filesystem_error& error) {
      ++failed_;
      bar_.print(fmt::format("azulejo: {}: {}", error.path1().string(), error.code().message()));
    }
  }

  void summary(const std::string& before) {
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

  const CommandLine& line_;
  const Work& work_;
  const CancelToken& cancel_;
  ProgressBar bar_;
  std::vector<Manifest::Item> items_;
  Manifest manifest_;
  std::atomic<int> done_ = 0;
  std::atomic<int> skipped_ = 0;
  std::atomic<int> failed_ = 0;
  std::atomic<int> verdict_no_ = 0;
};

}  // namespace

int run_command(const CommandLine& line, const CancelToken& cancel) {
  const Work work = split(line);
  if (line.operation == nullptr) check_stages(work);
  const bool generator = line.operation != nullptr && line.operation->inputs.empty();
  if (work.inputs.empty() && !generator && !(line.operation == nullptr && !work.stages.empty())) {
    throw Error(Error::Argument,
                fmt::format("{}: input missing, expected a file or - for standard input", line.command));
  }
  if (!is_batch(line.outputs)) return run_one(line, work, cancel);
  if (work.inputs.empty()) throw Error(Error::Argument, "a batch needs inputs");
  if (line.explain || !line.stages.empty())
    throw Error(Error::Argument, "--explain and --stages are for one input, not for a batch");
  for (const std::string& output : line.outputs) {
    if (output.find("{name}") == std::string::npos && work.inputs.size() > 1) {
      throw Error(Error::Argument,
                  fmt::format("-o {}: every item of the batch would write it, expected {{name}} in it", output));
    }
  }
  return Batch(line, work, cancel).run();
}

}  // namespace azulejo::cli
