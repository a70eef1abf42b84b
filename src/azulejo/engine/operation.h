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
#include "azulejo/engine/node.h"
#include "azulejo/engine/value.h"

namespace azulejo {

/// A named input or output of an operation.
struct Port {
  std::string name;
  std::string help;
  ValueKind kind = ValueKind::Image;
};

/// An operation told once: from here come the command, its help and completion, range checks, reference pages,
/// registry-wide tests. A plain run-time struct; `image_operation` fills it.
struct Operation {
  std::string name;
  std::string summary;  ///< one sentence
  std::vector<Port> inputs;
  std::vector<Port> outputs;  ///< the first flows on in a chain
  std::vector<Field> fields;

  /// Options with their defaults.
  std::shared_ptr<void> (*make_options)() = nullptr;
  /// Of an operation on image tiles: its step of a computation. Throws as the constructor of Node.
  std::unique_ptr<Node> (*make_node)(const void* options, std::span<const ImageInfo> sources) = nullptr;
  /// Of any other operation: all outputs at once.
  std::function<std::vector<Value>(std::span<const Value> inputs, const void* options, const Run& run)> invoke;

  AZULEJO_EXPORT const Field* find_field(std::string_view field_name) const;
  /// Throws Error(Argument), with the operation's name, for a value out of range.
  AZULEJO_EXPORT void check(const void* options) const;
};

/// Describes an operation on tiles: `Step` is a Node constructed from (const Options&, std::span<const ImageInfo>).
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
  operation.make_node = [](const void* options, std::span<const ImageInfo> sources) -> std::unique_ptr<Node> {
    return std::make_unique<Step>(*static_cast<const Options*>(options), sources);
  };
  return operation;
}

/// A node of `operation`, its options checked; messages begin with the operation's name.
AZULEJO_EXPORT std::unique_ptr<Node> make_node(const Operation& operation, const void* options,
                                               std::span<const ImageInfo> sources);

/// Runs an operation on whole images: a chain of one. All results, in the order of the outputs; the metadata are
/// the first source's.
AZULEJO_EXPORT std::vector<Image> apply(const Operation& operation, const void* options,
                                        std::initializer_list<const Image*> sources, const Run& run);
/// The same into the caller's memory. A result whose `data` is null is not computed.
/// Throws Error(Argument) if a result has another size, channels or type than the operation gives, or overlaps a
/// source (exactly the same pixels are allowed where each result pixel needs only its own source pixel).
AZULEJO_EXPORT void apply_into(const Operation& operation, const void* options,
                               std::initializer_list<ConstAnyView> sources, std::initializer_list<AnyView> results,
                               const Run& run);

}  // namespace azulejo
