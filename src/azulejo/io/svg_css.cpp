#include "azulejo/io/svg_css.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/svg_text.h"
#include "azulejo/io/text_numbers.h"

namespace azulejo {
namespace {

constexpr std::array<std::string_view, kSvgProperties> kNames = {"clip-path",
                                                                 "clip-rule",
                                                                 "color",
                                                                 "display",
                                                                 "fill",
                                                                 "fill-opacity",
                                                                 "fill-rule",
                                                                 "filter",
                                                                 "font-size",
                                                                 "marker",
                                                                 "marker-end",
                                                                 "marker-mid",
                                                                 "marker-start",
                                                                 "mask",
                                                                 "opacity",
                                                                 "overflow",
                                                                 "stop-color",
                                                                 "stop-opacity",
                                                                 "stroke",
                                                                 "stroke-dasharray",
                                                                 "stroke-dashoffset",
                                                                 "stroke-linecap",
                                                                 "stroke-linejoin",
                                                                 "stroke-miterlimit",
                                                                 "stroke-opacity",
                                                                 "stroke-width",
                                                                 "transform",
                                                                 "vector-effect",
                                                                 "visibility"};

constexpr std::uint64_t kMostComparisons = 200'000'000;

/// Where the first of `wanted` stands that is in no string and no parentheses.
std::size_t find_outside(std::string_view text, std::string_view wanted) {
  std::size_t depth = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (depth == 0 && wanted.find(c) != std::string_view::npos) {
      return i;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(') {
      ++depth;
    } else if (c == ')' && depth > 0) {
      --depth;
    }
  }
  return text.size();
}

std::string without_comments(std::string_view css) {
  std::string result;
  while (!css.empty()) {
    const std::size_t begin = std::min(css.find("/*"), css.size());
    result.append(css.substr(0, begin));
    css.remove_prefix(begin);
    const std::size_t end = css.find("*/", 2);
    css.remove_prefix(end == std::string_view::npos ? css.size() : end + 2);
  }
  return result;
}

/// A block of braces at the front, without them; blocks in it stay. Up to the end if it doesn't close.
std::string_view take_block(std::string_view& text) {
  std::size_t depth = 0;
  std::size_t end = 0;
  for (; end < text.size(); ++end) {
    if (text[end] == '{') ++depth;
    if (text[end] == '}' && --depth == 0) break;
  }
  const std::string_view block = text.substr(1, end > 0 ? end - 1 : 0);
  text.remove_prefix(std::min(end + 1, text.size()));
  return block;
}

/// Cuts !important off.
bool take_important(std::string_view& value) {
  const std::size_t mark = value.rfind('!');
  if (mark == std::string_view::npos || !same_word(without_blanks(value.substr(mark + 1)), "important")) return false;
  value = without_blanks(value.substr(0, mark));
  return true;
}

bool is_name_letter(char c) {
  const char lower = static_cast<char>(c | 0x20);
  return (lower >= 'a' && lower <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

std::string_view take_name(std::string_view& text) {
  const auto stop = std::find_if_not(text.begin(), text.end(), is_name_letter);
  const std::string_view name = text.substr(0, static_cast<std::size_t>(stop - text.begin()));
  text.remove_prefix(name.size());
  return name;
}

template <class F>
void for_each_word(std::string_view text, const F& f) {
  skip_blanks(text);
  while (!text.empty()) {
    const auto stop = std::find_if(text.begin(), text.end(), is_svg_blank);
    f(text.substr(0, static_cast<std::size_t>(stop - text.begin())));
    text.remove_prefix(static_cast<std::size_t>(stop - text.begin()));
    skip_blanks(text);
  }
}

bool has_word(std::string_view text, std::string_view word) {
  bool found = false;
  for_each_word(text, [&](std::string_view each) { found = found || each == word; });
  return found;
}

}  // namespace

std::optional<SvgProperty> svg_property(std::string_view name) {
  const auto* const found = std::lower_bound(kNames.begin(), kNames.end(), name);
  if (found == kNames.end() || *found != name) return std::nullopt;
  return static_cast<SvgProperty>(found - kNames.begin());
}

void SvgDeclarations::take(const SvgDeclarations& other) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (other.values_[i].data() != nullptr) values_[i] = other.values_[i];
  }
}

void parse_declarations(std::string_view text, SvgDeclared& declared) {
  while (!text.empty()) {
    const std::size_t end = find_outside(text, ";");
    const std::string_view declaration = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) continue;
    const std::optional<SvgProperty> property = svg_property(without_blanks(declaration.substr(0, colon)));
    std::string_view value = without_blanks(declaration.substr(colon + 1));
    if (!property || value.empty()) continue;
    const bool important = take_important(value);
    (important ? declared.important : declared.plain).set(*property, value);
  }
}

