#include "command_line.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/text.h"
#include "azulejo/operations.h"
#include "describe.h"
#include "model_options.h"

namespace azulejo::cli {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& expected) {
  throw Error(Error::Argument, fmt::format("{}: \"{}\", expected {}", option, text, expected));
}

/// A whole number in a range, with K, M, G or T behind it where `sizes` are meant (powers of 1024).
std::int64_t whole_number(const std::string& option, const std::string& text, std::int64_t low, std::int64_t high,
                          bool sizes = false) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  auto [rest, failure] = std::from_chars(text.data(), end, value);
  int shift = 0;
  if (failure == std::errc() && sizes && rest != end) {
    const std::string_view units = "KMGT";
    const std::size_t unit = units.find(static_cast<char>(std::toupper(static_cast<unsigned char>(*rest))));
    if (unit != std::string_view::npos) {
      shift = 10 * (static_cast<int>(unit) + 1);
      ++rest;
    }
    if (rest != end && (*rest == 'B' || *rest == 'b')) ++rest;
  }
  const bool fits = failure == std::errc() && rest == end && value >= low && value <= (high >> shift);
  if (!fits) {
    refuse(option, text,
           sizes ? std::string("a number of bytes, such as 500M or 4G")
                 : fmt::format("a whole number from {} to {}", low, high));
  }
  return value << shift;
}

void set_background(WriteOptions& write, const std::string& text) {
  unsigned value = 0;
  const std::string_view digits = std::string_view(text).substr(text.starts_with('#') ? 1 : 0);
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.size() != 6 || failure != std::errc() || end != digits.data() + digits.size())
    refuse("--background", text, "#rrggbb");
  for (int c = 0; c < 3; ++c) write.background[c] = static_cast<float>((value >> (16 - 8 * c)) & 255U) / 255.0F;
}

/// The field of the operation that has the name of a common option, or null.
const Field* same_name(const CommandLine& line, const CommonOption& option) {
  if (line.operation == nullptr) return nullptr;
  for (const VariantField& each : fields_of(*line.operation)) {
    if (flag_of(each.field->name) == option.name) return each.field;
  }
  return nullptr;
}

/// An operation's own option stands instead of a common one of its name. Only --output is both: one of the field's
/// choices is for the field, other text is a path.
void add_common(CLI::App& app, CommandLine& line) {
  for (CommonOption& each : common_options(line)) {
    if (const Field* const own = same_name(line, each)) {
      if (each.name != "--output") continue;
      each.set = [&line, path = each.set, field = own](const std::string& text) {
        const bool choice = std::ranges::find(field->choices, text) != field->choices.end() || text == "auto";
        if (choice) return line.arguments.emplace_back(field->name, text), void();
        path(text);
      };
    }
    const std::string names = each.short_name.empty() ? each.name : each.short_name + "," + each.name;
    if (each.argument.empty()) {
      app.add_flag_callback(names, [set = each.set] { set("true"); });
    } else {
      app.add_option_function<std::vector<std::string>>(names,
                                                        [set = each.set](const std::vector<std::string>& texts) {
                                                          for (const std::string& text : texts) set(text);
                                                        })
          ->take_all()
          ->expected(1)
          ->allow_extra_args(false);
    }
  }
}

/// `--border-value` and `--border_value` both.
std::string flag_names(const std::string& name) {
  const std::string flag = flag_of(name);
  return flag == "--" + name ? flag : flag + ",--" + name;
}

/// The arguments of an operation among the options of the command line, in the order in which they are given.
class OperationOptions {
 public:
  explicit OperationOptions(CLI::App& app) : app_(app) {}

  void add(const std::string& name, bool several) {
    CLI::Option* const option =
        app_.add_option_function<std::vector<std::string>>(flag_names(name), [](const std::vector<std::string>&) {});
    option->multi_option_policy(several ? CLI::MultiOptionPolicy::TakeAll : CLI::MultiOptionPolicy::Throw)
        ->expected(1)
        ->allow_extra_args(false);
    known_[option] = {name, {}};
  }
  void add_switch(const std::string& name) {
    known_[app_.add_flag_callback(flag_names(name), [] {})] = {name, "true"};
    known_[app_.add_flag_callback("--no-" + flag_of(name).substr(2), [] {})] = {name, "false"};
  }
  /// Of what was parsed.
  void append_to(std::vector<std::pair<std::string, std::string>>& arguments) const {
    std::map<const CLI::Option*, std::size_t> taken;
    for (const CLI::Option* const option : app_.parse_order()) {
      const auto found = known_.find(option);
      if (found == known_.end()) continue;
      const auto& [name, fixed] = found->second;
      arguments.emplace_back(name, fixed ? *fixed : option->results()[taken[option]++]);
    }
  }

