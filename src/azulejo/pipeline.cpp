#include "azulejo/pipeline.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/text.h"
#include "azulejo/io/text_file.h"

namespace azulejo {
namespace {

constexpr const char* kVersion = AZULEJO_VERSION;

bool is_name(std::string_view text) {
  return !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_') &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

/// `name=` at the start of `text`: the name's length, else 0.
std::size_t leading_name(std::string_view text) {
  const std::size_t equals = text.find('=');
  return equals != std::string_view::npos && is_name(text.substr(0, equals)) ? equals : 0;
}

/// Options are written with _ in code and with either on the command line.
std::string option_name(std::string_view text) {
  std::string name(text);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Where the argument that begins at `text` ends: before a comma outside quotes that `name=` follows.
std::size_t argument_end(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quote != 0) {
      if (text[i] == quote) quote = 0;
    } else if (text[i] == '"' || text[i] == '\'') {
      quote = text[i];
    } else if (text[i] == ',' && leading_name(text.substr(i + 1)) > 0) {
      return i;
    }
  }
  if (quote != 0) throw Error(Error::Argument, fmt::format("{}: a quote {} is not closed", text, quote));
  return text.size();
}

std::string unquoted(std::string_view text) {
  std::string result;
  char quote = 0;
  for (const char c : text) {
    if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    } else {
      result += c;
    }
  }
  return result;
}

/// A value of the chain as a source of the graph.
class ValueSource final : public ImageSource {
 public:
  explicit ValueSource(Value value) : value_(std::move(value)) {}
  const ImageInfo& info() const override { return value_.image()->info(); }
  const Metadata& metadata() const override { return value_.image()->metadata(); }
  const Image* image() const override { return value_.image(); }
  std::unique_ptr<RowReader> rows(const Run&) override { return nullptr; }

 private:
  Value value_;
};

}  // namespace

StageText parse_stage(std::string_view text) {
  StageText stage;
  const std::size_t colon = text.find(':');
  stage.name = std::string(text.substr(0, colon));
  if (colon == std::string_view::npos) return stage;
  std::string_view rest = text.substr(colon + 1);
  while (!rest.empty()) {
    const std::size_t end = argument_end(rest);
    const std::string_view argument = rest.substr(0, end);
    if (const std::size_t length = leading_name(argument); length > 0) {
      stage.arguments.emplace_back(option_name(argument.substr(0, length)), unquoted(argument.substr(length + 1)));
    } else if (is_name(argument)) {
      stage.arguments.emplace_back(option_name(argument), "true");
    } else {
      throw Error(Error::Argument, fmt::format("{}: \"{}\", expected name=value", stage.name, argument));
    }
    rest = end < rest.size() ? rest.substr(end + 1) : std::string_view();
  }
  return stage;
}

struct Pipeline::Step {
  const Operation* operation = nullptr;  ///< null: a source
  std::string label;
  std::shared_ptr<void> options;
  std::vector<Place> inputs;
  std::shared_ptr<ImageSource> source;
  std::vector<Value> values;   ///< by output, where they are computed
  std::vector<ValueRef> refs;  ///< by output: where it is in the graph; empty before it is known
};

struct Pipeline::Output {
  Place place;
  std::string path;
};

Pipeline::Pipeline(Run run, ReadOptions read, WriteOptions write, std::span<const Operation* const> operations)
    : run_(std::move(run)), read_(std::move(read)), write_(std::move(write)), operations_(operations) {}
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline::~Pipeline() = default;

Pipeline::Place Pipeline::add_file(const std::string& path) {
  Step step;
  step.label = path;
  step.source = open_image(path, read_, run_);
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
  for (auto each = names_.rbegin(); each != names_.rend(); ++each) {
    if (each->first != name) continue;
    if (dot == std::string_view::npos) return each->second;
    const Operation* made_by = steps_[static_cast<std::size_t>(each->second.step)].operation;
    std::vector<std::string> outputs;
    if (made_by != nullptr) {
      for (const Port& port : made_by->outputs) outputs.push_back(port.name);
    }
    const std::string_view wanted = reference.substr(dot + 1);
    const auto found = std::find(outputs.begin(), outputs.end(), wanted);
    if (found != outputs.end()) return {each->second.step, static_cast<int>(found - outputs.begin())};
    throw Error(Error::Argument, fmt::format("@{}: no output \"{}\"; expected {}", reference, wanted,
                                             outputs.empty() ? "none" : fmt::format("{}", fmt::join(outputs, ", "))));
  }
  std::vector<std::string> known;
  for (const auto& [each, place] : names_) known.push_back(each);
  throw Error(Error::Argument, fmt::format("@{}: nothing was named so{}; expected as:{} before", reference,
                                           did_you_mean(name, known), name));
}

void Pipeline::add_stage(std::string_view text) {
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
  add_operation(operation(stage.name), stage.arguments);
}

