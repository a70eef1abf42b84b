#include "azulejo/io/obj_objects.h"

#include <algorithm>

namespace azulejo {
namespace {

/// All objects, also the one before the first statement `o`, and empty ones.
std::vector<ObjObject> all_objects(const ObjData& data) {
  std::vector<ObjObject> objects(1);
  const auto close = [&](std::size_t vertices, std::size_t faces, std::size_t line_ends, std::size_t points) {
    ObjObject& last = objects.back();
    last.vertices.end = vertices;
    last.faces.end = faces;
    last.line_ends.end = line_ends;
    last.points.end = points;
  };
  for (const ObjEvent& event : data.events) {
    if (event.kind != ObjEvent::Kind::Object) continue;
    close(event.vertices, event.faces, event.line_ends, event.points);
    ObjObject next;
    next.name = event.text;
    next.vertices.begin = event.vertices;
    next.faces.begin = event.faces;
    next.line_ends.begin = event.line_ends;
    next.points.begin = event.points;
    // One with nothing in it gives way to the next.
    const ObjObject& last = objects.back();
    if (last.vertices.size() == 0 && !last.has_elements()) objects.pop_back();
    objects.push_back(next);
  }
  close(data.positions.size(), data.faces, data.lines.size(), data.points.size());
  return objects;
}

}  // namespace

std::vector<bool> used_vertices(const ObjData& data) {
  std::vector<bool> used(data.positions.size(), false);
  for (const auto* indices : {&data.corners, &data.lines, &data.points}) {
    for (const std::uint32_t vertex : *indices) used[vertex] = true;
  }
  return used;
}

std::vector<ObjObject> obj_objects(const ObjData& data) {
  std::vector<ObjObject> objects = all_objects(data);
  if (objects.size() == 1) return objects;
  const auto may_be_cloud = [](const ObjObject& each) {
    return !each.has_elements() && !each.name.empty() && each.vertices.size() > 0;
  };
  std::vector<bool> used;
  if (std::any_of(objects.begin(), objects.end(), may_be_cloud)) used = used_vertices(data);
  std::vector<ObjObject> kept;
  for (const ObjObject& each : objects) {
    bool keep = each.has_elements();
    for (std::size_t v = each.vertices.begin; may_be_cloud(each) && !keep && v < each.vertices.end; ++v) {
      keep = !used[v];
    }
    if (keep) kept.push_back(each);
  }
  if (kept.empty()) kept.push_back(objects.front());
  return kept;
}

}  // namespace azulejo
