#include "azulejo/io/svg_write.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/svg_output.h"

namespace azulejo {
namespace {

constexpr std::size_t kStepsAtOnce = 8192;
constexpr std::size_t kStepsATask = 128;
constexpr std::size_t kLargeText = std::size_t{1} << 18;
const glm::mat3x2 kIdentity(1, 0, 0, 1, 0, 0);

/// A tag to be written: of a path, or where a group begins or ends.
struct Step {
  enum Kind : std::uint8_t { Begin, End, Empty, Shape };
  Kind kind = Shape;
  std::uint32_t index = 0;  ///< of the group or path
  std::uint32_t level = 0;
  std::optional<std::uint32_t> wrap;  ///< of a path: the group that becomes its attributes
  std::string id;
  glm::mat3x2 page_from_parent{1, 0, 0, 1, 0, 0};
};

/// A group in whose items the writer is.
struct Place {
  std::uint32_t group = 0;
  std::size_t next = 0;  ///< item
  bool tagged = false;   ///< it ends with a tag
  glm::mat3x2 page_from_group{1, 0, 0, 1, 0, 0};
};

using ClipIds = std::map<std::uint32_t, std::string>;  ///< of groups that are clips

ClipIds named_clips(const Drawing& drawing, SvgIds& ids) {
  ClipIds clips;
  for (const DrawingGroup& group : drawing.groups) {
    if (group.clip) clips[*group.clip];
  }
  for (auto& [group, id] : clips) {
    const std::string& wanted = drawing.groups[group].id;
    id = ids.unique(wanted.empty() ? "clip" : wanted);
  }
  return clips;
}

class SvgWriter {
 public:
  SvgWriter(Output& output, const Drawing& drawing, const ModelWriteOptions& options, const Run& run)
      : output_(output),
        drawing_(drawing),
        options_(options),
        run_(run),
        clips_(named_clips(drawing, ids_)),
        definitions_(drawing, ids_) {}

  void write();

 private:
  std::string head();
  void put_clips(std::string& text);
  void put_clip(std::string& text, std::uint32_t clip);
  void put_clip_path(std::string& text, std::uint32_t path, const glm::mat3x2& placed, const glm::mat3x2& baked,
                     std::optional<std::uint32_t> clip);
  void begin_group(std::uint32_t group, const glm::mat3x2& page_from_parent);
  void add(Step step);
  bool is_wrap(const DrawingGroup& group) const;
  void flush();
  void put_step(std::string& text, const Step& step) const;
  void put_group(std::string& text, const Step& step) const;
  void put_path(std::string& text, const Step& step) const;
  void put_text(std::string& text, const Step& step, const DrawingText& label) const;
  void put_placed(std::string& text, const DrawingGroup& group) const;
  void write_out(std::string& text);

