#include "azulejo/io/svg_document.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/decode_pass.h"
#include "azulejo/io/svg_text.h"
#include "azulejo/io/text_numbers.h"

namespace azulejo {
namespace {

struct NamedElement {
  std::string_view name;
  SvgElement element;
};

// In the order of names.
constexpr std::array kElements = std::to_array<NamedElement>({
    {"a", SvgElement::Group},
    {"animate", SvgElement::Animation},
    {"animateColor", SvgElement::Animation},
    {"animateMotion", SvgElement::Animation},
    {"animateTransform", SvgElement::Animation},
    {"circle", SvgElement::Circle},
    {"clipPath", SvgElement::ClipPath},
    {"color-profile", SvgElement::Silent},
    {"cursor", SvgElement::Silent},
    {"defs", SvgElement::Definitions},
    {"desc", SvgElement::Silent},
    {"ellipse", SvgElement::Ellipse},
    {"filter", SvgElement::Silent},  // noted where it is used
    {"font", SvgElement::Silent},
    {"font-face", SvgElement::Silent},
    {"foreignObject", SvgElement::LeftOut},
    {"g", SvgElement::Group},
    {"image", SvgElement::LeftOut},
    {"line", SvgElement::Line},
    {"linearGradient", SvgElement::Gradient},
    {"marker", SvgElement::Silent},
    {"mask", SvgElement::Silent},
    {"metadata", SvgElement::Silent},
    {"path", SvgElement::Path},
    {"pattern", SvgElement::Pattern},
    {"polygon", SvgElement::Polygon},
    {"polyline", SvgElement::Polyline},
    {"radialGradient", SvgElement::Gradient},
    {"rect", SvgElement::Rectangle},
    {"script", SvgElement::LeftOut},
    {"set", SvgElement::Animation},
    {"stop", SvgElement::Stop},
    {"style", SvgElement::Silent},
    {"svg", SvgElement::Svg},
    {"switch", SvgElement::Switch},
    {"symbol", SvgElement::Symbol},
    {"text", SvgElement::LeftOut},
    {"title", SvgElement::Silent},
    {"use", SvgElement::Use},
    {"view", SvgElement::Silent},
});

/// Of pugixml on 64-bit machines; a tag may have text before it, which is a node too.
constexpr std::size_t kNodeBytes = 64;
constexpr std::size_t kAttributeBytes = 40;

std::size_t line_of(std::string_view text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

/// What stands before the root: marks, blanks, comments, instructions and a DOCTYPE with what it defines. False: the
/// text ends in the middle of it, and so it may be longer than what is seen.
bool skip_prolog(std::string_view& text) {
  const auto skip_past = [&](std::string_view end) {
    const std::size_t found = text.find(end);
    if (found == std::string_view::npos) return false;
    text.remove_prefix(found + end.size());
    return true;
  };
  for (skip_blanks(text); !text.empty(); skip_blanks(text)) {
    if (text.starts_with("<?")) {
      if (!skip_past("?>")) return false;
    } else if (text.starts_with("<!--")) {
      if (!skip_past("-->")) return false;
    } else if (text.starts_with("<!")) {
      const std::size_t stop = text.find_first_of("[>");
      if (stop == std::string_view::npos || (text[stop] == '[' && !skip_past("]"))) return false;
      if (!skip_past(">")) return false;
    } else {
      return true;
    }
  }
  return false;
}

}  // namespace

SvgDocument::SvgDocument(const Input& input, const Run& run, SvgNotes& notes)
    : file_(input.name()), text_(read_text(input, run)), sheet_(file_) {
  parse(run);
  for (root_ = document_.first_child(); root_ && root_.type() != pugi::node_element;) root_ = root_.next_sibling();
  const std::string_view name = root_.name();
  const std::size_t colon = name.find(':');
  if (colon != std::string_view::npos) prefix_ = name.substr(0, colon + 1);
  if (name_of(root_) != "svg") {
    throw Error(Error::Data, fmt::format("{}: its root is {}, expected svg", file_,
                                         name.empty() ? "missing" : "\"" + quoted_word(name) + "\""));
  }
  look_through(notes);
}

void SvgDocument::parse(const Run& run) {
  char* const begin = text_.bytes.data() + text_.begin;
  const std::size_t size = text_.bytes.size() - text_.begin;
  const auto tags = static_cast<std::size_t>(std::count(begin, begin + size, '<'));
  const auto values = static_cast<std::size_t>(std::count(begin, begin + size, '='));
  const std::size_t needed = 2 * size + 2 * tags * kNodeBytes + values * kAttributeBytes;
  if (needed > static_cast<std::size_t>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("{}: its elements may take {} bytes, the limit of memory is {}", file_,
                                             needed, run.limits.memory_bytes));
  }
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(begin, size, pugi::parse_cdata | pugi::parse_escapes);
  if (result.status == pugi::status_out_of_memory) {
    throw Error(Error::Resource, fmt::format("{}: out of memory", file_));
  }
  // The text is changed by parsing, its line feeds aren't.
  if (!result) {
    throw Error(Error::Data,
                fmt::format("{}: line {}: {}", file_, line_of({begin, size}, static_cast<std::size_t>(result.offset)),
                            result.status == pugi::status_no_document_element ? "no element"
                                                                              : std::string(result.description())));
  }
}

/// Finds what has an id, and style sheets.
void SvgDocument::look_through(SvgNotes& notes) {
  pugi::xml_node node = root_;
  for (int level = 0; node;) {
    if (node.type() == pugi::node_element) {
      ++elements_;
      const char* const id = node.attribute("id").value();
      if (*id != 0) ids_.try_emplace(id, node);
      if (name_of(node) == "style") {
        std::string css;
        for (const pugi::xml_node& part : node.children()) css += part.value();
        sheet_.add(css, notes);
      }
    }
    if (node.first_child()) {
      if (++level > kMostLevels) {
        throw Error(Error::Resource, fmt::format("{}: elements in more than {} others", file_, kMostLevels));
      }
      node = node.first_child();
      continue;
    }
    for (; node && node != root_ && !node.next_sibling(); --level) node = node.parent();
    node = node == root_ ? pugi::xml_node() : node.next_sibling();
  }
}

pugi::xml_node SvgDocument::find(std::string_view id) const {
  const auto found = ids_.find(id);
  return found == ids_.end() ? pugi::xml_node() : found->second;
}

std::string_view SvgDocument::name_of(const pugi::xml_node& node) const {
  std::string_view name = node.name();
  if (!name.starts_with(prefix_)) return {};
  name.remove_prefix(prefix_.size());
  return name.find(':') == std::string_view::npos ? name : std::string_view();
}

SvgElement SvgDocument::element_of(const pugi::xml_node& node) const {
  const std::string_view name = name_of(node);
  if (name.empty()) return SvgElement::Silent;
  const auto* const found =
      std::lower_bound(kElements.begin(), kElements.end(), name,
                       [](const NamedElement& each, std::string_view wanted) { return each.name < wanted; });
  return found != kElements.end() && found->name == name ? found->element : SvgElement::Unknown;
}

SvgDeclarations SvgDocument::declarations(const pugi::xml_node& node) const {
  SvgDeclared declared;
  std::string_view style;
  std::string_view classes;
  std::string_view id;
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    if (name == "style") {
      style = attribute.value();
    } else if (name == "class") {
      classes = attribute.value();
    } else if (name == "id") {
      id = attribute.value();
    } else if (const std::optional<SvgProperty> property = svg_property(name)) {
      declared.plain.set(*property, without_blanks(attribute.value()));
    }
  }
  if (!sheet_.empty()) sheet_.apply(name_of(node), id, classes, declared);
  // A style attribute stands above all rules, but not above those marked as important.
  SvgDeclared own;
  parse_declarations(style, own);
  declared.plain.take(own.plain);
  declared.plain.take(declared.important);
  declared.plain.take(own.important);
  return declared.plain;
}

std::string_view svg_reference(const pugi::xml_node& node) {
  const pugi::xml_attribute plain = node.attribute("href");
  return fragment_of((plain ? plain : node.attribute("xlink:href")).value());
}

bool begins_like_svg(std::span<const std::byte> head, std::string_view name) {
  // UTF-16 of ASCII is ASCII without its zeros and marks.
  std::string ascii;
  for (const std::byte each : head) {
    const auto c = static_cast<char>(each);
    if (c > 0) ascii += c;
  }
  std::string_view text = ascii;
  skip_blanks(text);
  if (text.empty() || text.front() != '<') return false;
  if (!skip_prolog(text)) {
    const std::string ending = ending_of(std::string(name));
    return ending == "svg" || ending == "svgz";
  }
  if (text.front() != '<') return false;
  const std::string_view tag = text.substr(1, text.find_first_of(" \t\r\n/>", 1) - 1);
  return tag == "svg" || tag.ends_with(":svg");
}

}  // namespace azulejo