std::optional<SvgStyleSheet::Rule> SvgStyleSheet::parse_selector(std::string_view text) {
  Rule rule;
  text = without_blanks(text);
  if (text.empty()) return std::nullopt;
  if (text.front() == '*') {
    text.remove_prefix(1);
  } else {
    rule.type = take_name(text);
  }
  while (!text.empty()) {
    const char kind = text.front();
    text.remove_prefix(1);
    const std::string_view name = take_name(text);
    if (name.empty() || (kind != '.' && kind != '#') || (kind == '#' && !rule.id.empty())) return std::nullopt;
    if (kind == '.') {
      rule.classes.push_back(name);
    } else {
      rule.id = name;
    }
  }
  const auto classes = static_cast<std::uint32_t>(std::min<std::size_t>(rule.classes.size(), 1000));
  rule.specificity = (rule.id.empty() ? 0 : 1'000'000U) + classes * 1000 + (rule.type.empty() ? 0U : 1U);
  return rule;
}

void SvgStyleSheet::add_rule(std::string_view selectors, std::string_view declarations, SvgNotes& notes) {
  while (!selectors.empty()) {
    const std::size_t end = find_outside(selectors, ",");
    const std::string_view selector = selectors.substr(0, end);
    selectors.remove_prefix(std::min(end + 1, selectors.size()));
    std::optional<Rule> rule = parse_selector(selector);
    if (!rule) {
      notes.left_out("rules of style sheets with selectors of several steps");
      continue;
    }
    rule->declarations = declarations;
    const auto index = static_cast<std::uint32_t>(rules_.size());
    std::vector<std::uint32_t>& list = !rule->id.empty()        ? by_id_[rule->id]
                                       : !rule->classes.empty() ? by_class_[rule->classes.back()]
                                       : !rule->type.empty()    ? by_type_[rule->type]
                                                                : others_;
    list.push_back(index);
    rules_.push_back(std::move(*rule));
  }
}

void SvgStyleSheet::add(std::string_view css, SvgNotes& notes) {
  texts_.push_back(without_comments(css));
  std::string_view text = texts_.back();
  for (skip_blanks(text); !text.empty(); skip_blanks(text)) {
    // The marks that once hid style sheets from old programs.
    if (text.starts_with("<!--") || text.starts_with("-->")) {
      text.remove_prefix(text.front() == '<' ? 4 : 3);
      continue;
    }
    const bool at_rule = text.front() == '@';
    const std::size_t end = find_outside(text, at_rule ? "{;" : "{");
    const std::string_view prelude = text.substr(0, end);
    text.remove_prefix(end);
    std::string_view block;
    if (!text.empty() && text.front() == '{') {
      block = take_block(text);
    } else if (!text.empty()) {
      text.remove_prefix(1);
    }
    if (at_rule) {
      notes.left_out(quoted_word(prelude.substr(0, std::min(prelude.find_first_of(" \t\r\n\"'"), prelude.size()))) +
                     " of style sheets");
    } else {
      add_rule(prelude, block, notes);
    }
  }
}

void SvgStyleSheet::count(std::size_t comparisons) const {
  comparisons_ += comparisons;
  if (comparisons_ > kMostComparisons) {
    throw Error(Error::Resource,
                fmt::format("{}: its style sheets take more than {} comparisons", file_, kMostComparisons));
  }
}

void SvgStyleSheet::apply(std::string_view type, std::string_view id, std::string_view classes,
                          SvgDeclared& declared) const {
  std::vector<std::uint32_t> matching;
  const auto fits = [&](const Rule& rule) {
    const auto has = [&](std::string_view name) { return has_word(classes, name); };
    count(1 + rule.classes.size() * (1 + classes.size() / 16));
    return (rule.type.empty() || rule.type == type) && (rule.id.empty() || rule.id == id) &&
           std::all_of(rule.classes.begin(), rule.classes.end(), has);
  };
  const auto look = [&](const std::vector<std::uint32_t>& list) {
    for (const std::uint32_t index : list) {
      if (fits(rules_[index])) matching.push_back(index);
    }
  };
  const auto look_in = [&](const Index& index, std::string_view name) {
    const auto found = index.find(name);
    if (found != index.end()) look(found->second);
  };
  if (!id.empty()) look_in(by_id_, id);
  if (!by_class_.empty()) for_each_word(classes, [&](std::string_view name) { look_in(by_class_, name); });
  look_in(by_type_, type);
  look(others_);
  std::sort(matching.begin(), matching.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(rules_[a].specificity, a) < std::pair(rules_[b].specificity, b);
  });
  for (const std::uint32_t index : matching) {
    count(rules_[index].declarations.size() / 4);
    parse_declarations(rules_[index].declarations, declared);
  }
}

}  // namespace azulejo
