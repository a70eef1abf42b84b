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
  return text + azulejo::explain(graph_, targets, run_);
}

/// What a place holds: everything it stands on is computed now.
Value Pipeline::value(Place place) {
  Step& step = steps_[static_cast<std::size_t>(place.step)];
  const auto output = static_cast<std::size_t>(place.output);
  if (output < step.values.size() && !step.values[output].empty()) return step.values[output];
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

/// What an input holds, as the kind that the operation takes.
Value Pipeline::input_value(const Step& step, std::size_t input) {
  const Value held = value(step.inputs[input]);
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
      build(s);
      continue;
    }
    choose_float_output(s);
    std::vector<Value> inputs;
    for (std::size_t i = 0; i < step.inputs.size(); ++i) inputs.push_back(input_value(step, i));
    step.values = step.lifted ? invoke_lifted(*step.operation, step.options.get(), inputs, run_, step.label)
                              : invoke(*step.operation, step.options.get(), inputs, run_, step.label);
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
  azulejo::execute(graph_, targets, run_);
  for (const Output& output : outputs_) {
    if (written_whole(output)) write_whole(output);
  }
  return print_reports(print);
}

}  // namespace azulejo
