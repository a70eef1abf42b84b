#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/io/svg_document.h"
#include "azulejo/io/svg_gradient.h"
#include "azulejo/io/svg_style.h"

namespace azulejo {

/// Counts what is made of a file, and refuses too much of it.
class SvgBudget {
 public:
  static constexpr std::size_t kMostCopies = 1'000'000;
  static constexpr std::size_t kMostCopiedBytes = std::size_t{1} << 28;

  SvgBudget(std::string file, const Run& run) : file_(std::move(file)), run_(run) {}
  /// Throws Error(Resource) above the limit of memory.
  void add_bytes(std::size_t bytes);
  /// An element that stands in the file already. Throws Error(Resource) above kMostCopies, and where their attributes
  /// take more than kMostCopiedBytes.
  void add_copy(const pugi::xml_node& node);
  /// `count` looks at what was made already, which count as copies do.
  void add_looks(std::size_t count);

 private:
  void check_copies() const;

  std::string file_;
  const Run& run_;
  std::size_t bytes_ = 0;
  std::size_t copies_ = 0;
  std::size_t copied_bytes_ = 0;
};

/// Puts styles into a drawing, equal ones once.
class SvgStyles {
 public:
  SvgStyles(Drawing& drawing, const SvgDocument& document, SvgNotes& notes, SvgBudget& budget)
      : drawing_(drawing), document_(document), notes_(notes), budget_(budget), gradients_(document, notes) {}

  /// How a path is painted; the element's opacity is left out.
  DrawingStyle style_of(const SvgStyle& style, const PathView& path, const SvgViewport& viewport);
  std::uint32_t index_of(const DrawingStyle& style);

 private:
  std::optional<Paint> paint(const SvgPaint& paint, float opacity, const SvgStyle& style, const PathView& path,
                             const SvgViewport& viewport);
  std::optional<Paint> served(const pugi::xml_node& server, float opacity, const PathView& path,
                              const SvgViewport& viewport);
  std::uint32_t pattern(const pugi::xml_node& node, Gradient gradient);

  Drawing& drawing_;
  const SvgDocument& document_;
  SvgNotes& notes_;
  SvgBudget& budget_;
  SvgGradients gradients_;
  std::unordered_multimap<std::size_t, std::uint32_t> known_;  ///< styles by their hash
  std::unordered_map<const void*, std::uint32_t> patterns_;    ///< the last that a gradient made
};

}  // namespace azulejo
