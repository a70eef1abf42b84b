#include "help.h"

#include <algorithm>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/imaging/within.h"
#include "azulejo/operations.h"
#include "command_line.h"
#include "describe.h"

namespace azulejo::cli {
namespace {

const char* type_name(const Field& field) {
  switch (field.type) {
    case FieldType::Bool: return "bool";
    case FieldType::Int: return "int";
    case FieldType::Float: return "float";
    case FieldType::Choice: return "choice";
    case FieldType::Text: return "text";
    case FieldType::Color: return "color";
    case FieldType::Point: return "point";
    case FieldType::Grid: return "grid";
  }
  return "text";
}

/// "mesh, mesh → scene", "drawing|mesh → the same"
std::string flow_of(const Operation& operation) {
  std::vector<std::string> inputs;
  for (std::size_t i = 0; i < operation.inputs.size(); ++i)
    inputs.push_back(kinds_of(operation, &Operation::inputs, i));
  const bool same =
      !operation.variants.empty() && std::ranges::all_of(variants_of(operation), [](const Operation* each) {
        return each->inputs[0].kind == each->outputs[0].kind;
      });
  return fmt::format("{}→ {}", inputs.empty() ? "" : fmt::format("{} ", fmt::join(inputs, ", ")),
                     same ? "the same" : kinds_of(operation, &Operation::outputs, 0));
}

std::string port_lines(const Operation& operation, const char* title, std::vector<Port> Operation::*ports) {
  if ((operation.*ports).empty()) return "";
  std::string text = fmt::format("\n{}\n", title);
  for (std::size_t i = 0; i < (operation.*ports).size(); ++i) {
    const Port& port = (operation.*ports)[i];
    text += fmt::format("  {:<24}{}: {}\n  {:<24}{}\n", port.name, kinds_of(operation, ports, i), port.help, "",
                        file_of(operation, port));
  }
  return text;
}

/// "; of mesh, scene", or nothing of an option that all variants have.
std::string only_of(const VariantField& each) { return each.kinds.empty() ? "" : "; of " + each.kinds; }

std::string option_lines(const std::vector<CommonOption>& options) {
  std::string text;
  for (const CommonOption& each : options) {
    const std::string names = (each.short_name.empty() ? "    " : each.short_name + ", ") + each.name +
                              (each.argument.empty() ? "" : " " + each.argument);
    text += fmt::format("  {:<28}{}\n", names, each.help);
  }
  return text;
}

/// troff takes a leading dot or quote for a request, and \ for an escape.
std::string troff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return safe.starts_with('.') || safe.starts_with('\'') ? "\\&" + safe : safe;
}

/// Words in double quotes for a shell.
std::string shell_words(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::vector<std::string> all_commands() {
  std::vector<std::string> words;
  for (const Command& each : commands()) words.emplace_back(each.name);
  for (const Operation* each : operations()) words.push_back(each->name);
  return words;
}

std::vector<std::string> flags_of(const Operation& operation) {
  std::vector<std::string> flags;
  for (const VariantField& each : fields_of(operation)) {
    const std::string flag = flag_of(each.field->name);
    if (std::ranges::find(flags, flag) == flags.end()) flags.push_back(flag);
  }
  for (const Port& port : operation.inputs) flags.push_back(flag_of(port.name));
  for (const Port& port : operation.outputs) {
    if (port.on_request && operation.find_field(port.name) == nullptr) flags.push_back(flag_of(port.name));
  }
  if (takes_within(operation)) flags.insert(flags.end(), {"--within", "--feather"});
  return flags;
}

std::string bash_completion() {
  CommandLine scratch;
  std::vector<std::string> common;
  std::string values;
  for (const CommonOption& each : common_options(scratch)) {
    common.push_back(each.name);
    if (!each.choices.empty())
      values += fmt::format("    *:{}) words=\"{}\" ;;\n", each.name, shell_words(each.choices));
  }
  std::string flags;
  std::vector<std::string> stages;
  for (const Operation* each : operations()) {
    const std::string commands = each->name == "render" ? "render|turntable" : each->name;
    flags += fmt::format("    {}) words=\"$words {}\" ;;\n", commands, shell_words(flags_of(*each)));
    stages.push_back(each->name);
    for (const VariantField& known : fields_of(*each)) {
      if (known.field->choices.empty()) continue;
      std::string place = each->name + ":" + flag_of(known.field->name);
      if (each->name == "render") place += "|turntable:" + flag_of(known.field->name);
      values += fmt::format("    {}) words=\"{}\" ;;\n", place, shell_words(known.field->choices));
    }
  }
  return fmt::format(R"(# bash completion for azulejo; made by: azulejo completion bash
_azulejo() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}" command="${{COMP_WORDS[1]}}" words=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{0} --help --version" -- "$current"))
    return
  fi
  case "$command:$previous" in
{1}    completion:completion) words="bash zsh" ;;
    ops:ops) words="{2}" ;;
  esac
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
    return
  fi
  if [[ "$current" == -* ]]; then
    words="{3}"
    case "$command" in
{4}    esac
    COMPREPLY=($(compgen -W "$words" -- "$current"))
    return
  fi
  COMPREPLY=($(compgen -f -- "$current"))
  if [ "$command" = run ]; then
    COMPREPLY+=($(compgen -W "{2}" -- "$current"))
  fi
}}
complete -o filenames -F _azulejo azulejo
)",
                     shell_words(all_commands()), values, shell_words(stages), shell_words(common), flags);
}

