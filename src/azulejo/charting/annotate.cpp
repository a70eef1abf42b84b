#include "azulejo/charting/annotate.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/charting/annotation.h"
#include "azulejo/core/error.h"
#include "azulejo/rendering/camera_choice.h"

namespace azulejo {
namespace {

Box2 united(const Box2& a, const Box2& b) {
  return {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y)},
          {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y)}};
}

AnnotationPlace in_middle(const Box2& box, bool painted) { return {0.5F * box.lower + 0.5F * box.upper, box, painted}; }

/// The groups of a drawing, parents before children, and where all that they show is.
class DrawingParts {
 public:
  explicit DrawingParts(const Drawing& drawing) : boxes_(drawing.groups.size()), parent_(drawing.groups.size(), 0) {
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
      const std::uint32_t group = waiting.back();
      waiting.pop_back();
      order_.push_back(group);
      for (const DrawingItem& item : drawing.groups[group].items) {
        if (!item.is_group) continue;
        parent_[item.index] = group;
        waiting.push_back(item.index);
      }
    }
    for (const PlacedPath& placed : walk(drawing)) {
      const DrawingPath& path = drawing.paths[placed.path];
      const Box2 box = bounds(drawing.view(path), placed.page_from_path);
      if (!path.id.empty()) add(path.id, {placed.path, false}, box);
      boxes_[placed.group] = united(boxes_[placed.group], box);
    }
    for (std::size_t i = order_.size(); i-- > 0;) {
      const std::uint32_t group = order_[i];
      if (group != 0) boxes_[parent_[group]] = united(boxes_[parent_[group]], boxes_[group]);
      const std::string& id = drawing.groups[group].id;
      if (!id.empty()) add(id, {group, true}, boxes_[group]);
    }
  }

  struct Part {
    std::uint32_t index;
    bool is_group;
  };
  struct Named {
    std::vector<Part> parts;
    Box2 box;
  };
  const Named* find(const std::string& id) const {
    const auto found = named_.find(id);
    return found != named_.end() ? &found->second : nullptr;
  }
  const std::vector<std::uint32_t>& order() const { return order_; }
  std::uint32_t parent(std::uint32_t group) const { return parent_[group]; }

 private:
  void add(const std::string& id, Part part, const Box2& box) {
    Named& named = named_[id];
    named.parts.push_back(part);
    named.box = united(named.box, box);
  }

  std::vector<Box2> boxes_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> order_;
  std::unordered_map<std::string, Named> named_;
};

/// Gives paths and all that is in groups the colors of their values.
void paint(Drawing& drawing, const DrawingParts& parts, const std::vector<Annotation>& annotations) {
  std::vector<std::optional<glm::vec4>> group_color(drawing.groups.size());
  std::vector<std::optional<glm::vec4>> path_color(drawing.paths.size());
  for (const Annotation& each : annotations) {
    if (!each.color || !each.place.painted) continue;
    for (const DrawingParts::Part& part : parts.find(each.id)->parts) {
      (part.is_group ? group_color : path_color)[part.index] = each.color;
    }
  }
  for (const std::uint32_t group : parts.order()) {
    if (!group_color[group]) group_color[group] = group_color[parts.parent(group)];
    for (const DrawingItem& item : drawing.groups[group].items) {
      if (item.is_group) continue;
      DrawingPath& path = drawing.paths[item.index];
      const std::optional<glm::vec4> color = path_color[item.index] ? path_color[item.index] : group_color[group];
      if (!color) continue;
      DrawingStyle style = drawing.styles[path.style];
      if (style.fill) {
        style.fill = Paint(*color);
      } else {
        if (style.stroke) style.stroke = Paint(*color);
        if (style.points) style.points = Paint(*color);
      }
      path.style = drawing.add_style(style);
    }
  }
}

