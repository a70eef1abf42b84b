#include "azulejo/engine/operation.h"

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/graph.h"
#include "azulejo/engine/stages.h"

namespace azulejo {
namespace {

/// Throws the error again, its message beginning with the operation's name.
[[noreturn]] void rethrow_named(const Operation& operation, const Error& error) {
  throw Error(error.kind(), fmt::format("{}: {}", operation.name, error.what()));
}

/// Gives what an operation reports under its own name the name of its step.
class StepStages final : public Stages {
 public:
  StepStages(Stages& stages, std::string operation, std::string step)
      : stages_(stages), operation_(std::move(operation)), step_(std::move(step)) {}
  void image(const std::string& step, const std::string& name, const Image& image) override {
    stages_.image(named(step), name, image);
  }
  void mesh(const std::string& step, const std::string& name, const Mesh& mesh) override {
    stages_.mesh(named(step), name, mesh);
  }
  void drawing(const std::string& step, const std::string& name, const Drawing& drawing) override {
    stages_.drawing(named(step), name, drawing);
  }
  void report(const std::string& step, const std::string& name, const Json& report) override {
    stages_.report(named(step), name, report);
  }

 private:
  const std::string& named(const std::string& step) const { return step == operation_ ? step_ : step; }

  Stages& stages_;
  std::string operation_;
  std::string step_;
};

void check_inputs(const Operation& operation, std::span<const Value> inputs) {
  operation.check_count(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Port& port = operation.input(i);
    if (inputs[i].empty() || inputs[i].kind() != port.kind) {
      throw Error(Error::Argument,
                  fmt::format("{}: {}: got {}, expected {}", operation.name, port.name,
                              inputs[i].empty() ? "nothing" : to_string(inputs[i].kind()), to_string(port.kind)));
    }
  }
}

bool overlap(const ConstAnyView& a, const ConstAnyView& b) {
  const auto end = [](const ConstAnyView& view) { return view.row(view.info.height - 1) + view.info.row_bytes(); };
  return a.data < end(b) && b.data < end(a);
}

/// In place is fine where every result pixel needs its own source pixel alone.
void check_overlap(const Operation& operation, const TileNode& node, const ConstAnyView& source, int index,
                   const AnyView& result) {
  if (!overlap(source, result)) return;
  const Rect whole = result.info.rect();
  const bool same_place = source.data == result.data && source.stride == result.stride &&
                          source.info.pixel_bytes() == result.info.pixel_bytes();
  if (!same_place || node.needs(whole, index) != whole || node.needs({0, 0, 1, 1}, index) != Rect{0, 0, 1, 1}) {
    throw Error(Error::Argument, fmt::format("{}: {}: overlaps the result, expected other memory", operation.name,
                                             operation.input(static_cast<std::size_t>(index)).name));
  }
}

struct Built {
  Graph graph;
  ValueRef first;
  std::span<const ImageInfo> results;
};

Built build(const Operation& operation, const void* options, std::span<const ConstAnyView> sources) {
  Built built;
  std::vector<ImageInfo> infos;
  std::vector<ValueRef> refs;
  infos.reserve(sources.size());
  refs.reserve(sources.size());
  for (const ConstAnyView& source : sources) {
    infos.push_back(source.info);
    refs.push_back(built.graph.add_source(source, {}));
  }
  std::unique_ptr<TileNode> node = make_node(operation, options, infos);
  built.results = node->results();
  built.first = built.graph.add_node(std::move(node), std::move(refs), operation.name, image_names(operation));
  return built;
}

}  // namespace

const Field* Operation::find_field(std::string_view field_name) const {
  for (const Field& each : fields) {
    if (each.name == field_name) return &each;
  }
  return nullptr;
}

void Operation::check_count(std::size_t given) const {
  const auto needed =
      static_cast<std::size_t>(std::ranges::count_if(inputs, [](const Port& port) { return !port.optional; }));
  const bool many = !inputs.empty() && inputs.back().repeated;
  if (given > inputs.size() && !many) {
    throw Error(Error::Argument, fmt::format("{}: {} inputs, expected {}", name, given, inputs.size()));
  }
  if (given < needed) {
    throw Error(Error::Argument, fmt::format("{}: {}: got nothing, expected {}", name, inputs[given].name,
                                             to_string(inputs[given].kind)));
  }
}

std::vector<const Operation*> variants_of(const Operation& operation) {
  std::vector<const Operation*> list{&operation};
  list.insert(list.end(), operation.variants.begin(), operation.variants.end());
  return list;
}

std::vector<VariantField> fields_of(const Operation& operation) {
  const std::vector<const Operation*> variants = variants_of(operation);
  std::vector<VariantField> list;
  std::vector<std::size_t> counts;
  for (const Operation* variant : variants) {
    const std::string kind = variant->inputs.empty() ? "" : to_string(variant->inputs[0].kind);
    for (const Field& field : variant->fields) {
      const auto same = std::ranges::find_if(list, [&](const VariantField& other) {
        return other.field->name == field.name && other.field->help == field.help &&
               expected(*other.field) == expected(field);
      });
      if (same == list.end()) {
        list.push_back({variant, &field, kind});
        counts.push_back(1);
      } else {
        same->kinds += ", " + kind;
        ++counts[static_cast<std::size_t>(same - list.begin())];
      }
    }
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (counts[i] == variants.size()) list[i].kinds.clear();
  }
  return list;
}

std::vector<std::string> image_names(const Operation& operation) {
  std::vector<std::string> list;
  for (const Port& port : operation.outputs) {
    if (port.kind != ValueKind::Report) list.push_back(port.name);
  }
  return list;
}

void Operation::check(const void* options) const {
  try {
    for (const Field& each : fields) each.check(options);
  } catch (const Error& error) {
    rethrow_named(*this, error);
  }
}

std::vector<Value> invoke(const Operation& operation, const void* options, std::span<const Value> inputs,
                          const Run& run, const std::string& step) {
  operation.check(options);
  check_inputs(operation, inputs);
  try {
    if (run.stages == nullptr || step.empty()) return operation.invoke(inputs, options, run);
    StepStages stages(*run.stages, operation.name, step);
    Run named = run;
    named.stages = &stages;
    return operation.invoke(inputs, options, named);
  } catch (const Error& error) {
    // A public function that does the work may have named itself.
    if (error.kind() == Error::Cancelled || std::string_view(error.what()).starts_with(operation.name + ": ")) throw;
    rethrow_named(operation, error);
  }
}

std::unique_ptr<TileNode> make_node(const Operation& operation, const void* options,
                                    std::span<const ImageInfo> sources) {
  operation.check(options);
  operation.check_count(sources.size());
  try {
    return operation.make_node(options, sources);
  } catch (const Error& error) {
    rethrow_named(operation, error);
  }
}

std::vector<Image> apply(const Operation& operation, const void* options, std::span<const Image* const> sources,
                         const Run& run) {
  std::vector<ConstAnyView> views;
  views.reserve(sources.size());
  for (const Image* source : sources) {
    if (source->empty()) {
      throw Error(Error::Argument,
                  fmt::format("{}: {}: an image without pixels", operation.name, operation.input(views.size()).name));
    }
    views.push_back(source->any());
  }
  const Built built = build(operation, options, views);
  std::vector<Image> results;
  std::vector<Target> targets;
  for (const ImageInfo& info : built.results) {
    results.emplace_back(info, run.limits);
    if (!sources.empty()) results.back().share_metadata(*sources[0]);
    targets.push_back({{built.first.vertex, static_cast<int>(targets.size())}, results.back().any(), nullptr});
  }
  execute(built.graph, targets, run);
  return results;
}

void measure(const Operation& operation, const void* options, std::span<const ConstAnyView> sources, const Run& run,
             const std::function<void(std::span<const Analysis* const> analyses)>& analysed) {
  const Built built = build(operation, options, sources);
  const Target targets[] = {{.value = {built.first.vertex, 0}, .analysed = analysed}};
  execute(built.graph, targets, run);
}

Report measure(const Operation& operation, const void* options, std::initializer_list<ConstAnyView> sources,
               const Run& run) {
  const Built built = build(operation, options, {sources.begin(), sources.size()});
  const TileNode& node = *built.graph.vertices()[static_cast<std::size_t>(built.first.vertex)].node;
  Report report;
  const Target targets[] = {
      {.value = {built.first.vertex, 0},
       .analysed = [&](std::span<const Analysis* const> gathered) { report = node.report(gathered); }}};
  execute(built.graph, targets, run);
  return report;
}

void apply_into(const Operation& operation, const void* options, std::span<const ConstAnyView> sources,
                std::initializer_list<AnyView> results, const Run& run) {
  const Built built = build(operation, options, sources);
  const TileNode& node = *built.graph.vertices()[static_cast<std::size_t>(built.first.vertex)].node;
  std::vector<Target> targets;
  for (const AnyView& result : results) {
    const auto index = static_cast<std::size_t>(&result - results.begin());
    if (result.data == nullptr) continue;
    const ImageInfo& wanted = built.results[index];
    if (result.info.width != wanted.width || result.info.height != wanted.height ||
        result.info.channels != wanted.channels || result.info.type != wanted.type) {
      throw Error(Error::Argument, fmt::format("{}: {}: {}, expected {}", operation.name, image_names(operation)[index],
                                               describe(result.info), describe(wanted)));
    }
    for (std::size_t s = 0; s < sources.size(); ++s) {
      check_overlap(operation, node, sources[s], static_cast<int>(s), result);
    }
    targets.push_back({{built.first.vertex, static_cast<int>(index)}, result, nullptr});
  }
  execute(built.graph, targets, run);
}

}  // namespace azulejo
