#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace azulejo {

/// Vertices of one mesh at one place, as the vertex function gets them. The spans are of one length; those of attributes
/// that the mesh has not, or has by corner, are empty.
struct VertexBatch {
  std::span<const glm::vec3> positions;  ///< in the mesh's own space
  std::span<const glm::vec4> normals;    ///< xyz
  std::span<const glm::vec2> texcoords;
  std::span<const glm::vec4> colors;  ///< linear
  std::size_t first_vertex = 0;       ///< number of the first in the mesh
  std::uint32_t object = 0;           ///< number of the node
  glm::mat4 world_from_object{1.0F};
  glm::mat4 clip_from_world{1.0F};
  std::span<glm::vec4> clip;  ///< result; comes filled with clip_from_world · world_from_object · position
  std::span<float>
      varyings;  ///< result: Program::varyings values of the first vertex, of the second, …; zeros at first
};

/// Fragments of one material of one mesh at one place, as the fragment function gets them: columns of `count` values.
struct FragmentView {
  std::size_t count = 0;
  const float* x = nullptr;           ///< of the pixel's centre
  const float* y = nullptr;           ///< pixels, down
  const float* position[3] = {};      ///< in the world
  const float* normal[3] = {};        ///< in the world, unit length, toward the side that is seen
  const float* texcoord[2] = {};      ///< TEXCOORD_0; zeros where there is none
  const float* const* varyings = {};  ///< one column each, perspective-correct
  const std::uint32_t* face = nullptr;
  std::uint32_t object = 0;    ///< number of the node
  std::uint32_t material = 0;  ///< of the scene; beyond its last: none
  float* color[4] = {};        ///< result: linear light, straight opacity; comes filled with the material's base colour
};

/// A programmable pipeline: user code in place of the vertex stage, of the fragment stage, or of both. Called from
/// several threads at once, on batches: what it computes must depend on nothing but what it gets.
struct Program {
  int varyings = 0;  ///< values that the vertex function hands to the fragment function, 0–16
  std::function<void(const VertexBatch&)> vertex;
  std::function<void(const FragmentView&)> fragment;

  explicit operator bool() const { return vertex != nullptr || fragment != nullptr; }
};

}  // namespace azulejo
