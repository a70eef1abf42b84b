#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/field.h"
#include "azulejo/engine/tile_node.h"
#include "azulejo/engine/value.h"

namespace azulejo {

/// A named input or output of an operation.
struct Port {
  std::string name;
  std::string help = {};
  ValueKind kind = ValueKind::Image;
  bool on_request = false;  ///< a report that is not printed unless it is asked for
  bool optional = false;    ///< an input that may be left out, then also those behind it
  bool repeated = false;    ///< the last input, given once or more often
};

/// A use of an operation, for its reference page, and run by the tests.
struct Example {
  std::string words;    ///< as between `azulejo run` and -o: "photo.png gaussian:sigma=4"
  std::string caption;  ///< what is to be seen; a sentence
};

/// An operation told once: from here come the command, its help and completion, range checks, reference pages,
/// registry-wide tests. A plain run-time struct; `image_operation` and `value_operation` fill it.
struct Operation {
  std::string name;
  std::string summary;  ///< one sentence
  std::vector<Port> inputs;
  std::vector<Port> outputs;  ///< the first flows on in a chain
  std::vector<Field> fields;
  std::vector<Example> examples;

  /// An argument such as "output=linear", of an optional field: given where that is `auto` and the first output, a
  /// frame, goes straight into files that hold floats, and nowhere else. Empty: none.
  std::string float_output;

  /// Options with their defaults.
  std::shared_ptr<void> (*make_options)() = nullptr;
  /// Of an operation on image tiles: its step of a computation. Throws as the constructor of TileNode. Its results are
  /// the outputs that are images, in their order; an output that is a report is TileNode::report.
  std::unique_ptr<TileNode> (*make_node)(const void* options, std::span<const ImageInfo> sources) = nullptr;
  /// Of any other operation: all outputs at once. Called by azulejo::invoke, which checks options and inputs.
  std::function<std::vector<Value>(std::span<const Value> inputs, const void* options, const Run& run)> invoke;

  /// What it is for other kinds of a first input: further descriptions of the same name, with inputs and outputs of the
  /// same names. Options may differ; those of one name are switches in all of them, or in none.
  std::vector<const Operation*> variants;

