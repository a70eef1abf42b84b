#include "page.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/operations.h"
#include "command_line.h"
#include "describe.h"
#include "example.h"
#include "groups.h"
#include "manual.h"
#include "samples.h"

namespace azulejo::reference {
namespace {

/// Null if there is none.
const Group* group_of(const std::string& name) {
  for (const Group& group : groups()) {
    if (std::find(group.operations.begin(), group.operations.end(), name) != group.operations.end()) return &group;
  }
  return nullptr;
}

/// As sites make it of a heading.
std::string anchor(std::string title) {
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(c == ' ' ? '-' : std::tolower(c)); });
  return title;
}

std::string ports(const Operation& operation, const char* title, std::vector<Port> Operation::*list) {
  if ((operation.*list).empty()) return "";
  std::string text = fmt::format("| {} | | | file |\n|---|---|---|---|\n", title);
  for (std::size_t i = 0; i < (operation.*list).size(); ++i) {
    const Port& port = (operation.*list)[i];
    std::string kinds = cli::kinds_of(operation, list, i);
    for (std::size_t bar = kinds.find('|'); bar != std::string::npos; bar = kinds.find('|'))
      kinds.replace(bar, 1, ", ");
    text += fmt::format("| `{}` | {} | {}{} | {} |\n", port.name, kinds, escaped(port.help),
                        port.repeated   ? "; one or more"
                        : port.optional ? "; may be left out"
                                        : "",
                        escaped(cli::file_of(operation, port)));
  }
  return text + "\n";
}

std::string options(const Operation& operation) {
  const std::vector<VariantField> fields = fields_of(operation);
  if (fields.empty()) return "It has no options.\n\n";
  std::string text = "| option | | values | default |\n|---|---|---|---|\n";
  for (const auto& [variant, field, kinds] : fields) {
    const std::string otherwise = cli::default_of(*variant, *field);
    text += fmt::format("| `{}` | {}{} | {} | {} |\n", cli::flag_of(field->name), escaped(field->help),
                        kinds.empty() ? "" : "; of " + kinds, escaped(expected(*field)),
                        otherwise.empty() ? "" : "`" + otherwise + "`");
  }
  return text + "\n";
}

std::string called(const Operation& operation) {
  std::string text = "```\n" + cli::usage(operation) + "\n```\n\n";
  text += ports(operation, "input", &Operation::inputs) + ports(operation, "output", &Operation::outputs);
  text += options(operation);
  if (cli::takes_within(operation)) {
    text +=
        "Selected area: `--within` changes nothing outside of a rectangle, a mask or a region of labels, `--feather`\n"
        "fades the change in ([more](../images.md#a-part-of-the-image)).\n\n";
  }
  return text;
}

/// A file as pages beside it name it.
std::string beside(const std::string& file) { return file.substr(std::string("operations/").size()); }

/// The ending of the file that an example's result would be written to.
const char* ending_of(const Value& value, const Shown& shown) {
  if (value.mesh() != nullptr || value.scene() != nullptr) return "glb";
  return shown.note.empty() ? "png" : "exr";
}

/// The pictures that go into an example, then the one that comes out.
std::string pictures(const std::string& words, const std::string& result, const std::string& picture,
                     const std::string& caption) {
  std::string names = "|";
  std::string rule = "|";
  std::string shown = "|";
  for (const Sample& sample : samples_in(words)) {
    if (!sample.has_picture()) continue;
    names += fmt::format(" `{}` |", sample.name);
    rule += "---|";
    shown += fmt::format(" ![{}]({}) |", sample.what, beside(sample.picture()));
  }
  return fmt::format("{} `{}` |\n{}---|\n{} ![{}]({}) |\n\n", names, result, rule, shown, caption, beside(picture));
}

/// Runs an example and shows it. number: from 1
std::string shown_example(Book& book, const Operation& operation, const Example& example, std::size_t number) {
  const Value value = computed(example.words);
  std::string text;
  if (value.report() != nullptr) {
    text = fmt::format("```sh\nazulejo run {}\n```\n\n{}\n\n", example.words, escaped(example.caption));
    return text + fmt::format("```json\n{}\n```\n\n", shortened(value.report()->json));
  }
  const Shown result = shown(value);
  const std::string stem = fmt::format("{}-{}", operation.name, number);
  const std::string picture = fmt::format("operations/pictures/{}.webp", stem);
  book.add_picture(picture, result.image);
  const std::string file = fmt::format("{}.{}", operation.name, ending_of(value, result));
  text = fmt::format("```sh\nazulejo run {} -o {}\n```\n\n{}{}\n\n", example.words, file, escaped(example.caption),
                     result.note.empty() ? "" : " " + result.note);
  return text + pictures(example.words, file, picture, example.caption);
}