/// The pixels of regions that are asked for.
class Regions {
 public:
  Regions(const Image& regions, const AnnotationTable& table) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (const std::optional<std::uint32_t> id = number(table.id(row))) regions_.try_emplace(*id);
    }
    for_pixels(regions, [](Region& region, int x, int y) {
      ++region.pixels;
      region.sum += glm::dvec2(x + 0.5, y + 0.5);
      const glm::vec2 corner(static_cast<float>(x), static_cast<float>(y));
      region.box = united(region.box, {corner, corner + 1.0F});
    });
    for (auto& [id, region] : regions_) {
      if (region.pixels > 0) region.sum /= static_cast<double>(region.pixels);
    }
    for_pixels(regions, [](Region& region, int x, int y) {
      const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - region.sum;
      const double distance = d.x * d.x + d.y * d.y;
      if (!(distance < region.nearest)) return;
      region.nearest = distance;
      region.point = glm::vec2(glm::dvec2(x + 0.5, y + 0.5));
    });
  }

  std::optional<AnnotationPlace> find(const std::string& id) const {
    const std::optional<std::uint32_t> wanted = number(id);
    const auto found = wanted ? regions_.find(*wanted) : regions_.end();
    if (found == regions_.end() || found->second.pixels == 0) return std::nullopt;
    return AnnotationPlace{found->second.point, found->second.box, false};
  }

 private:
  struct Region {
    std::size_t pixels = 0;
    glm::dvec2 sum{0, 0};  ///< then their mean
    Box2 box;
    double nearest = std::numeric_limits<double>::infinity();
    glm::vec2 point{0, 0};
  };

  static std::optional<std::uint32_t> number(const std::string& id) {
    std::uint32_t value = 0;
    const auto [end, failure] = std::from_chars(id.data(), id.data() + id.size(), value);
    const bool whole = failure == std::errc() && end == id.data() + id.size() && value > 0;
    return whole ? std::optional(value) : std::nullopt;
  }

  template <class F>
  void for_pixels(const Image& image, F f) {
    visit(image.any(), [&](auto view) {
      using T = std::remove_cv_t<std::remove_pointer_t<decltype(view.data)>>;
      T last = 0;
      Region* region = nullptr;
      for (int y = 0; y < view.height; ++y) {
        const T* const row = view.row(y);
        for (int x = 0; x < view.width; ++x) {
          if (row[x * view.channels] != last) {
            last = row[x * view.channels];
            const auto value = static_cast<double>(last);
            const bool is_id = value > 0 && value < 4294967296.0 && std::floor(value) == value;
            const auto found = is_id ? regions_.find(static_cast<std::uint32_t>(value)) : regions_.end();
            region = found != regions_.end() ? &found->second : nullptr;
          }
          if (region != nullptr) f(*region, x, y);
        }
      }
    });
  }

  std::unordered_map<std::uint32_t, Region> regions_;
};

/// Where nodes are in the world: boxes of what they and those below them show.
class NodeBoxes {
 public:
  explicit NodeBoxes(const Scene& scene) : scene_(scene), boxes_(scene.nodes.size()) {
    const std::vector<PlacedNode> placed = walk(scene);
    for (std::size_t i = placed.size(); i-- > 0;) {
      const PlacedNode& each = placed[i];
      const Node& node = scene.nodes[each.node.index];
      Box3& box = boxes_[each.node.index];
      if (node.mesh && each.visible) box = united(box, moved(mesh_box(node.mesh), each.world_from_node));
      for (const NodeId child : node.children) box = united(box, boxes_[child.index]);
    }
    for (std::size_t n = scene.nodes.size(); n-- > 0;) {
      const Node& node = scene.nodes[n];
      if (node.mesh && !scene.meshes[node.mesh.index]->name.empty()) {
        by_name_[scene.meshes[node.mesh.index]->name] = n;
      }
    }
    for (std::size_t n = scene.nodes.size(); n-- > 0;) {
      if (!scene.nodes[n].name.empty()) by_name_[scene.nodes[n].name] = n;
    }
  }

  /// By name, the first of that, else by number; empty: none.
  Box3 find(const std::string& id) const {
    const auto named = by_name_.find(id);
    if (named != by_name_.end()) return boxes_[named->second];
    std::size_t number = 0;
    const auto [end, failure] = std::from_chars(id.data(), id.data() + id.size(), number);
    const bool is_number = failure == std::errc() && end == id.data() + id.size();
    return is_number && number < boxes_.size() ? boxes_[number] : Box3{};
  }

 private:
  const Box3& mesh_box(MeshId mesh) {
    const auto [known, added] = meshes_.try_emplace(mesh.index);
    if (added) known->second = bounds(*scene_.meshes[mesh.index]);
    return known->second;
  }

