#include <algorithm>

#include <fmt/format.h>

#include "azulejo/conversion.h"
#include "azulejo/core/error.h"
#include "azulejo/lifting.h"
#include "azulejo/pipeline.h"
#include "azulejo/pipeline_parts.h"

namespace azulejo {

std::string Pipeline::explain() {
  struct Nowhere final : ImageSink {
    void write(const ConstAnyView&) override {}
    void finish() override {}
  } nowhere;
  std::vector<Target> targets;
  std::string text;
  for (const Step& step : steps_) {
    if (step.operation != nullptr && step.operation->make_node == nullptr)
      text += fmt::format("{}: at once, in memory{}\n", step.label, step.lifted ? ", mesh by mesh" : "");
  }
  for (const Output& output : outputs_) {
    const bool image = converts(kind(output.place), ValueKind::Image);
    const ValueRef drawn = image ? ref(output.place) : ValueRef{};
    if (drawn.vertex >= 0) {
      targets.push_back({drawn, {}, &nowhere});
    } else if (image) {
      text += fmt::format("{} is planned once its inputs are known\n", label(output.place));
    } else {
      text += fmt::format("{}: {} from {}\n", output.path, to_string(kind(output.place)), label(output.place));
    }
  }
  add_report_targets(targets);
  return text + azulejo::explain(graph_, targets, run_);
}

/// What a place holds: everything it stands on is computed now.
Value Pipeline::value(Place place) {
  Step& step = steps_[static_cast<std::size_t>(place.step)];
  const auto output = static_cast<std::size_t>(place.output);
  if (output < step.values.size() && !step.values[output].empty()) return step.values[output];
  if (step.vertex >= 0 && kind(place) == ValueKind::Report) return measured(place);
  const ValueRef drawn = ref(place);
  if (drawn.vertex < 0) {
    throw Error(Error::Argument,
                fmt::format("{} gives no {} with these options", label(place), step.operation->outputs[output].name));
  }
  Image image(graph_.info(drawn), run_.limits);
  image.set_metadata(metadata(place));
  const Target targets[] = {{drawn, image.any(), nullptr}};
  azulejo::execute(graph_, targets, run_);
  step.values.resize(std::max(step.values.size(), output + 1));
  return step.values[output] = Value(std::move(image));
}

/// The report of an operation on tiles, gathered now.
Value Pipeline::measured(Place place) {
  const Target targets[] = {report_target(place)};
  azulejo::execute(graph_, targets, run_);
  return steps_[static_cast<std::size_t>(place.step)].values[static_cast<std::size_t>(place.output)];
}

Target Pipeline::report_target(Place place) {
  Step& step = steps_[static_cast<std::size_t>(place.step)];
  step.values.resize(step.operation->outputs.size());
  const TileNode& node = *graph_.vertices()[static_cast<std::size_t>(step.vertex)].node;
  Value& value = step.values[static_cast<std::size_t>(place.output)];
  return {.value = {step.vertex, 0},
          .analysed = [&](std::span<const Analysis* const> analyses) { value = Value(node.report(analyses)); }};
}

/// Those reports of operations on tiles that are written or printed.
void Pipeline::add_report_targets(std::vector<Target>& targets) {
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    if (steps_[s].vertex < 0) continue;
    for (std::size_t o = 0; o < steps_[s].operation->outputs.size(); ++o) {
      const Place place{static_cast<int>(s), static_cast<int>(o)};
      if (kind(place) == ValueKind::Report && is_wanted(place)) targets.push_back(report_target(place));
    }
  }
}

/// What an input holds, as the kind that the operation takes.
Value Pipeline::input_value(const Step& step, std::size_t input) {
  Value held = value(step.inputs[input]);
  if (step.lifted && input == 0) return held;
  const Port& port = step.operation->inputs[input];
  try {
    return convert(held, port.kind, run_);
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled) throw;
    throw Error(error.kind(), fmt::format("{}: {}: {}", step.operation->name, port.name, error.what()));
  }
}

void Pipeline::run_steps() {
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    Step& step = steps_[s];
    if (step.operation == nullptr || !step.refs.empty() || !step.values.empty()) continue;
    if (step.operation->make_node != nullptr) {
      for (const Place input : step.inputs) {
        if (ref(input).vertex < 0) value(input);  // throws: it says what is missing
      }
      if (step.selection && step.selection->mask.step >= 0) value(step.selection->mask);
      build(s);
      continue;
    }
    choose_float_output(s);
    std::vector<Value> inputs;
    for (std::size_t i = 0; i < step.inputs.size(); ++i) inputs.push_back(input_value(step, i));
    step.values = step.lifted ? invoke_lifted(*step.operation, step.options.get(), inputs, run_, step.label)
                              : invoke(*step.operation, step.options.get(), inputs, run_, step.label);
    if (step.selection) step.values[0] = kept_within(step, inputs[0]);
  }
}

Value Pipeline::compute() {
  if (current_.step < 0) throw Error(Error::Argument, "there is nothing to compute");
  run_steps();
  return value(current_);
}

bool Pipeline::execute(const std::function<void(const std::string&)>& print) {
  run_steps();
  std::vector<std::unique_ptr<ImageSink>> sinks;
  std::vector<Target> targets;
  for (const Output& output : outputs_) {
    if (kind(output.place) == ValueKind::Report || written_whole(output)) continue;
    sinks.push_back(make_sink(output));
    targets.push_back({ref(output.place), {}, sinks.back().get()});
  }
  add_report_targets(targets);
  azulejo::execute(graph_, targets, run_);
  for (const Output& output : outputs_) {
    if (written_whole(output)) write_whole(output);
  }
  return print_reports(print);
}

}  // namespace azulejo
