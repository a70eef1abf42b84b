#include "run_command.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/text.h"
#include "azulejo/pipeline.h"
#include "batch.h"
#include "batch_run.h"
#include "sequence.h"
#include "stage_folder.h"

namespace azulejo::cli {
namespace {

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

/// What is read, and what is done to it.
Pipeline chain(const CommandLine& line, const Work& work, const std::vector<std::string>& inputs, const Run& run) {
  Pipeline pipeline(run, {line.read, line.write, line.read_model, line.write_model});
  std::vector<Pipeline::Place> places;
  places.reserve(inputs.size());
  for (const std::string& input : inputs) places.push_back(pipeline.add_file(input));
  if (line.operation != nullptr) {
    pipeline.add_operation(*line.operation, arguments_with_layers(line), places);
  }
  for (std::size_t s = 0; s < work.stages.size(); ++s) {
    if (s == 0 && places.size() > 1) {
      pipeline.add_stage(work.stages[s], places);
    } else {
      pipeline.add_stage(work.stages[s]);
    }
  }
  return pipeline;
}

Pipeline build(const CommandLine& line, const Work& work, const std::vector<std::string>& inputs,
               const std::vector<std::string>& outputs, const Run& run) {
  Pipeline pipeline = chain(line, work, inputs, run);
  for (const std::string& output : outputs) pipeline.add_output(output);
  if (!pipeline.has_output()) throw Error(Error::Argument, "-o: missing, expected where the result goes");
  return pipeline;
}

/// Whether the first stage has more inputs than one.
bool takes_several(const Work& work) {
  if (work.stages.empty()) return false;
  const Operation* const first = find_operation(work.stages[0].substr(0, work.stages[0].find(':')));
  return first != nullptr && (first->inputs.size() > 1 || (!first->inputs.empty() && first->inputs.back().repeated));
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
  if (line.operation == nullptr && work.inputs.size() > 1 && !takes_several(work)) {
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

int run_batch(const CommandLine& line, const Work& work, const CancelToken& cancel) {
  return BatchRun(line, work.inputs, batch_items(line, work), cancel).side_by_side([&](std::size_t i, const Run& run) {
    const std::string& input = work.inputs[i];
    return build(line, work, {input}, outputs_for(line.outputs, input), run).execute(print);
  });
}

}  // namespace

Pipeline chain_of(const CommandLine& line, const Run& run) {
  const Work work = split(line);
  if (line.operation == nullptr) check_stages(work);
  return chain(line, work, work.inputs, run);
}

int run_command(const CommandLine& line, const CancelToken& cancel) {
  if (is_sequence(line)) return sequence_command(line, cancel);
  const Work work = split(line);
  if (line.operation == nullptr) check_stages(work);
  const bool generator = line.operation != nullptr && std::ranges::all_of(line.operation->inputs, &Port::optional);
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
  return run_batch(line, work, cancel);
}

}  // namespace azulejo::cli
