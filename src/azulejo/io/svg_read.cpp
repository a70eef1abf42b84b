#include "azulejo/io/svg_read.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/svg_clips.h"
#include "azulejo/io/svg_shapes.h"
#include "azulejo/io/svg_styles.h"
#include "azulejo/io/svg_text.h"
#include "azulejo/io/svg_view.h"
#include "azulejo/io/text_numbers.h"

namespace azulejo {
namespace {

const glm::dmat3x2 kIdentity(1, 0, 0, 1, 0, 0);

/// An element whose content is being read.
struct Frame {
  pugi::xml_node element;
  pugi::xml_node next;  ///< the child to come
  SvgStyle style;
  SvgViewport viewport;
  std::uint32_t group = 0;
  bool only = false;            ///< `next` is the last
  bool used = false;            ///< `next` is what a use names
  bool copied = false;          ///< read before, elsewhere
  pugi::xml_node clip;          ///< to be measured by the box of a group
  std::uint32_t clipped = 0;    ///< that group
  std::optional<double> width;  ///< of the viewport of what a use names
  std::optional<double> height;
};

bool is_shape(SvgElement element) {
  switch (element) {
    case SvgElement::Path:
    case SvgElement::Rectangle:
    case SvgElement::Circle:
    case SvgElement::Ellipse:
    case SvgElement::Line:
    case SvgElement::Polyline:
    case SvgElement::Polygon: return true;
    default: return false;
  }
}

/// An element that is about to be entered or drawn.
struct Entry {
  pugi::xml_node node;
  SvgStyle style;
  glm::dmat3x2 matrix = kIdentity;
};

class SvgReader {
 public:
  SvgReader(const SvgDocument& document, SvgNotes& notes, const Run& run)
      : document_(document),
        notes_(notes),
        run_(run),
        budget_(document.file(), run),
        styles_(drawing_, document, notes, budget_),
        clips_(drawing_, document, notes, budget_) {}

  Drawing read() {
    enter_root();
    read_frames();
    in_clip_ = true;
    while (const SvgClips::Clip* const clip = clips_.next()) {
      enter_clip(*clip);
      read_frames();
    }
    clips_.break_cycles();
    set_page();
    return std::move(drawing_);
  }

 private:
  void enter_root();
  void enter_clip(const SvgClips::Clip& clip);
  void set_page();
  void read_frames();
  void leave();
  void read_element(const pugi::xml_node& node);
  void push(Frame frame);

  Entry entry_of(const pugi::xml_node& node);
  std::uint32_t add_group(const Entry& entry, std::uint32_t parent);
  void clip_group(std::uint32_t group, const Entry& entry, const SvgViewport& viewport, Frame& frame);
  void enter_group(const Entry& entry);
  void enter_switch(const Entry& entry);
  void enter_use(const Entry& entry);
  void enter_viewport(const Entry& entry);
  void draw(SvgElement element, const Entry& entry);
  std::uint32_t wrapped(const Entry& entry, const Box2& box, bool faded);
  Frame& top() { return frames_.back(); }

