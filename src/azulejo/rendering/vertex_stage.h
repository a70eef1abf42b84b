#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "azulejo/data/array.h"
#include "azulejo/math/rect.h"
#include "azulejo/rendering/screen.h"

namespace azulejo {

/// From clip space to pixels: x · scale + offset · w, divided by w.
struct ScreenTransform {
  float scale_x = 1;
  float offset_x = 0;
  float scale_y = -1;
  float offset_y = 0;
};
ScreenTransform screen_transform(const Rect& viewport);

/// Clip space of a position: additions and multiplications in the order in which the vector kernel does them, so that a
/// vertex is at the same place whether its triangle is clipped or not.
glm::vec4 to_clip(const glm::mat4& clip_from_object, const glm::vec3& position);
/// The vertex in the picture, x = NaN if it must be clipped.
ScreenVertex to_screen(const glm::vec4& clip, const ScreenTransform& transform);

struct RasterScene;
struct RasterInstance;
struct Program;

/// The vertices of all instances of a scene as a program makes them.
struct ProgramVertices {
  Array<glm::vec4> clip;  ///< empty: there is no vertex function
  Array<float> varyings;  ///< of each vertex, Program::varyings values
};

/// Calls the program's vertex function for the vertices [from, to) of an instance, counted in its mesh.
void run_vertex_program(const RasterScene& scene, const RasterInstance& instance, const Program& program,
                        const glm::mat4& clip_from_world, std::size_t from, std::size_t to, ProgramVertices& result);

namespace kernels {

/// `to_screen(to_clip(position))` of many vertices.
void transform_vertices(const glm::vec3* positions, std::size_t count, const glm::mat4& clip_from_object,
                        const ScreenTransform& transform, ScreenVertex* result);

}  // namespace kernels
}  // namespace azulejo