 private:
  CLI::App& app_;
  std::map<const CLI::Option*, std::pair<std::string, std::optional<std::string>>> known_;
};

void add_operation_options(CLI::App& app, OperationOptions& options, CommandLine& line, const Operation& operation) {
  std::set<std::string> known;
  for (const auto& [variant, field, kinds] : fields_of(operation)) {
    if (field->name == "output" || !known.insert(field->name).second) continue;  // "output" shares --output
    if (field->type == FieldType::Bool) {
      options.add_switch(field->name);
    } else {
      options.add(field->name, field->repeated);
    }
  }
  for (const Port& port : operation.inputs) options.add(port.name, port.repeated);
  if (takes_within(operation)) {
    options.add("within", false);
    options.add("feather", false);
  }
  for (const Port& port : operation.outputs) {
    // --statistics prints what -o statistics=PATH writes; where an option has that name, only the latter is.
    if (!port.on_request || operation.find_field(port.name) != nullptr) continue;
    app.add_flag_callback(flag_names(port.name), [&line, name = port.name] { line.outputs.push_back(name + "=-"); });
  }
}

/// The first thing that CLI11 could not place, with what it may have meant.
std::string explain_extra(const std::string& word, const CommandLine& line) {
  std::vector<std::string> known;
  CommandLine scratch;
  for (const CommonOption& each : common_options(scratch)) known.push_back(each.name);
  if (line.operation != nullptr) {
    for (const VariantField& each : fields_of(*line.operation)) known.push_back(flag_of(each.field->name));
    for (const Port& port : line.operation->inputs) known.push_back(flag_of(port.name));
    for (const Port& port : line.operation->outputs) {
      if (port.on_request) known.push_back(flag_of(port.name));
    }
  }
  return fmt::format("{}: no such option{}; azulejo {} --help lists them", word, did_you_mean(word, known),
                     line.command);
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& each : commands()) names.emplace_back(each.name);
  for (const Operation* each : operations()) names.push_back(each->name);
  return names;
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> list = {
      {"run", "azulejo run INPUT STAGE... -o OUTPUT", "a chain of operations, such as gaussian:sigma=2 sobel"},
      {"ops", "azulejo ops [NAME] [--json]", "what operations there are; the options of one"},
      {"info", "azulejo info FILE... [--tree] [--json]", "what a file holds"},
      {"turntable", "azulejo turntable MODEL -o 'frame-{frame:04}.png' [--frames N]",
       "pictures all around a model; options as render"},
      {"completion", "azulejo completion bash|zsh", "prints a completion script"},
      {"manual", "azulejo manual", "prints the manual page (troff)"},
  };
  return list;
}

