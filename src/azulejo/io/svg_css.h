#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "azulejo/io/svg_notes.h"

namespace azulejo {

/// Properties that count, in the order of their names.
enum class SvgProperty : std::uint8_t {
  ClipPath,
  ClipRule,
  Color,
  Display,
  Fill,
  FillOpacity,
  FillRule,
  Filter,
  FontSize,
  Marker,
  MarkerEnd,
  MarkerMid,
  MarkerStart,
  Mask,
  Opacity,
  Overflow,
  StopColor,
  StopOpacity,
  Stroke,
  StrokeDasharray,
  StrokeDashoffset,
  StrokeLinecap,
  StrokeLinejoin,
  StrokeMiterlimit,
  StrokeOpacity,
  StrokeWidth,
  Transform,
  VectorEffect,
  Visibility,
};
inline constexpr std::size_t kSvgProperties = static_cast<std::size_t>(SvgProperty::Visibility) + 1;

std::optional<SvgProperty> svg_property(std::string_view name);

/// The values that are declared for an element; those without data are not.
class SvgDeclarations {
 public:
  std::string_view operator[](SvgProperty property) const { return values_[static_cast<std::size_t>(property)]; }
  bool has(SvgProperty property) const { return (*this)[property].data() != nullptr; }
  void set(SvgProperty property, std::string_view value) { values_[static_cast<std::size_t>(property)] = value; }
  /// Those of `other` take the place of these.
  void take(const SvgDeclarations& other);

 private:
  std::array<std::string_view, kSvgProperties> values_;
};

/// Declarations with equal rights, and those marked !important.
struct SvgDeclared {
  SvgDeclarations plain;
  SvgDeclarations important;
};

/// Reads "fill:red; stroke: none !important", which must outlive the declarations.
void parse_declarations(std::string_view text, SvgDeclared& declared);

/// The style sheets of a file. Selectors of one step are understood: *, type, .class, #id and what they make together
/// ("path.a.b"), in lists; rules with others are left out and noted, and so are those in @media and the like.
/// Source  CSS 2.1, 4.1, 5 and 6.4
class SvgStyleSheet {
 public:
  explicit SvgStyleSheet(std::string file) : file_(std::move(file)) {}
  void add(std::string_view css, SvgNotes& notes);
  bool empty() const { return rules_.empty(); }

  /// Adds what the rules declare for an element, the most specific last.
  /// Throws Error(Resource) after 2·10⁸ comparisons in all.
  void apply(std::string_view type, std::string_view id, std::string_view classes, SvgDeclared& declared) const;

 private:
  struct Rule {
    std::string_view type;  ///< empty: any
    std::string_view id;    ///< empty: any
    std::vector<std::string_view> classes;
    std::uint32_t specificity = 0;
    std::string_view declarations;
  };
  using Index = std::unordered_map<std::string_view, std::vector<std::uint32_t>>;

  void add_rule(std::string_view selectors, std::string_view declarations, SvgNotes& notes);
  static std::optional<Rule> parse_selector(std::string_view text);
  void count(std::size_t comparisons) const;

  std::string file_;               ///< for messages
  std::deque<std::string> texts_;  ///< without comments
  std::vector<Rule> rules_;
  Index by_id_;  ///< each rule is in one of these
  Index by_class_;
  Index by_type_;
  std::vector<std::uint32_t> others_;
  mutable std::uint64_t comparisons_ = 0;
};

}  // namespace azulejo
