#include "manual.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo::reference {
namespace {

/// A declaration with the comment above it.
struct Item {
  std::vector<std::string> comment;      ///< lines, without ///
  std::vector<std::string> declaration;  ///< lines
  bool apart = false;                    ///< an empty line was above it
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Levels of braces and parentheses that a line opens, minus those that it closes.
int depth_of(const std::string& line) {
  const std::string code = line.substr(0, line.find("//"));
  return static_cast<int>(std::count_if(code.begin(), code.end(), [](char c) { return c == '{' || c == '('; }) -
                          std::count_if(code.begin(), code.end(), [](char c) { return c == '}' || c == ')'; }));
}

/// Whether a declaration ends with this line, at depth 0.
bool is_end(const std::string& line) {
  const std::string code = line.substr(0, line.find("  //"));
  return code.ends_with(';') || code.ends_with('}');
}

/// Those between the braces of the namespace.
std::vector<Item> items_of(const std::string& header) {
  std::vector<Item> items;
  Item item;
  int depth = 0;
  bool inside = false;
  for (const std::string& line : lines_of(header)) {
    if (line.starts_with("}  // namespace")) break;
    if (!inside) {
      inside = line == "namespace azulejo {";
      continue;
    }
    if (item.declaration.empty() && line.empty()) {
      item.apart = true;
    } else if (item.declaration.empty() && line.starts_with("///")) {
      item.comment.push_back(line.size() > 4 ? line.substr(4) : "");
    } else {
      item.declaration.push_back(line);
      depth += depth_of(line);
      if (depth == 0 && is_end(line)) {
        items.push_back(std::move(item));
        item = {};
      }
    }
  }
  return items;
}

bool declares(const Item& item, const std::string& name) {
  return !item.declaration.empty() && item.declaration[0].find(" " + name + "(") != std::string::npos;
}

/// What readers of a reference needn't see.
bool is_hidden(const Item& item) {
  const std::string& first = item.declaration[0];
  return first.find("enum_names(") != std::string::npos ||
         (item.declaration.size() == 1 && (first.starts_with("struct ") || first.starts_with("class ")));
}

std::string code_of(const Item& item) {
  std::string code;
  static const std::string exported = "AZULEJO_EXPORT ";
  const bool shortened = item.declaration[0].starts_with(exported);
  bool is_private = false;
  for (std::string line : item.declaration) {
    if (line == " private:" || line == "private:") is_private = true;
    if (line.starts_with("}")) is_private = false;
    if (is_private) continue;
    // What goes on below an open parenthesis stays there.
    if (shortened && line.find_first_not_of(' ') > exported.size()) line.erase(0, exported.size());
    line = std::regex_replace(line, std::regex(exported), "");
    code += line + "\n";
  }
  return std::regex_replace(code, std::regex("\n\n\\};"), "\n};");
}

/// Paragraphs as they are; lines "key  what it says", continued by lines that begin with spaces, as tables.
std::string prose_of(const std::vector<std::string>& comment) {
  static const std::regex row(R"(^(\S(?:.*?\S)?)\s{2,}(\S.*)$)");
  std::string text;
  bool in_table = false;
  const auto end_table = [&] {
    if (in_table) text += " |\n\n";
    in_table = false;
  };
  for (const std::string& line : comment) {
    std::smatch match;
    if (line.empty()) {
      end_table();
      text += "\n\n";
    } else if (in_table && line.starts_with("  ")) {
      text += fmt::format(" {}", escaped(line.substr(line.find_first_not_of(' '))));
    } else if (std::regex_match(line, match, row)) {
      text += in_table ? " |\n" : "\n\n| | |\n|---|---|\n";
      text += fmt::format("| {} | {}", escaped(match[1]), escaped(match[2]));
      in_table = true;
    } else {
      end_table();
      const bool begins = text.empty() || text.back() == '\n';
      text += fmt::format("{}{}", begins ? "" : line.starts_with("- ") ? "\n" : " ", escaped(line));
    }
  }
  end_table();
  return std::regex_replace(text + "\n\n", std::regex("\n{3,}"), "\n\n");
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  bool code = false;
  for (const char c : text) {
    if (c == '`') code = !code;
    if (c == '|' || (!code && (c == '*' || c == '<' || c == '_' || c == '$'))) safe += '\\';
    safe += c;
  }
  return safe;
}

bool tells_of(const std::string& header, const std::string& name) {
  const std::vector<Item> items = items_of(header);
  return std::any_of(items.begin(), items.end(), [&](const Item& item) {
    return declares(item, name) && !item.comment.empty() &&
           std::any_of(item.declaration.begin(), item.declaration.end(),
                       [](const std::string& line) { return line.find("AZULEJO_EXPORT") != std::string::npos; });
  });
}

std::string manual(const std::string& header, const std::string& path, const std::string& name) {
  const std::vector<Item> items = items_of(header);
  const auto main = std::find_if(items.begin(), items.end(),
                                 [&](const Item& item) { return declares(item, name) && !item.comment.empty(); });
  if (main == items.end())
    throw Error(Error::Data, fmt::format("{}: declares no function {} with a comment above it", path, name));
  std::string code;
  for (const Item& item : items) {
    if (is_hidden(item)) continue;
    if (item.apart && !code.empty()) code += "\n";
    if (&item != &*main) {
      for (const std::string& line : item.comment) code += line.empty() ? "///\n" : "/// " + line + "\n";
    }
    code += code_of(item);
  }
  return prose_of(main->comment) + fmt::format("```cpp\n#include <{}>\n\n{}```\n", path, code);
}

}  // namespace azulejo::reference