/// zsh runs bash's script through its own compatibility layer.
std::string zsh_completion() {
  return "#compdef azulejo\n# zsh completion for azulejo; made by: azulejo completion zsh\n"
         "autoload -U +X bashcompinit && bashcompinit\n" +
         bash_completion();
}

}  // namespace

std::string help() {
  std::string text = fmt::format("azulejo {}: models to images, images to models, on any machine\n\n", AZULEJO_VERSION);
  const auto line = [&](std::string_view usage, std::string_view what) {
    text += usage.size() < 48 ? fmt::format("  {:<48} {}\n", usage, what)
                              : fmt::format("  {}\n  {:<48} {}\n", usage, "", what);
  };
  line("azulejo OPERATION INPUT... -o OUTPUT [options]", "one operation");
  for (const Command& each : commands()) line(each.usage, each.help);
  text += "\nOperations\n" + operation_list() + "\nOptions\n";
  CommandLine scratch;
  text += option_lines(common_options(scratch));
  text += "\nazulejo OPERATION --help tells an operation's own options.\n";
  return text;
}

std::string operation_list() {
  std::string text;
  std::size_t names = 0;
  std::size_t kinds = 0;
  for (const Operation* each : operations()) {
    names = std::max(names, each->name.size());
    kinds = std::max(kinds, flow_of(*each).size());
  }
  for (const Operation* each : operations())
    text += fmt::format("  {:<{}}  {:<{}}  {}\n", each->name, names, flow_of(*each), kinds - 2, each->summary);
  return text;
}

std::string turntable_help() {
  for (const Command& each : commands()) {
    if (std::string_view(each.name) != "turntable") continue;
    return fmt::format(
        "Draws a model from all around: --frames pictures (36), numbered by {{frame}} or {{frame:04}}.\n\n  {}\n"
        "\nOutputs and options are those of render: azulejo render --help\n",
        each.usage);
  }
  return "";
}

std::string operation_help(const Operation& operation) {
  std::string text = fmt::format("{}\n\n  {}\n", operation.summary, usage(operation));
  text += port_lines(operation, "Inputs", &Operation::inputs) + port_lines(operation, "Outputs", &Operation::outputs);
  const std::vector<VariantField> fields = fields_of(operation);
  if (!fields.empty()) text += "\nOptions\n";
  for (const VariantField& each : fields) {
    const std::string flag = flag_of(each.field->name);
    const std::string normal = default_of(*each.operation, *each.field);
    text += fmt::format("  {:<24}{}{}\n  {:<24}{}; {}{}\n", flag, each.field->help, only_of(each), "",
                        expected(*each.field), normal.empty() ? "none by default" : "default ", normal);
  }
  if (takes_within(operation)) {
    text += fmt::format("\nSelected area\n  {:<24}{}\n  {:<24}{}\n  {:<24}{}\n", "--within",
                        "change nothing outside: x,y,width,height in pixels, a mask (an image file),", "",
                        "or FILE:N for region N of labels", "--feather",
                        "pixels over which the change fades in from the edge inwards");
  }
  return text + "\nShared options: azulejo --help\n";
}

