#include "azulejo/stage_text.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

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

}  // namespace

bool is_name(std::string_view text) {
  return !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_') &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

std::size_t leading_name(std::string_view text) {
  const std::size_t equals = text.find('=');
  return equals != std::string_view::npos && is_name(text.substr(0, equals)) ? equals : 0;
}

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

}  // namespace azulejo