  static Box3 moved(const Box3& box, const glm::mat4& matrix) {
    Box3 result;
    if (box.empty()) return result;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const glm::vec3 at((corner & 1U) != 0 ? box.upper.x : box.lower.x, (corner & 2U) != 0 ? box.upper.y : box.lower.y,
                         (corner & 4U) != 0 ? box.upper.z : box.lower.z);
      result = united(result, glm::vec3(matrix * glm::vec4(at, 1)));
    }
    return result;
  }

  const Scene& scene_;
  std::vector<Box3> boxes_;
  std::unordered_map<std::string, std::size_t> by_name_;
  std::unordered_map<std::uint32_t, Box3> meshes_;
};

/// Where a point of the world is in the viewport.
std::optional<AnnotationPlace> seen(const View& view, const glm::dvec3& point) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_world()) * glm::dvec4(point, 1.0);
  const bool inside = clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z <= clip.w;
  if (!inside) return std::nullopt;
  const Rect& viewport = view.viewport;
  return AnnotationPlace{glm::vec2(glm::dvec2(viewport.x + 0.5 * (1 + clip.x / clip.w) * viewport.width,
                                              viewport.y + 0.5 * (1 - clip.y / clip.w) * viewport.height)),
                         {},
                         false};
}

Drawing page_of(int width, int height) {
  Drawing page;
  page.width = static_cast<float>(width);
  page.height = static_cast<float>(height);
  return page;
}

}  // namespace

Drawing annotate(const Drawing& drawing, const CsvTable& data, const AnnotateOptions& options, const Run& run) {
  const AnnotationTable table(data, options);
  const DrawingParts parts(drawing);
  Drawing result = drawing.clone();
  const auto by_point = [&](std::size_t row) -> std::optional<AnnotationPlace> {
    return AnnotationPlace{glm::vec2(glm::dvec2(table.x(row), table.y(row))), {}, false};
  };
  const auto by_id = [&](const std::string& id) -> std::optional<AnnotationPlace> {
    const DrawingParts::Named* const named = parts.find(id);
    return named != nullptr && !named->box.empty() ? std::optional(in_middle(named->box, true)) : std::nullopt;
  };
  const std::vector<Annotation> annotations = table.placed(by_point, by_id, run);
  paint(result, parts, annotations);
  add_annotations(result, annotations, table, options, run);
  return result;
}

Drawing annotate(const Image& image, const Image* regions, const CsvTable& data, const AnnotateOptions& options,
                 const Run& run) {
  if (regions != nullptr && (regions->width() != image.width() || regions->height() != image.height())) {
    throw Error(Error::Argument, fmt::format("regions: {}×{} pixels, expected the image's {}×{}", regions->width(),
                                             regions->height(), image.width(), image.height()));
  }
  const AnnotationTable table(data, options);
  std::optional<Regions> known;
  if (regions != nullptr && table.has_ids()) known.emplace(*regions, table);
  const auto by_point = [&](std::size_t row) -> std::optional<AnnotationPlace> {
    return AnnotationPlace{glm::vec2(glm::dvec2(table.x(row), table.y(row))), {}, false};
  };
  const auto by_id = [&](const std::string& id) { return known ? known->find(id) : std::nullopt; };
  Drawing page = page_of(image.width(), image.height());
  add_annotations(page, table.placed(by_point, by_id, run), table, options, run);
  return page;
}

Drawing annotate(const Scene& scene, const CameraOptions& camera, int width, int height, const CsvTable& data,
                 const AnnotateOptions& options, const Run& run) {
  const AnnotationTable table(data, options);
  const View view = choose_camera(scene, camera, width, height, run).view;
  const NodeBoxes nodes(scene);
  const auto by_point = [&](std::size_t row) { return seen(view, {table.x(row), table.y(row), table.z(row)}); };
  const auto by_id = [&](const std::string& id) -> std::optional<AnnotationPlace> {
    const Box3 box = nodes.find(id);
    return box.empty() ? std::nullopt : seen(view, glm::dvec3(box.center()));
  };
  Drawing page = page_of(width, height);
  add_annotations(page, table.placed(by_point, by_id, run), table, options, run);
  return page;
}

}  // namespace azulejo