Json operation_json(const Operation& operation) {
  const auto ports = [](const std::vector<Port>& list) {
    Json array = Json::array();
    for (const Port& port : list)
      array.push(Json::object()
                     .set("name", port.name)
                     .set("kind", to_string(port.kind))
                     .set("optional", port.optional)
                     .set("repeated", port.repeated)
                     .set("help", port.help));
    return array;
  };
  Json options = Json::array();
  for (const Field& field : operation.fields) {
    Json json = Json::object();
    json.set("name", field.name)
        .set("type", type_name(field))
        .set("optional", field.optional)
        .set("default", default_of(operation, field));
    if (field.list) json.set("list", true);
    if (field.repeated) json.set("repeated", true);
    if (field.type == FieldType::Point) json.set("components", field.components);
    if (field.type == FieldType::Int || field.type == FieldType::Float || field.type == FieldType::Point ||
        field.type == FieldType::Grid) {
      json.set("minimum", field.range.minimum).set("maximum", field.range.maximum);
    }
    if (!field.choices.empty()) {
      Json choices = Json::array();
      for (const std::string& choice : field.choices) choices.push(choice);
      json.set("choices", choices);
    }
    options.push(json.set("unit", field.unit).set("help", field.help));
  }
  Json described = Json::object();
  described.set("name", operation.name)
      .set("summary", operation.summary)
      .set("inputs", ports(operation.inputs))
      .set("outputs", ports(operation.outputs))
      .set("within", may_be_within(operation))
      .set("options", options);
  if (!operation.variants.empty()) {
    Json variants = Json::array();
    for (const Operation* each : operation.variants) variants.push(operation_json(*each));
    described.set("variants", variants);
  }
  return described;
}

std::string completion(const std::string& shell) {
  if (shell == "bash") return bash_completion();
  if (shell == "zsh") return zsh_completion();
  throw Error(Error::Argument, fmt::format("completion: \"{}\", expected bash or zsh", shell));
}

std::string manual() {
  std::string text = fmt::format(".TH AZULEJO 1 \"\" \"azulejo {}\" \"User Commands\"\n", AZULEJO_VERSION);
  text += ".SH NAME\nazulejo \\- visual computing on any machine\n.SH SYNOPSIS\n";
  text += ".B azulejo OPERATION\nINPUT... \\-o OUTPUT [options]\n";
  for (const Command& each : commands()) text += fmt::format(".br\n{}\n", troff(each.usage));
  text += ".SH COMMANDS\n";
  for (const Command& each : commands()) text += fmt::format(".TP\n.B {}\n{}\n", troff(each.name), troff(each.help));
  text += ".SH OPTIONS\n";
  CommandLine scratch;
  for (const CommonOption& each : common_options(scratch)) {
    const std::string names = (each.short_name.empty() ? "" : each.short_name + ", ") + each.name;
    text += fmt::format(".TP\n.B {}{}\n{}\n", troff(names),
                        each.argument.empty() ? "" : " \\fI" + each.argument + "\\fR", troff(each.help));
  }
  text += ".SH OPERATIONS\n";
  for (const Operation* each : operations()) {
    text += fmt::format(".SS {}\n{}\n.br\n{}\n.br\n{}\n", troff(each->name), troff(each->summary),
                        troff(flow_of(*each)), troff(usage(*each)));
    for (const VariantField& known : fields_of(*each)) {
      const Field& field = *known.field;
      text += fmt::format(".TP\n.B {}\n{}{}; {}; default {}\n", troff(flag_of(field.name)), troff(field.help),
                          only_of(known), troff(expected(field)), troff(default_of(*known.operation, field)));
    }
  }
  text +=
      ".SH STAGES\nIn a chain an operation is written name:option=value,option=value. as:name names a result, @name "
      "uses it.\n";
  text +=
      ".SH EXIT STATUS\n0: done. 1: it failed. 2: the call was wrong. 3: it ran, and the verdict is no. 130: "
      "interrupted.\n";
  return text;
}

}  // namespace azulejo::cli