  const SvgDocument& document_;
  SvgNotes& notes_;
  const Run& run_;
  SvgPage page_;
  Drawing drawing_;
  SvgBudget budget_;
  SvgStyles styles_;
  SvgClips clips_;
  std::vector<Frame> frames_;
  Path path_;  ///< of the shape at hand
  std::size_t seen_ = 0;
  bool in_clip_ = false;
};

void SvgReader::enter_root() {
  const pugi::xml_node root = document_.root();
  page_ = svg_page(root);
  drawing_.groups[0].id = root.attribute("id").value();
  Frame outside;
  outside.viewport = page_.viewport;
  frames_.push_back(std::move(outside));
  Entry entry = entry_of(root);
  Frame frame = top();
  frames_.clear();
  if (!entry.style.displayed) return;
  entry.matrix = combined(page_.page_from_user, entry.matrix);
  frame.element = root;
  frame.next = root.first_child();
  if (entry.matrix != kIdentity || entry.style.opacity < 1 || !entry.style.clip_path.empty()) {
    frame.group = drawing_.add_group(to_floats(entry.matrix), entry.style.opacity, 0);
    clip_group(frame.group, entry, frame.viewport, frame);
  }
  frame.style = std::move(entry.style);
  push(std::move(frame));
}

void SvgReader::enter_clip(const SvgClips::Clip& clip) {
  Frame frame;
  frame.element = clip.node;
  frame.next = clip.node.first_child();
  frame.viewport = clip.viewport;
  frame.group = clip.group;
  frame.copied = clip.copied;
  frame.style = computed_style(SvgStyle(), document_.declarations(clip.node), clip.viewport, notes_);
  if (!frame.style.clip_path.empty()) {
    const pugi::xml_node other = clips_.find(frame.style.clip_path);
    if (other && SvgClips::is_measured_by_box(other)) {
      notes_.left_out("a clip of a clipPath that is measured by a box");
    } else if (other) {
      clips_.clip(clip.group, other, clip.viewport, {});
    }
  }
  push(std::move(frame));
}

/// A page without a size is as large as what is on it.
void SvgReader::set_page() {
  drawing_.width = std::max(0.0F, to_float(page_.width));
  drawing_.height = std::max(0.0F, to_float(page_.height));
  drawing_.unit = page_.unit;
  if (drawing_.width > 0 && drawing_.height > 0) return;
  const Box2 box = bounds(drawing_);
  if (drawing_.width == 0) drawing_.width = std::max(0.0F, box.upper.x);
  if (drawing_.height == 0) drawing_.height = std::max(0.0F, box.upper.y);
}

void SvgReader::push(Frame frame) {
  if (frames_.size() >= static_cast<std::size_t>(SvgDocument::kMostLevels)) {
    throw Error(Error::Resource,
                fmt::format("{}: elements in more than {} others", document_.file(), SvgDocument::kMostLevels));
  }
  frames_.push_back(std::move(frame));
}

void SvgReader::read_frames() {
  while (!frames_.empty()) {
    Frame& frame = top();
    const pugi::xml_node node = frame.next;
    if (!node) {
      leave();
      continue;
    }
    frame.next = frame.only ? pugi::xml_node() : node.next_sibling();
    if (node.type() == pugi::node_element) read_element(node);
  }
}

void SvgReader::leave() {
  const Frame frame = std::move(top());
  frames_.pop_back();
  if (frame.clip) clips_.clip(frame.clipped, frame.clip, frame.viewport, clips_.box_of(frame.clipped));
}

void SvgReader::read_element(const pugi::xml_node& node) {
  if (++seen_ % 1024 == 0) check_cancelled(run_);
  if (top().copied) budget_.add_copy(node);
  const SvgElement element = document_.element_of(node);
  // A clip has shapes, and those that a use names.
  if (is_shape(element)) return draw(element, entry_of(node));
  switch (element) {
    case SvgElement::Use: return enter_use(entry_of(node));
    case SvgElement::Group:
      if (!in_clip_) enter_group(entry_of(node));
      return;
    case SvgElement::Switch:
      if (!in_clip_) enter_switch(entry_of(node));
      return;
    case SvgElement::Symbol:
      if (!in_clip_ && top().used) enter_viewport(entry_of(node));
      return;
    case SvgElement::Svg:
      if (!in_clip_) enter_viewport(entry_of(node));
      return;
    case SvgElement::Animation: return notes_.left_out("animation");
    case SvgElement::LeftOut: return notes_.left_out(document_.name_of(node));
    case SvgElement::Unknown: return notes_.left_out(quoted_word(document_.name_of(node)));
    default: return;
  }
}

Entry SvgReader::entry_of(const pugi::xml_node& node) {
  Entry entry;
  entry.node = node;
  const SvgDeclarations declared = document_.declarations(node);
  entry.style = computed_style(top().style, declared, top().viewport, notes_);
  const std::optional<glm::dmat3x2> matrix = parse_transform(declared[SvgProperty::Transform]);
  if (!matrix) notes_.wrong("a transform can't be read");
  entry.matrix = matrix.value_or(kIdentity);
  return entry;
}

std::uint32_t SvgReader::add_group(const Entry& entry, std::uint32_t parent) {
  budget_.add_bytes(sizeof(DrawingGroup) + sizeof(DrawingItem));
  return drawing_.add_group(to_floats(entry.matrix), entry.style.opacity, parent);
}

/// What an element's clip-path asks for; one that is measured by the content's box waits for it.
void SvgReader::clip_group(std::uint32_t group, const Entry& entry, const SvgViewport& viewport, Frame& frame) {
  if (entry.style.clip_path.empty()) return;
  const pugi::xml_node clip = clips_.find(entry.style.clip_path);
  if (!clip) return;
  if (SvgClips::is_measured_by_box(clip)) {
    frame.clip = clip;
    frame.clipped = group;
  } else {
    clips_.clip(group, clip, viewport, {});
  }
}

void SvgReader::enter_group(const Entry& entry) {
  if (!entry.style.displayed) return;
  Frame frame;
  frame.element = entry.node;
  frame.next = entry.node.first_child();
  frame.viewport = top().viewport;
  frame.copied = top().copied;
  frame.group = add_group(entry, top().group);
  drawing_.groups[frame.group].id = entry.node.attribute("id").value();
  clip_group(frame.group, entry, frame.viewport, frame);
  frame.style = entry.style;
  push(std::move(frame));
}

/// Source: SVG 1.1, 5.8.2: the first child whose conditions are met.
void SvgReader::enter_switch(const Entry& entry) {
  const auto can_be_shown = [&](const pugi::xml_node& child) {
    const SvgElement element = document_.element_of(child);
    if (element == SvgElement::Unknown || element == SvgElement::Silent) return false;
    if (document_.name_of(child) == "foreignObject" || child.attribute("requiredExtensions")) return false;
    const pugi::xml_attribute languages = child.attribute("systemLanguage");
    return !languages || std::string_view(languages.value()).find("en") != std::string_view::npos;
  };
  const std::size_t frames = frames_.size();
  enter_group(entry);
  if (frames_.size() == frames) return;
  Frame& frame = top();
  while (frame.next && !can_be_shown(frame.next)) frame.next = frame.next.next_sibling();
  frame.only = true;
}

void SvgReader::enter_use(const Entry& entry) {
  if (!entry.style.displayed) return;
  const std::string_view id = svg_reference(entry.node);
  const pugi::xml_node target = id.empty() ? pugi::xml_node() : document_.find(id);
  if (!target) return notes_.wrong("a use names what isn't there");
  const auto is_target = [&](const Frame& frame) { return frame.element == target; };
  if (target == entry.node || std::any_of(frames_.begin(), frames_.end(), is_target)) {
    return notes_.wrong("a use shows itself");
  }
  const Frame& parent = top();
  const SvgLengths lengths(entry.node, parent.viewport, entry.style.font_size);
  Entry moved = entry;
  moved.matrix = combined(entry.matrix, {1, 0, 0, 1, lengths.along_x("x"), lengths.along_y("y")});
  Frame frame;
  frame.element = entry.node;
  frame.next = target;
  frame.only = frame.used = frame.copied = true;
  frame.viewport = parent.viewport;
  if (entry.node.attribute("width")) frame.width = lengths.along_x("width");
  if (entry.node.attribute("height")) frame.height = lengths.along_y("height");
  frame.group = add_group(moved, parent.group);
  drawing_.groups[frame.group].id = entry.node.attribute("id").value();
  clip_group(frame.group, entry, frame.viewport, frame);
  frame.style = entry.style;
  push(std::move(frame));
}

/// A nested svg, or a symbol.
void SvgReader::enter_viewport(const Entry& entry) {
  if (!entry.style.displayed) return;
  const Frame& parent = top();
  const SvgLengths lengths(entry.node, parent.viewport, entry.style.font_size);
  const double width = parent.width.value_or(lengths.along_x("width", parent.viewport.width));
  const double height = parent.height.value_or(lengths.along_y("height", parent.viewport.height));
  if (!(width > 0) || !(height > 0)) return;
  const bool is_symbol = document_.element_of(entry.node) == SvgElement::Symbol;
  const double x = is_symbol ? 0 : lengths.along_x("x");
  const double y = is_symbol ? 0 : lengths.along_y("y");
  Frame frame;
  frame.element = entry.node;
  frame.next = entry.node.first_child();
  frame.copied = parent.copied;
  frame.viewport = {width, height};
  glm::dmat3x2 inner = kIdentity;
  if (const auto box = parse_view_box(entry.node.attribute("viewBox").value())) {
    inner = viewport_from_view_box(*box, width, height, entry.node.attribute("preserveAspectRatio").value());
    frame.viewport = {box->width, box->height};
  }
  Entry outer = entry;
  outer.matrix = combined(entry.matrix, {1, 0, 0, 1, x, y});
  frame.group = add_group(outer, parent.group);
  drawing_.groups[frame.group].id = entry.node.attribute("id").value();
  clip_group(frame.group, entry, parent.viewport, frame);
  if (!entry.style.overflow) {
    if (drawing_.groups[frame.group].clip || frame.clip) frame.group = add_group(Entry(), frame.group);
    Path edge;
    const auto w = to_float(width);
    const auto h = to_float(height);
    edge.move_to({0, 0}).line_to({w, 0}).line_to({w, h}).line_to({0, h}).close();
    clips_.clip_to(frame.group, edge, styles_.index_of(DrawingStyle()));
  }
  if (inner != kIdentity) {
    Entry content;
    content.matrix = inner;
    frame.group = add_group(content, frame.group);
  }
  frame.style = entry.style;
  push(std::move(frame));
}

/// The group that a shape needs for itself, or the one around it.
std::uint32_t SvgReader::wrapped(const Entry& entry, const Box2& box, bool faded) {
  const pugi::xml_node clip = entry.style.clip_path.empty() ? pugi::xml_node() : clips_.find(entry.style.clip_path);
  if (entry.matrix == kIdentity && !clip && !faded) return top().group;
  Entry group = entry;
  if (!faded) group.style.opacity = 1;
  const std::uint32_t index = add_group(group, top().group);
  if (clip) clips_.clip(index, clip, top().viewport, box);
  return index;
}

void SvgReader::draw(SvgElement element, const Entry& entry) {
  if (!entry.style.displayed || !entry.style.visible) return;
  path_.commands.clear();
  path_.points.clear();
  if (!add_svg_shape(element, entry.node, SvgLengths(entry.node, top().viewport, entry.style.font_size), path_)) {
    notes_.wrong("an error in path data or points; what stands before it is shown");
  }
  if (path_.commands.empty()) return;
  const PathView view{path_.commands, path_.points};
  budget_.add_bytes(sizeof(DrawingPath) + sizeof(DrawingItem) + path_.commands.size() +
                    path_.points.size() * sizeof(glm::vec2));
  DrawingStyle style;
  if (in_clip_) {
    style.fill_rule = entry.style.clip_rule;
  } else {
    style = styles_.style_of(entry.style, view, top().viewport);
  }
  const bool faded = !in_clip_ && entry.style.opacity < 1 && style.fill && style.stroke;
  if (!in_clip_ && !faded) style.opacity = entry.style.opacity;
  const Box2 box = entry.style.clip_path.empty() ? Box2() : bounds(view);
  const std::uint32_t group = wrapped(entry, box, faded);
  drawing_.add_path(path_, styles_.index_of(style), entry.node.attribute("id").value(), group);
}

}  // namespace

Drawing read_svg(const Input& input, const Run& run) {
  SvgNotes notes;
  const SvgDocument document(input, run, notes);
  Drawing drawing = SvgReader(document, notes, run).read();
  notes.tell(document.file(), run);
  return drawing;
}

}  // namespace azulejo