  Output& output_;
  const Drawing& drawing_;
  const ModelWriteOptions& options_;
  const Run& run_;
  SvgIds ids_;
  ClipIds clips_;
  SvgDefinitions definitions_;
  std::vector<Place> places_;
  std::vector<Step> steps_;
  std::vector<std::string> texts_;
};

std::string unique_if_any(SvgIds& ids, const std::string& id) { return id.empty() ? id : ids.unique(id); }

void put_indent(std::string& text, std::uint32_t level) {
  constexpr std::uint32_t kMost = 16;  // else deep files would be of blanks
  text.append(std::min(level, kMost), ' ');
}

void put_id(std::string& text, const std::string& id) {
  if (!id.empty()) put_attribute(text, "id", id);
}

std::string SvgWriter::head() {
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"";
  put_id(text, unique_if_any(ids_, drawing_.groups[0].id));
  const float width = drawing_.width;
  const float height = drawing_.height;
  if (width > 0 && height > 0) {
    const auto put_size = [&](const char* name, float value) {
      std::string size;
      put_number(size, value);
      put_attribute(text, name, size + (drawing_.unit == DrawingUnit::Millimetre ? "mm" : ""));
    };
    put_size("width", width);
    put_size("height", height);
    text += " viewBox=\"0 0 ";
    put_number(text, width);
    put_number(text += ' ', height);
    text += '"';
  }
  return text += ">\n";
}

void SvgWriter::write_out(std::string& text) {
  output_.write(std::as_bytes(std::span(text)));
  text.clear();
}

/// Transformation, opacity and clip.
void SvgWriter::put_placed(std::string& text, const DrawingGroup& group) const {
  put_transform(text, "transform", group.parent_from_group);
  if (group.opacity != 1) put_attribute(text, "opacity", group.opacity);
  if (group.clip) put_attribute(text, "clip-path", "url(#" + clips_.at(*group.clip) + ")");
}

void SvgWriter::put_clips(std::string& text) {
  if (clips_.empty()) return;
  text += "<defs>\n";
  for (const auto& each : clips_) {
    put_clip(text, each.first);
    if (text.size() > kLargeText) write_out(text);
  }
  text += "</defs>\n";
}

/// SVG has no groups in clips: what they do goes to their paths.
void SvgWriter::put_clip(std::string& text, std::uint32_t clip) {
  struct Waiting {
    DrawingItem item;
    glm::mat3x2 placed;                 ///< by the attribute, up to the group with a clip
    glm::mat3x2 baked;                  ///< into the points, below it
    std::optional<std::uint32_t> clip;  ///< where `placed` leads
  };
  const DrawingGroup& whole = drawing_.groups[clip];
  text += "<clipPath";
  put_attribute(text, "id", clips_.at(clip));
  put_transform(text, "transform", whole.parent_from_group);
  if (whole.clip) put_attribute(text, "clip-path", "url(#" + clips_.at(*whole.clip) + ")");
  text += ">\n";
  std::vector<Waiting> waiting;
  const auto enter = [&](const DrawingGroup& group, const Waiting& from) {
    for (std::size_t i = group.items.size(); i-- > 0;) {
      waiting.push_back({group.items[i], from.placed, from.baked, from.clip});
    }
  };
  enter(whole, {{}, kIdentity, kIdentity, std::nullopt});
  while (!waiting.empty()) {
    Waiting next = waiting.back();
    waiting.pop_back();
    if (!next.item.is_group) {
      put_clip_path(text, next.item.index, next.placed, next.baked, next.clip);
      continue;
    }
    const DrawingGroup& group = drawing_.groups[next.item.index];
    if (group.clip && next.clip) {
      throw Error(Error::Unsupported,
                  fmt::format("{}: SVG has no path in a clip that is cut by two further clips", output_.name()));
    }
    glm::mat3x2& matrix = next.clip ? next.baked : next.placed;
    matrix = combined(matrix, group.parent_from_group);
    if (group.clip) next.clip = group.clip;
    enter(group, next);
  }
  text += "</clipPath>\n";
}

void SvgWriter::put_clip_path(std::string& text, std::uint32_t path, const glm::mat3x2& placed,
                              const glm::mat3x2& baked, std::optional<std::uint32_t> clip) {
  const DrawingPath& shape = drawing_.paths[path];
  text += " <path";
  put_id(text, unique_if_any(ids_, shape.id));
  text += " d=\"";
  put_path_data(text, drawing_.view(shape), baked);
  text += '"';
  if (drawing_.styles[shape.style].fill_rule == FillRule::EvenOdd) put_attribute(text, "clip-rule", "evenodd");
  put_transform(text, "transform", placed);
  if (clip) put_attribute(text, "clip-path", "url(#" + clips_.at(*clip) + ")");
  text += "/>\n";
}

/// True if a group is only there for what it does to its path, and the path's attributes can say that.
bool SvgWriter::is_wrap(const DrawingGroup& group) const {
  if (group.items.size() != 1 || group.items[0].is_group || !group.id.empty()) return false;
  const DrawingStyle& style = drawing_.styles[drawing_.paths[group.items[0].index].style];
  // Marks are a second path; and of a single paint the opacity is that of the style.
  if (style.points || (group.opacity != 1 && !(style.fill && style.stroke))) return false;
  return group.opacity != 1 || group.clip || group.parent_from_group != kIdentity;
}

void SvgWriter::add(Step step) {
  steps_.push_back(std::move(step));
  if (steps_.size() == kStepsAtOnce) flush();
}

void SvgWriter::begin_group(std::uint32_t group, const glm::mat3x2& page_from_parent) {
  const DrawingGroup& entered = drawing_.groups[group];
  const auto level = static_cast<std::uint32_t>(places_.size());
  const glm::mat3x2 page_from_group = combined(page_from_parent, entered.parent_from_group);
  if (is_wrap(entered)) {
    const std::uint32_t path = entered.items[0].index;
    return add({Step::Shape, path, level, group, unique_if_any(ids_, drawing_.paths[path].id), page_from_group});
  }
  const bool empty = entered.items.empty();
  const bool tagged = group != 0 || entered.parent_from_group != kIdentity || entered.opacity != 1 || entered.clip;
  if (tagged) {
    std::string id = group == 0 ? std::string() : unique_if_any(ids_, entered.id);
    add({empty ? Step::Empty : Step::Begin, group, level, std::nullopt, std::move(id), page_from_parent});
  }
  if (!empty) places_.push_back({group, 0, tagged, page_from_group});
}

void SvgWriter::write() {
  std::string text = head();
  definitions_.put(text);
  put_clips(text);
  write_out(text);
  begin_group(0, kIdentity);
  while (!places_.empty()) {
    Place& place = places_.back();
    const DrawingGroup& group = drawing_.groups[place.group];
    if (place.next == group.items.size()) {
      const bool tagged = place.tagged;
      const std::uint32_t index = place.group;
      places_.pop_back();
      if (tagged) add({Step::End, index, static_cast<std::uint32_t>(places_.size()), std::nullopt, {}, kIdentity});
      continue;
    }
    const DrawingItem item = group.items[place.next++];
    if (item.is_group) {
      begin_group(item.index, place.page_from_group);
    } else {
      std::string id = unique_if_any(ids_, drawing_.paths[item.index].id);
      add({Step::Shape, item.index, static_cast<std::uint32_t>(places_.size()), std::nullopt, std::move(id),
           place.page_from_group});
    }
  }
  flush();
  text = "</svg>\n";
  write_out(text);
}

/// Texts are made on all threads and written in order.
void SvgWriter::flush() {
  const std::size_t tasks = (steps_.size() + kStepsATask - 1) / kStepsATask;
  texts_.resize(std::max(texts_.size(), tasks));
  parallel_tasks(tasks, run_, [&](std::size_t task, int) {
    texts_[task].clear();
    const std::size_t begin = task * kStepsATask;
    for (std::size_t i = begin; i < std::min(begin + kStepsATask, steps_.size()); ++i) {
      put_step(texts_[task], steps_[i]);
    }
  });
  for (std::size_t task = 0; task < tasks; ++task) write_out(texts_[task]);
  steps_.clear();
}

void SvgWriter::put_step(std::string& text, const Step& step) const {
  put_indent(text, step.level);
  switch (step.kind) {
    case Step::Begin:
    case Step::Empty: return put_group(text, step);
    case Step::End: text += "</g>\n"; return;
    case Step::Shape: return put_path(text, step);
  }
}

void SvgWriter::put_group(std::string& text, const Step& step) const {
  text += "<g";
  put_id(text, step.id);
  put_placed(text, drawing_.groups[step.index]);
  text += step.kind == Step::Empty ? "/>\n" : ">\n";
}

void SvgWriter::put_path(std::string& text, const Step& step) const {
  const DrawingPath& path = drawing_.paths[step.index];
  const DrawingStyle& style = drawing_.styles[path.style];
  const DrawingText* const label = path.text ? &drawing_.texts[*path.text] : nullptr;
  const bool only_marks = style.points && !style.fill && !style.stroke;
  if (label != nullptr && options_.svg_text) {
    put_text(text, step, *label);
  } else if (!only_marks) {
    text += "<path";
    put_id(text, step.id);
    if (step.wrap) put_placed(text, drawing_.groups[*step.wrap]);
    definitions_.put_style(text, path.style, false);
    if (label != nullptr) {
      text += " aria-label=\"";
      put_escaped(text, label->text);
      text += '"';
    }
    text += " d=\"";
    put_path_data(text, drawing_.view(path));
    text += "\"/>\n";
  }
  if (!style.points) return;
  if (!only_marks) put_indent(text, step.level);
  text += "<path";
  if (only_marks) put_id(text, step.id);
  definitions_.put_style(text, path.style, true);
  text += " d=\"";
  const float pixel = drawing_.unit == DrawingUnit::Millimetre ? 25.4F / 96 : 1.0F;
  put_marks(text, drawing_.view(path), style.point_shape, style.point_size * pixel, step.page_from_parent);
  text += "\"/>\n";
}

void SvgWriter::put_text(std::string& text, const Step& step, const DrawingText& label) const {
  text += "<text";
  put_id(text, step.id);
  if (step.wrap) put_placed(text, drawing_.groups[*step.wrap]);
  put_attribute(text, "x", label.origin.x);
  put_attribute(text, "y", label.origin.y);
  if (!label.family.empty()) {
    text += " font-family=\"";
    put_escaped(text, label.family);
    text += '"';
  }
  put_attribute(text, "font-size", label.size);
  if (label.bold) put_attribute(text, "font-weight", "bold");
  definitions_.put_style(text, drawing_.paths[step.index].style, false);
  // Else blanks at the ends and several in a row would be lost.
  const bool blanks =
      label.text.starts_with(' ') || label.text.ends_with(' ') || label.text.find("  ") != std::string::npos;
  if (blanks) put_attribute(text, "xml:space", "preserve");
  text += '>';
  put_escaped(text, label.text);
  text += "</text>\n";
}

}  // namespace

void write_svg(Output& output, const Drawing& drawing, const ModelWriteOptions& options, const Run& run) {
  drawing.check(output.name());
  SvgWriter(output, drawing, options, run).write();
}

}  // namespace azulejo
