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
  if (objects.size() > 1 && objects.back().vertices.size() == 0 && !objects.back().has_elements()) objects.pop_back();
  return objects;
}

}  // namespace

std::vector<ObjObject> obj_objects(const ObjData& data) {
  std::vector<ObjObject> objects = all_objects(data);
  const auto bare = [](const ObjObject& each) { return !each.has_elements(); };
  if (std::all_of(objects.begin(), objects.end(), bare)) return objects;
  objects.erase(std::remove_if(objects.begin(), objects.end(), bare), objects.end());
  return objects;
}

}  // namespace azulejo
