#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <unordered_map>
#include <vector>

#include "azulejo/data/drawing.h"
#include "azulejo/io/svg_document.h"
#include "azulejo/io/svg_style.h"
#include "azulejo/io/svg_styles.h"

namespace azulejo {

/// The clips that groups of a drawing name. Their content is read later, one by one: clips may be clipped, too.
class SvgClips {
 public:
  struct Clip {
    std::uint32_t group = 0;  ///< whose content is to be read
    pugi::xml_node node;
    SvgViewport viewport;
    bool copied = false;                ///< once more for another box
    std::optional<std::size_t> within;  ///< the clip in whose content it is named
  };

  SvgClips(Drawing& drawing, const SvgDocument& document, SvgNotes& notes, SvgBudget& budget)
      : drawing_(drawing), document_(document), notes_(notes), budget_(budget) {}

  /// The clipPath of this id; null where there is none.
  pugi::xml_node find(std::string_view id);
  static bool is_measured_by_box(const pugi::xml_node& clip);

  /// Clips a group; those measured by a box take `box`, in the group's own coordinates.
  void clip(std::uint32_t group, const pugi::xml_node& node, const SvgViewport& viewport, const Box2& box);
  /// Clips a group to a rectangle.
  void clip_to(std::uint32_t group, const Path& rectangle, std::uint32_t style);

  /// The clip to be read next; null: there is none.
  const Clip* next();
  /// What a group shows, in its own coordinates.
  Box2 box_of(std::uint32_t group);
  /// Takes away clips that clip themselves.
  void break_cycles();

 private:
  bool is_within(const pugi::xml_node& node) const;

  Drawing& drawing_;
  const SvgDocument& document_;
  SvgNotes& notes_;
  SvgBudget& budget_;
  std::vector<Clip> clips_;
  std::size_t read_ = 0;                                   ///< how many were given by `next`
  std::unordered_map<const void*, std::uint32_t> shared_;  ///< groups of those that are the same for all
};

}  // namespace azulejo