  AZULEJO_EXPORT const Field* find_field(std::string_view field_name) const;
  /// The input that the so-many-th value is for: the last one, if that is repeated, takes all that are left.
  const Port& input(std::size_t index) const { return inputs[index < inputs.size() ? index : inputs.size() - 1]; }
  /// Throws Error(Argument), with the operation's name, if there are too many or too few inputs.
  AZULEJO_EXPORT void check_count(std::size_t given) const;
  /// Throws Error(Argument), with the operation's name, for a value out of range.
  AZULEJO_EXPORT void check(const void* options) const;
};

/// Describes an operation on tiles: `Step` is a TileNode constructed from (const Options&, std::span<const ImageInfo>).
template <class Options, class Step>
Operation image_operation(std::string name, std::string summary, std::vector<Port> inputs, std::vector<Port> outputs,
                          std::vector<Field> fields) {
  Operation operation;
  operation.name = std::move(name);
  operation.summary = std::move(summary);
  operation.inputs = std::move(inputs);
  operation.outputs = std::move(outputs);
  operation.fields = std::move(fields);
  operation.make_options = []() -> std::shared_ptr<void> { return std::make_shared<Options>(); };
  operation.make_node = [](const void* options, std::span<const ImageInfo> sources) -> std::unique_ptr<TileNode> {
    return std::make_unique<Step>(*static_cast<const Options*>(options), sources);
  };
  return operation;
}

/// Describes an operation that is not on tiles: `function` is called as
/// std::vector<Value> function(std::span<const Value> inputs, const Options& options, const Run& run)
/// with an input of each declared kind and options in range, and gives a value of each output's kind; those behind
/// the first may be empty where the options leave them out. Without inputs it is a generator. Messages of its errors
/// begin with its name, or with the input or option that they are about.
/// What it gives to `run.stages`, with its own name as the step, appears under its step's name in the chain.
template <class Options, class Function>
Operation value_operation(std::string name, std::string summary, std::vector<Port> inputs, std::vector<Port> outputs,
                          std::vector<Field> fields, Function function) {
  Operation operation;
  operation.name = std::move(name);
  operation.summary = std::move(summary);
  operation.inputs = std::move(inputs);
  operation.outputs = std::move(outputs);
  operation.fields = std::move(fields);
  operation.make_options = []() -> std::shared_ptr<void> { return std::make_shared<Options>(); };
  operation.invoke = [function = std::move(function)](std::span<const Value> values, const void* options,
                                                      const Run& run) -> std::vector<Value> {
    return function(values, *static_cast<const Options*>(options), run);
  };
  return operation;
}

/// The operation with examples, in the order in which its page shows them.
inline Operation with_examples(Operation operation, std::vector<Example> examples) {
  operation.examples = std::move(examples);
  return operation;
}

/// The operation with `Operation::float_output` set.
inline Operation with_float_output(Operation operation, std::string argument) {
  operation.float_output = std::move(argument);
  return operation;
}

/// The operation with variants, which may be defined anywhere; only their addresses are taken.
inline Operation with_variants(Operation operation, std::vector<const Operation*> variants) {
  operation.variants = std::move(variants);
  return operation;
}

/// The operation, then its variants.
AZULEJO_EXPORT std::vector<const Operation*> variants_of(const Operation& operation);

/// An option of an operation, and for which kinds of a first input.
struct VariantField {
  const Operation* operation = nullptr;  ///< the first variant that has it
  const Field* field = nullptr;
  std::string kinds;  ///< "mesh, scene"; empty: all that there are
};
/// The options of an operation and its variants: each once, where name, help and values are the same.
AZULEJO_EXPORT std::vector<VariantField> fields_of(const Operation& operation);

/// Runs an operation that is not on tiles; messages begin with the operation's name.
/// step    its name for `run.stages`; empty: the operation's
/// Throws  Error(Argument) for options out of range, missing inputs or inputs of another kind than is declared
AZULEJO_EXPORT std::vector<Value> invoke(const Operation& operation, const void* options, std::span<const Value> inputs,
                                         const Run& run, const std::string& step = {});

/// Names of the outputs that are no reports: of an operation on tiles, of its node's results.
AZULEJO_EXPORT std::vector<std::string> image_names(const Operation& operation);

/// A node of `operation`, its options checked; messages begin with the operation's name.
AZULEJO_EXPORT std::unique_ptr<TileNode> make_node(const Operation& operation, const void* options,
                                                   std::span<const ImageInfo> sources);

/// Runs an operation on whole images: a chain of one. All images that come out, in the order of the outputs; the
/// metadata are the first source's.
AZULEJO_EXPORT std::vector<Image> apply(const Operation& operation, const void* options,
                                        std::span<const Image* const> sources, const Run& run);
inline std::vector<Image> apply(const Operation& operation, const void* options,
                                std::initializer_list<const Image*> sources, const Run& run) {
  return apply(operation, options, std::span(sources.begin(), sources.size()), run);
}
/// Gathers what an operation on tiles reports, without making its images: calls `analysed` as a Target's.
AZULEJO_EXPORT void measure(const Operation& operation, const void* options, std::span<const ConstAnyView> sources,
                            const Run& run,
                            const std::function<void(std::span<const Analysis* const> analyses)>& analysed);
/// The report of an operation on tiles.
AZULEJO_EXPORT Report measure(const Operation& operation, const void* options,
                              std::initializer_list<ConstAnyView> sources, const Run& run);
/// As `apply`, into the caller's memory. A result whose `data` is null is not computed.
/// Throws Error(Argument) if a result has another size, channels or type than the operation gives, or overlaps a
/// source (exactly the same pixels are allowed where each result pixel needs only its own source pixel).
AZULEJO_EXPORT void apply_into(const Operation& operation, const void* options, std::span<const ConstAnyView> sources,
                               std::initializer_list<AnyView> results, const Run& run);
inline void apply_into(const Operation& operation, const void* options, std::initializer_list<ConstAnyView> sources,
                       std::initializer_list<AnyView> results, const Run& run) {
  apply_into(operation, options, std::span(sources.begin(), sources.size()), results, run);
}

}  // namespace azulejo