std::string examples(Book& book, const Operation& operation) {
  if (operation.examples.empty()) book.add_fault(operation.name + ": has no example, see with_examples");
  std::string text = operation.examples.empty() ? "" : "## Examples\n\n";
  for (std::size_t i = 0; i < operation.examples.size(); ++i) {
    try {
      text += shown_example(book, operation, operation.examples[i], i + 1);
    } catch (const Error& error) {
      book.add_fault(fmt::format("{}: {}: {}", operation.name, operation.examples[i].words, error.what()));
    }
  }
  return text;
}

/// The header, below src, of the operation's name, or of a name that begins with it, that tells of its function. Throws
/// Error(Data) if there is none, or several.
std::string header_of(const std::string& name, const std::string& source) {
  std::vector<std::string> found;
  for (const auto& folder : std::filesystem::directory_iterator(source + "/src/azulejo")) {
    if (!folder.is_directory()) continue;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      const std::string stem = file.path().stem().string();
      const bool named = stem == name || stem.starts_with(name + "_");
      if (file.path().extension() == ".h" && named && tells_of(read_text(file.path().string()), name))
        found.push_back(fmt::format("azulejo/{}/{}.h", folder.path().filename().string(), stem));
    }
  }
  if (found.size() != 1)
    throw Error(Error::Data, fmt::format("{} headers with a comment on {}, expected one", found.size(), name));
  return found[0];
}

std::string in_cpp(Book& book, const Operation& operation, const std::string& source) {
  try {
    const std::string header = header_of(operation.name, source);
    return "## In C++\n\n" + manual(read_text(source + "/src/" + header), header, operation.name);
  } catch (const Error& error) {
    book.add_fault(fmt::format("{}: {}", operation.name, error.what()));
    return "";
  }
}

/// A table row of the index, with the picture of the first example that has one.
std::string row(const Book& book, const Operation& operation) {
  std::string picture;
  for (std::size_t i = operation.examples.size(); i > 0; --i) {
    const std::string file = fmt::format("pictures/{}-{}.webp", operation.name, i);
    if (book.has_picture("operations/" + file)) picture = fmt::format("<img src=\"{}\" width=\"150\" alt=\"\">", file);
  }
  return fmt::format("| {} | [{}]({}.md) | {} |\n", picture, operation.name, operation.name,
                     escaped(operation.summary));
}

std::string sample_table() {
  std::string text = "## The pictures that examples work on\n\n";
  text += "They are painted and rendered by azulejo itself ([docs/reference](../reference)).\n\n";
  text += "| | file | |\n|---|---|---|\n";
  for (const Sample& sample : samples()) {
    const std::string made =
        sample.words.empty() ? "" : fmt::format("; `azulejo run {} -o {}`", sample.words, sample.name);
    const std::string picture =
        sample.has_picture() ? fmt::format("<img src=\"{}\" width=\"150\" alt=\"\">", beside(sample.picture())) : "";
    text += fmt::format("| {} | `{}` | {}{} |\n", picture, sample.name, sample.what, made);
  }
  return text;
}

}  // namespace

void add_page(Book& book, const Operation& operation, const std::string& source) {
  std::string text = fmt::format("# {}\n\n{}\n\n", operation.name, escaped(operation.summary));
  if (const Group* const group = group_of(operation.name))
    text += fmt::format("[{}](README.md#{})\n\n", group->title, anchor(group->title));
  text += called(operation) + examples(book, operation) + in_cpp(book, operation, source);
  while (text.ends_with("\n\n")) text.pop_back();
  book.add_text(fmt::format("operations/{}.md", operation.name), text);
}

void add_index(Book& book) {
  std::string text = "# Operations\n\n";
  text +=
      "Made from the list of operations by `make reference`; `azulejo ops` lists them, `azulejo NAME --help` tells\n";
  text += "the same as a page. [Images](../images.md) says how they work together, [rendering](../rendering.md) what\n";
  text += "becomes of models.\n\n";
  for (const Group& group : groups()) {
    text += fmt::format("## {}\n\n{}\n\n| | | |\n|---|---|---|\n", group.title, group.sentence);
    for (const std::string& name : group.operations) {
      if (const Operation* const operation = find_operation(name)) text += row(book, *operation);
    }
    text += "\n";
  }
  book.add_text("operations/README.md", text + sample_table());
}

}  // namespace azulejo::reference