std::string flag_of(const std::string& name) {
  std::string flag = "--" + name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::vector<CommonOption> common_options(CommandLine& line) {
  const auto flag = [](bool& value) { return [&value](const std::string&) { value = true; }; };
  std::vector<CommonOption> options = {
      {"--output",
       "-o",
       "PATH",
       "where the result goes; name=PATH for a named output; - is standard output; {name} makes a batch",
       {},
       [&](const std::string& text) { line.outputs.push_back(text); }},
      {"--picture",
       "",
       "PATH",
       "a picture of the result, or of what else can be drawn of it; as -o picture=PATH",
       {},
       [&](const std::string& text) { line.outputs.push_back("picture=" + text); }},
      {"--threads",
       "",
       "N",
       "threads to use; 0: all of the machine",
       {},
       [&](const std::string& text) { line.threads = static_cast<int>(whole_number("--threads", text, 0, 1024)); }},
      {"--explain", "", "", "print what would be done, and do nothing", {}, flag(line.explain)},
      {"--stages",
       "",
       "FOLDER",
       "write every intermediate result there, to look at",
       {},
       [&](const std::string& text) { line.stages = text; }},
      {"--frames",
       "",
       "N",
       "render, turntable: so many pictures, around the model or through its animation; {frame:04} in -o numbers them",
       {},
       [&](const std::string& text) { line.frames = static_cast<int>(whole_number("--frames", text, 1, 1'000'000)); }},
      {"--views",
       "",
       "N",
       "render: so many pictures from all over the sphere",
       {},
       [&](const std::string& text) { line.views = static_cast<int>(whole_number("--views", text, 1, 1'000'000)); }},
      {"--seed",
       "",
       "N",
       "of --views: others for another number",
       {},
       [&](const std::string& text) {
         line.seed = static_cast<std::uint64_t>(whole_number("--seed", text, 0, std::int64_t{1} << 62));
       }},
      {"--force", "", "", "batches: do again what is done already", {}, flag(line.force)},
      {"--json", "", "", "machine-readable output", {}, flag(line.json)},
      {"--quiet", "-q", "", "no warnings, no progress", {}, flag(line.quiet)},
      {"--verbose", "-v", "", "say what is done", {}, flag(line.verbose)},
      {"--strict", "", "", "warnings are errors", {}, flag(line.strict)},
      {"--max-memory",
       "",
       "SIZE",
       "images held at once, such as 4G; beyond it temporary files are used",
       {},
       [&](const std::string& text) {
         line.limits.memory_bytes = whole_number("--max-memory", text, 1, std::int64_t{1} << 50, true);
       }},
      {"--max-pixels",
       "",
       "N",
       "pixels of one image; larger ones are refused",
       {},
       [&](const std::string& text) {
         line.limits.pixels = whole_number("--max-pixels", text, 1, std::int64_t{1} << 50);
       }},
      {"--page",
       "",
       "N",
       "page of a TIFF to read, from 0",
       {},
       [&](const std::string& text) { line.read.page = static_cast<int>(whole_number("--page", text, 0, 1 << 20)); }},
      {"--layer",
       "",
       "NAME",
       "layer of an OpenEXR file to read",
       {},
       [&](const std::string& text) { line.read.layer = text; }},
      {"--quality",
       "",
       "N",
       "of JPEG and WebP, 1–100",
       {},
       [&](const std::string& text) {
         line.write.quality = static_cast<int>(whole_number("--quality", text, 1, 100));
       }},
      {"--lossless", "", "", "WebP without loss", {}, flag(line.write.lossless)},
      {"--compression",
       "",
       "NAME",
       "of TIFF: none, lzw, deflate, packbits, zstd; of OpenEXR: none, rle, zip, piz",
       {},
       [&](const std::string& text) { line.write.compression = text; }},
      {"--compression-level",
       "",
       "N",
       "of PNG and deflated TIFF, 0–9",
       {},
       [&](const std::string& text) {
         line.write.compression_level = static_cast<int>(whole_number("--compression-level", text, 0, 9));
       }},
      {"--tile",
       "",
       "N",
       "write TIFF and OpenEXR in tiles of N×N pixels",
       {},
       [&](const std::string& text) { line.write.tile = static_cast<int>(whole_number("--tile", text, 16, 65536)); }},
      {"--type",
       "",
       "TYPE",
       "pixel type in the file",
       {"u8", "u16", "f32"},
       [&](const std::string& text) {
         const auto type = text == "u8"    ? std::optional(PixelType::U8)
                           : text == "u16" ? std::optional(PixelType::U16)
                           : text == "f32" ? std::optional(PixelType::F32)
                                           : std::nullopt;
         if (!type) refuse("--type", text, "u8, u16 or f32");
         line.write.type = type;
       }},
      {"--normalize",
       "",
       "",
       "floats into integer files: stretch minimum–maximum to the full range",
       {},
       flag(line.write.normalize)},
      {"--background",
       "",
       "COLOR",
       "#rrggbb under transparent pixels in formats without alpha",
       {},
       [&](const std::string& text) { set_background(line.write, text); }},
      {"--help", "-h", "", "this", {}, flag(line.help)},
  };
  std::vector<CommonOption> of_models = model_options(line);
  options.insert(options.end() - 1, std::make_move_iterator(of_models.begin()),
                 std::make_move_iterator(of_models.end()));
  return options;
}

CommandLine parse_command_line(int count, const char* const* words) {
  CommandLine line;
  line.words.assign(words + 1, words + count);
  if (count < 2) {
    line.command = "help";
    return line;
  }
  const std::string first = words[1];
  if (first == "--help" || first == "-h" || first == "help") {
    line.command = "help";
    return line;
  }
  if (first == "--version" || first == "version") {
    line.command = "version";
    return line;
  }
  line.command = first;
  line.operation = find_operation(first == "turntable" ? "render" : first);
  const std::vector<std::string> names = command_names();
  if (std::find(names.begin(), names.end(), first) == names.end()) {
    throw Error(Error::Argument, fmt::format("{}: no such command or operation{}; azulejo ops lists the operations",
                                             first, did_you_mean(first, names)));
  }

  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  add_common(app, line);
  OperationOptions options(app);
  if (line.operation != nullptr) add_operation_options(app, options, line, *line.operation);
  app.add_option("positionals", line.positionals);
  std::vector<std::string> rest(words + 2, words + count);
  std::reverse(rest.begin(), rest.end());  // as CLI11 wants them
  try {
    app.parse(rest);
  } catch (const CLI::ParseError& error) {
    std::string message = error.what();
    std::replace(message.begin(), message.end(), '\n', ' ');
    throw Error(Error::Argument, message);
  }
  options.append_to(line.arguments);
  for (const std::string& word : app.remaining()) throw Error(Error::Argument, explain_extra(word, line));
  return line;
}

}  // namespace azulejo::cli
