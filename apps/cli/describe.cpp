#include "describe.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "azulejo/imaging/within.h"
#include "command_line.h"

namespace azulejo::cli {
namespace {

/// What a value is outside of a chain.
const char* file_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::Image:
    case ValueKind::Labels: return "an image file";
    case ValueKind::Frame: return "an image file; all layers in OpenEXR";
    case ValueKind::Mesh:
    case ValueKind::Scene: return "a model file, such as STL, PLY, OBJ or glTF";
    case ValueKind::Volume: return "a volume file, such as NIfTI or NRRD";
    case ValueKind::Drawing: return "a drawing file: SVG";
    case ValueKind::Report: return "JSON; without -o it is printed";
  }
  return "";
}

}  // namespace

std::string default_of(const Operation& operation, const Field& field) {
  return field.print(operation.make_options().get());
}

std::string usage(const Operation& operation) {
  std::string text = "azulejo " + operation.name;
  for (const Port& port : operation.inputs) {
    std::string upper = port.name;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    if (port.repeated) upper += "...";
    text += port.optional ? " [" + upper + "]" : " " + upper;
  }
  const bool printed = operation.outputs[0].kind == ValueKind::Report;
  return text + (printed ? " [-o OUTPUT] [options]" : " -o OUTPUT [options]");
}

std::string kinds_of(const Operation& operation, std::vector<Port> Operation::*ports, std::size_t index) {
  std::vector<std::string> kinds;
  for (const Operation* each : variants_of(operation)) {
    const std::string kind = to_string((each->*ports)[index].kind);
    if (std::ranges::find(kinds, kind) == kinds.end()) kinds.push_back(kind);
  }
  return fmt::format("{}", fmt::join(kinds, "|"));
}

bool takes_within(const Operation& operation) {
  return std::ranges::any_of(variants_of(operation), [](const Operation* each) { return may_be_within(*each); });
}

std::string file_of(const Operation& operation, const Port& port) {
  if (!port.on_request && !operation.variants.empty() && port.kind != ValueKind::Report) return "a file of such a kind";
  if (!port.on_request) return file_of(port.kind);
  const bool flag = operation.find_field(port.name) == nullptr;
  return fmt::format("JSON, with -o {}=PATH{}", port.name,
                     flag ? fmt::format("; {} prints it", flag_of(port.name)) : "");
}

}  // namespace azulejo::cli
