#include "azulejo/rendering/viewing_stages.h"

#include <limits>

#include <glm/mat4x4.hpp>

#include "azulejo/engine/stages.h"
#include "azulejo/math/viewport.h"
#include "azulejo/modelling/flatten.h"

namespace azulejo {
namespace {

template <class Matrix>
Json rows(const Matrix& matrix) {
  Json list = Json::array();
  for (int row = 0; row < Matrix::length(); ++row) {
    Json line = Json::array();
    for (int column = 0; column < Matrix::length(); ++column) {
      line.push(static_cast<double>(matrix[column][row]));
    }
    list.push(line);
  }
  return list;
}

template <class Move>
Mesh moved(const Mesh& mesh, Move move) {
  Mesh result = mesh.clone();
  for (glm::vec3& position : result.positions) position = glm::vec3(move(glm::dvec3(position)));
  return result;
}

}  // namespace

void report_viewing(const Scene& scene, const View& view, const std::string& step, const Run& run) {
  if (run.stages == nullptr) return;
  const StageReporter reporter(*run.stages, step);
  Mesh world = flatten(scene, run);
  world.material.clear();  // of a scene that isn't there
  world.attributes.clear();
  const glm::dmat4 view_from_world(view.view_from_world);
  const glm::dmat4 clip_from_world(view.clip_from_world());
  // The viewport counts its rows from the top; its formulas are in y up.
  const Window upright = flipped(window_of(view.viewport), view.height);
  const glm::dmat3 viewport = viewport_from_window({}, upright);
  const glm::dmat3 raster_from_ndc = raster_from_viewport(view.height) * viewport;
  const auto ndc = [&](const glm::dvec3& point) {
    const glm::dvec4 clip = clip_from_world * glm::dvec4(point, 1.0);
    return clip.w > 0 ? glm::dvec3(clip) / clip.w : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
  };
  reporter.mesh("world", world);
  reporter.mesh("view", moved(world, [&](const glm::dvec3& p) { return view_from_world * glm::dvec4(p, 1.0); }));
  reporter.mesh("ndc", moved(world, ndc));
  reporter.mesh("viewport", moved(world, [&](const glm::dvec3& point) {
                  const glm::dvec3 seen = ndc(point);
                  return glm::dvec3(transformed(raster_from_ndc, glm::dvec2(seen)), seen.z);
                }));
  Json json = Json::object();
  json.set("view_from_world", rows(view.view_from_world)).set("clip_from_view", rows(view.clip_from_view));
  json.set("viewport_scaling", rows(scaling_to_viewport({}, upright)));
  json.set("viewport_translation", rows(translation_to_viewport({}, upright)));
  json.set("viewport_from_ndc", rows(viewport)).set("raster_from_viewport", rows(raster_from_viewport(view.height)));
  reporter.report("matrices", json);
}

}  // namespace azulejo
