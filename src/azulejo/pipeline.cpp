#include "azulejo/pipeline.h"

#include <algorithm>

#include <fmt/format.h>

#include "azulejo/conversion.h"
#include "azulejo/core/error.h"
#include "azulejo/core/text.h"
#include "azulejo/io/input.h"
#include "azulejo/lifting.h"
#include "azulejo/pipeline_parts.h"

namespace azulejo {

Pipeline::Pipeline(Run run, FileOptions files, std::span<const Operation* const> operations)
    : run_(std::move(run)), files_(std::move(files)), operations_(operations) {}
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline::~Pipeline() = default;

Pipeline::Place Pipeline::add_file(const std::string& path) {
  const std::shared_ptr<const Input> input = open_input(path, run_.limits.memory_bytes);
  if (files_.read_model.raw || is_model_file(*input)) {
    Model model = read_model(input, files_.read_model, run_);
    return add_value(std::visit([](auto& held) { return Value(std::move(held)); }, model), path);
  }
  Step step;
  step.label = path;
  step.source = open_image(input, files_.read_image, run_);
  step.refs = {graph_.add_source(step.source, path)};
  steps_.push_back(std::move(step));
  return current_ = {static_cast<int>(steps_.size()) - 1, 0};
}

Pipeline::Place Pipeline::add_value(Value value, std::string label) {
  Step step;
  step.label = std::move(label);
  if (value.image() != nullptr) {
    step.source = std::make_shared<ValueSource>(value);
    step.refs = {graph_.add_source(step.source, step.label)};
  }
  step.values.push_back(std::move(value));
  steps_.push_back(std::move(step));
  return current_ = {static_cast<int>(steps_.size()) - 1, 0};
}

const Operation& Pipeline::operation(std::string_view name) const {
  std::vector<std::string> names;
  for (const Operation* each : operations_) {
    if (each->name == name) return *each;
    names.push_back(each->name);
  }
  throw Error(Error::Argument,
              fmt::format("{}: no such operation{}; azulejo ops lists them", name, did_you_mean(name, names)));
}

/// "a" or "a.output", without the @.
Pipeline::Place Pipeline::find(std::string_view reference) const {
  const std::size_t dot = reference.find('.');
  const std::string_view name = reference.substr(0, dot);
  for (std::size_t i = names_.size(); i-- > 0;) {
    const auto& [known, place] = names_[i];
    if (known != name) continue;
    if (dot == std::string_view::npos) return place;
    const Operation* made_by = steps_[static_cast<std::size_t>(place.step)].operation;
    std::vector<std::string> outputs;
    if (made_by != nullptr) {
      for (const Port& port : made_by->outputs) outputs.push_back(port.name);
    }
    const std::string_view wanted = reference.substr(dot + 1);
    const auto found = std::find(outputs.begin(), outputs.end(), wanted);
    if (found != outputs.end()) return {place.step, static_cast<int>(found - outputs.begin())};
    throw Error(Error::Argument, fmt::format("@{}: no output \"{}\"; expected {}", reference, wanted,
                                             outputs.empty() ? "none" : fmt::format("{}", fmt::join(outputs, ", "))));
  }
  std::vector<std::string> known;
  for (const auto& [each, place] : names_) known.push_back(each);
  throw Error(Error::Argument, fmt::format("@{}: nothing was named so{}; expected as:{} before", reference,
                                           did_you_mean(name, known), name));
}

void Pipeline::add_stage(std::string_view text, std::span<const Place> inputs) {
  if (text.starts_with('@')) {
    current_ = find(text.substr(1));
    return;
  }
  if (text.starts_with("as:")) {
    const std::string_view name = text.substr(3);
    if (!is_name(name))
      throw Error(Error::Argument, fmt::format("as: \"{}\", expected a name of letters, digits and _", name));
    if (current_.step < 0) throw Error(Error::Argument, fmt::format("as:{}: there is nothing to name yet", name));
    names_.emplace_back(std::string(name), current_);
    return;
  }
  const StageText stage = parse_stage(text);
  add_operation(operation(stage.name), stage.arguments, inputs);
}

Pipeline::Place Pipeline::argument_input(const std::string& text) {
  if (text.starts_with('@')) return find(std::string_view(text).substr(1));
  const Place before = current_;
  const Place place = add_file(text);
  current_ = before;
  return place;
}

Pipeline::Place Pipeline::add_operation(const Operation& operation, const Arguments& arguments,
                                        std::span<const Place> inputs) {
  Step step;
  step.operation = &operation;
  step.label = fmt::format("{}-{}", operations_added_ + 1, operation.name);
  step.inputs.assign(inputs.begin(), inputs.end());
  step.inputs.resize(std::max(inputs.size(), operation.inputs.size()));
  const Arguments options = take_inputs(step, arguments);
  if (!operation.variants.empty()) {
    const bool takes_current = inputs.empty() && step.inputs[0].step < 0;
    const Place first = takes_current ? current_ : step.inputs[0];
    if (first.step >= 0) step.operation = &variant_for(operation, kind(first));
  }
  step.options = step.operation->make_options();
  for (const auto& [name, text] : options) parse_option(step, name, text);
  if (step.selection && step.selection->options.feather > 0 && !step.selection->options.rect &&
      step.selection->mask.step < 0) {
    throw Error(Error::Argument, fmt::format("{}: feather: without an area, expected within", operation.name));
  }
  bind(step, inputs.empty());
  steps_.push_back(std::move(step));
  ++operations_added_;
  build(steps_.size() - 1);
  return current_ = {static_cast<int>(steps_.size()) - 1, 0};
}

/// Takes the inputs among the arguments, and gives back the others.
Pipeline::Arguments Pipeline::take_inputs(Step& step, const Arguments& arguments) {
  const std::vector<Port>& ports = step.operation->inputs;
  Arguments others;
  for (const auto& [name, text] : arguments) {
    const auto port = std::ranges::find(ports, name, &Port::name);
    if (port == ports.end()) {
      others.emplace_back(name, text);
      continue;
    }
    Place& place = step.inputs[static_cast<std::size_t>(port - ports.begin())];
    if (port->repeated && place.step >= 0) {
      step.inputs.push_back(argument_input(text));
    } else {
      place = argument_input(text);
    }
  }
  return others;
}

void Pipeline::parse_option(Step& step, const std::string& name, const std::string& text) {
  const Operation& operation = *step.operation;
  const Field* const field = operation.find_field(name);
  if (field == nullptr && select(step, name, text)) return;
  if (field == nullptr) {
    std::vector<std::string> known;
    for (const Field& each : operation.fields) known.push_back(each.name);
    for (const Port& each : operation.inputs) known.push_back(each.name);
    throw Error(Error::Argument, fmt::format("{}: no option \"{}\"{}; expected {}", operation.name, name,
                                             did_you_mean(name, known), fmt::join(known, ", ")));
  }
  try {
    field->parse(step.options.get(), text);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", operation.name, error.what()));
  }
}

/// Gives the current value, if it is not among the inputs already, to the first that has none, and checks the kinds.
void Pipeline::bind(Step& step, bool takes_current) {
  const Operation& operation = *step.operation;
  if (operation.inputs.empty()) return operation.check_count(step.inputs.size());
  const auto free = std::ranges::find_if(step.inputs, [](const Place& place) { return place.step < 0; });
  // Of inputs that may be left out it is given to the first one only.
  if (takes_current && free != step.inputs.end() &&
      (free == step.inputs.begin() ||
       !operation.input(static_cast<std::size_t>(free - step.inputs.begin())).optional)) {
    *free = current_;
  }
  while (!step.inputs.empty() && step.inputs.back().step < 0 && operation.input(step.inputs.size() - 1).optional) {
    step.inputs.pop_back();
  }
  for (std::size_t i = 0; i < step.inputs.size(); ++i) {
    const Place& input = step.inputs[i];
    const Port& port = operation.input(i);
    if (input.step < 0)
      throw Error(Error::Argument,
                  fmt::format("{}: {}: missing, expected {}", operation.name, port.name, to_string(port.kind)));
    if (!converts(kind(input), port.kind)) {
      throw Error(Error::Argument, fmt::format("{}: {}: {}", operation.name, port.name, mismatch(input, port.kind)));
    }
  }
  operation.check_count(step.inputs.size());
  step.lifted = is_liftable(operation) && kind(step.inputs[0]) == ValueKind::Scene;
}

/// "got scene from box.glb, expected image (render makes one)"
std::string Pipeline::mismatch(Place got, ValueKind expected) const {
  const ValueKind from = kind(got);
  const char* const maker = from == ValueKind::Drawing ? "draw" : converts(from, ValueKind::Scene) ? "render" : "";
  const bool drawn = expected == ValueKind::Image &&
                     std::ranges::any_of(operations_, [&](const Operation* each) { return each->name == maker; });
  return fmt::format("got {} from {}, expected {}{}", to_string(from), label(got), to_string(expected),
                     drawn ? fmt::format(" ({} makes one)", maker) : "");
}

ValueKind Pipeline::kind(Place place) const {
  const Step& step = steps_[static_cast<std::size_t>(place.step)];
  if (step.operation != nullptr) {
    const ValueKind declared = step.operation->outputs[static_cast<std::size_t>(place.output)].kind;
    return step.lifted ? lifted_kind(declared) : declared;
  }
  return step.values.empty() ? ValueKind::Image : step.values[0].kind();
}

std::string Pipeline::label(Place place) const {
  const Step& step = steps_[static_cast<std::size_t>(place.step)];
  return step.operation != nullptr ? step.operation->name : step.label;
}

/// Adds the step's node to the graph: the check that its images fit. Later, if they aren't known yet.
void Pipeline::build(std::size_t index) {
  Step& step = steps_[index];
  if (step.operation->make_node == nullptr) return step.operation->check(step.options.get());
  std::vector<ImageInfo> infos;
  std::vector<ValueRef> sources;
  for (const Place input : step.inputs) {
    const ValueRef image = ref(input);
    if (image.vertex < 0) return step.operation->check(step.options.get());
    infos.push_back(graph_.info(image));
    sources.push_back(image);
  }
  if (step.selection && step.selection->mask.step >= 0 && ref(step.selection->mask).vertex < 0) {
    return step.operation->check(step.options.get());
  }
  const ValueRef source = sources.empty() ? ValueRef{} : sources[0];
  step.vertex = graph_
                    .add_node(make_node(*step.operation, step.options.get(), infos), std::move(sources), step.label,
                              image_names(*step.operation))
                    .vertex;
  int result = 0;
  for (const Port& port : step.operation->outputs) {
    step.refs.push_back(port.kind == ValueKind::Report ? ValueRef{} : ValueRef{step.vertex, result++});
  }
  if (step.selection) keep_within(step, source);
}

/// Where an image is in the graph; of a value that is computed already it is put there. Vertex -1: it comes out of an
/// operation that must run first.
ValueRef Pipeline::ref(Place place) {
  Step& step = steps_[static_cast<std::size_t>(place.step)];
  const auto output = static_cast<std::size_t>(place.output);
  if (output < step.refs.size() && step.refs[output].vertex >= 0) return step.refs[output];
  if (output >= step.values.size() || step.values[output].empty()) return {};
  step.refs.resize(std::max(step.refs.size(), output + 1));
  auto source = std::make_shared<ValueSource>(convert(step.values[output], ValueKind::Image, run_));
  return step.refs[output] = graph_.add_source(std::move(source), step.label);
}

/// The file's or value's at the head of the chain of first inputs.
const Metadata& Pipeline::metadata(Place place) const {
  static const Metadata none;
  const Step* step = &steps_[static_cast<std::size_t>(place.step)];
  while (step->operation != nullptr) {
    if (step->inputs.empty()) return none;
    step = &steps_[static_cast<std::size_t>(step->inputs[0].step)];
  }
  return step->source ? step->source->metadata() : none;
}

}  // namespace azulejo