Pipeline::Place Pipeline::argument_input(const std::string& text) {
  if (text.starts_with('@')) return find(std::string_view(text).substr(1));
  const Place before = current_;
  const Place place = add_file(text);
  current_ = before;
  return place;
}

Pipeline::Place Pipeline::add_operation(const Operation& operation,
                                        const std::vector<std::pair<std::string, std::string>>& arguments,
                                        std::span<const Place> inputs) {
  Step step;
  step.operation = &operation;
  step.label = fmt::format("{}-{}", operations_added_ + 1, operation.name);
  step.options = operation.make_options();
  step.inputs.resize(operation.inputs.size());
  if (inputs.size() > operation.inputs.size()) {
    throw Error(Error::Argument,
                fmt::format("{}: {} inputs, expected {}", operation.name, inputs.size(), operation.inputs.size()));
  }
  std::copy(inputs.begin(), inputs.end(), step.inputs.begin());

  for (const auto& [name, text] : arguments) {
    const auto port = std::find_if(operation.inputs.begin(), operation.inputs.end(),
                                   [&wanted = name](const Port& each) { return each.name == wanted; });
    if (port != operation.inputs.end()) {
      step.inputs[static_cast<std::size_t>(port - operation.inputs.begin())] = argument_input(text);
      continue;
    }
    const Field* const field = operation.find_field(name);
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
  bind(step);
  steps_.push_back(std::move(step));
  ++operations_added_;
  build(steps_.size() - 1);
  return current_ = {static_cast<int>(steps_.size()) - 1, 0};
}

/// Gives the current value to the first input that has none, and checks the kinds.
void Pipeline::bind(Step& step) {
  const Operation& operation = *step.operation;
  bool current_used = current_.step < 0;
  for (std::size_t i = 0; i < step.inputs.size(); ++i) {
    Place& input = step.inputs[i];
    const Port& port = operation.inputs[i];
    if (input.step < 0 && !current_used) {
      input = current_;
      current_used = true;
    }
    if (input.step < 0)
      throw Error(Error::Argument,
                  fmt::format("{}: {}: missing, expected {}", operation.name, port.name, to_string(port.kind)));
    if (kind(input) != port.kind) {
      throw Error(Error::Argument, fmt::format("{}: {}: got {} from {}, expected {}", operation.name, port.name,
                                               to_string(kind(input)), label(input), to_string(port.kind)));
    }
  }
}

ValueKind Pipeline::kind(Place place) const {
  const Step& step = steps_[static_cast<std::size_t>(place.step)];
  if (step.operation != nullptr) return step.operation->outputs[static_cast<std::size_t>(place.output)].kind;
  if (!step.values.empty() && step.values[0].labels() != nullptr) return ValueKind::Labels;
  if (!step.values.empty() && step.values[0].report() != nullptr) return ValueKind::Report;
  return ValueKind::Image;
}

std::string Pipeline::label(Place place) const {
  const Step& step = steps_[static_cast<std::size_t>(place.step)];
  return step.operation != nullptr ? step.operation->name : step.label;
}

/// What is known of an image before it is computed; null if it comes out of an operation that must run first.
const ImageInfo* Pipeline::known_info(Place place) const {
  const Step& step = steps_[static_cast<std::size_t>(place.step)];
  return step.refs.empty() ? nullptr : &graph_.info(step.refs[static_cast<std::size_t>(place.output)]);
}

ValueRef Pipeline::ref(Place place) const {
  return steps_[static_cast<std::size_t>(place.step)].refs[static_cast<std::size_t>(place.output)];
}

/// Adds the step's node to the graph: the check that its images fit. Later, if they aren't known yet.
void Pipeline::build(std::size_t index) {
  Step& step = steps_[index];
  if (step.operation->make_node == nullptr) return step.operation->check(step.options.get());
  std::vector<ImageInfo> infos;
  std::vector<ValueRef> sources;
  for (const Place input : step.inputs) {
    const ImageInfo* const info = known_info(input);
    if (info == nullptr) return step.operation->check(step.options.get());
    infos.push_back(*info);
    sources.push_back(ref(input));
  }
  std::vector<std::string> result_names;
  for (const Port& port : step.operation->outputs) result_names.push_back(port.name);
  const ValueRef first = graph_.add_node(make_node(*step.operation, step.options.get(), infos), std::move(sources),
                                         step.label, std::move(result_names));
  for (int o = 0; o < static_cast<int>(step.operation->outputs.size()); ++o) step.refs.push_back({first.vertex, o});
}

void Pipeline::add_output(const std::string& text) {
  if (current_.step < 0) throw Error(Error::Argument, fmt::format("{}: there is nothing to write", text));
  Output output{current_, text};
  if (const std::size_t length = leading_name(text); length > 0 || text.find('=') != std::string::npos) {
    const std::string name = text.substr(0, text.find('='));
    const Operation* const last = steps_[static_cast<std::size_t>(current_.step)].operation;
    bool found = false;
    for (std::size_t o = 0; last != nullptr && o < last->outputs.size(); ++o) {
      if (last->outputs[o].name != name) continue;
      output = {{current_.step, static_cast<int>(o)}, text.substr(name.size() + 1)};
      found = true;
    }
    const std::string_view stem = std::string_view(name).substr(0, name.find('.'));
    const bool named = std::any_of(names_.begin(), names_.end(), [&](const auto& each) { return each.first == stem; });
    if (!found && named) output = {find(name), text.substr(name.size() + 1)};
    if (!found && !named && is_name(name)) {
      throw Error(Error::Argument, fmt::format("-o {}: \"{}\" is no output of {} and nothing was named so", text, name,
                                               label(current_)));
    }
  }
  const ValueKind what = kind(output.place);
  if (what == ValueKind::Image && output.path != "-" && !is_image_path(output.path)) {
    throw Error(Error::Argument, fmt::format("{}: can't tell the image format from the ending, expected one of {}",
                                             output.path, fmt::join(image_endings_written(), ", ")));
  }
  if (what == ValueKind::Labels)
    throw Error(Error::Unsupported, fmt::format("{}: labels can't be written yet", output.path));
  for (const Output& each : outputs_) {
    if (each.path == output.path) throw Error(Error::Argument, fmt::format("-o {}: given twice", output.path));
  }
  outputs_.push_back(std::move(output));
}

bool Pipeline::has_output() const {
  if (!outputs_.empty()) return true;
  return std::any_of(steps_.begin(), steps_.end(), [](const Step& step) {
    return step.operation != nullptr && step.operation->outputs[0].kind == ValueKind::Report;
  });
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

std::string Pipeline::explain() {
  struct Nowhere final : ImageSink {
    void write(const ConstAnyView&) override {}
    void finish() override {}
  } nowhere;
  std::vector<Target> targets;
  std::string text;
  for (const Output& output : outputs_) {
    const Step& step = steps_[static_cast<std::size_t>(output.place.step)];
    if (!step.refs.empty()) {
      targets.push_back({ref(output.place), {}, &nowhere});
    } else {
      text += fmt::format("{} is planned once its inputs are known\n", label(output.place));
    }
  }
  return text + azulejo::explain(graph_, targets, run_);
}

/// An input of an operation that is not computed by tiles: everything it stands on is computed now.
Value Pipeline::value(Place place) {
  Step& step = steps_[static_cast<std::size_t>(place.step)];
  const auto output = static_cast<std::size_t>(place.output);
  if (output < step.values.size() && !step.values[output].empty()) return step.values[output];
  if (step.refs.empty()) throw Error(Error::Argument, fmt::format("{}: has no value", step.label));
  Image image(graph_.info(ref(place)), run_.limits);
  image.set_metadata(metadata(place));
  const Target targets[] = {{ref(place), image.any(), nullptr}};
  azulejo::execute(graph_, targets, run_);
  step.values.resize(std::max(step.values.size(), output + 1));
  return step.values[output] = Value(std::move(image));
}

void Pipeline::run_steps() {
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    Step& step = steps_[s];
    if (step.operation == nullptr || !step.refs.empty()) continue;
    if (step.operation->make_node != nullptr) {
      build(s);
      continue;
    }
    std::vector<Value> inputs;
    for (const Place input : step.inputs) inputs.push_back(value(input));
    step.values = step.operation->invoke(inputs, step.options.get(), run_);
    for (const Value& each : step.values) {
      const bool image = each.image() != nullptr;
      step.refs.push_back(image ? graph_.add_source(std::make_shared<ValueSource>(each), step.label) : ValueRef{});
    }
  }
}

/// Reports that no output takes are printed. False if one's verdict is no.
bool Pipeline::print_reports(const std::function<void(const std::string&)>& print) {
  bool verdict = true;
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    if (step.operation == nullptr) continue;
    for (std::size_t o = 0; o < step.values.size(); ++o) {
      const Report* const report = step.values[o].report();
      if (report == nullptr) continue;
      verdict = verdict && report->verdict;
      Json json = Json::object();
      json.set("azulejo", kVersion).set("operation", step.operation->name);
      for (const std::string& key : report->json.keys()) json.set(key, report->json[key]);
      const auto taken = std::find_if(outputs_.begin(), outputs_.end(), [&](const Output& output) {
        return output.place.step == static_cast<int>(s) && output.place.output == static_cast<int>(o);
      });
      const std::string text = json.dump() + "\n";
      if (taken == outputs_.end() || taken->path == "-") {
        print(text);
        continue;
      }
      write_text_file(taken->path, text);
    }
  }
  return verdict;
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
    if (kind(output.place) != ValueKind::Image) continue;
    const ValueRef value = ref(output.place);
    sinks.push_back(create_image(output.path, graph_.info(value), metadata(output.place), write_, run_));
    targets.push_back({value, {}, sinks.back().get()});
  }
  azulejo::execute(graph_, targets, run_);
  return print_reports(print);
}

}  // namespace azulejo
