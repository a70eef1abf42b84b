#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace azulejo::bench {

/// What is drawn, in world space: triangles, counter-clockwise seen from outside.
struct LlvmpipeModel {
  std::span<const glm::vec3> positions;
  std::span<const glm::vec3> normals;      ///< one a position, of any length
  std::span<const std::uint32_t> corners;  ///< three a triangle
};

struct LlvmpipePicture {
  int width = 0;
  int height = 0;
  int samples = 1;     ///< a pixel: 1 or 4
  bool lines = false;  ///< the edges of the triangles, one pixel wide, those of faces seen from behind too
};

struct LlvmpipeLight {
  glm::vec3 toward{0, 0, 1};  ///< unit, from the surface to the light
  glm::vec3 color{1, 1, 1};
};

/// A pixel is ambient·diffuse + Σ light·(diffuse·(N·L) + specular·(R·V)^shininess), N interpolated and normalized.
struct LlvmpipeShading {
  glm::vec3 ambient{0.1F, 0.1F, 0.1F};
  glm::vec3 diffuse{0.8F, 0.8F, 0.8F};
  glm::vec3 specular{0.3F, 0.3F, 0.3F};
  float shininess = 32;
  std::vector<LlvmpipeLight> lights;  ///< at least one; their number is compiled into the shader
};

/// Mesa's llvmpipe, the peer of the renderers: OpenGL on the processor, vector code made by LLVM.
///
///   Llvmpipe peer(2);
///   peer.load({positions, normals, corners});
///   peer.resize({1920, 1080, 1});
///   peer.shade(shading);
///   peer.render(view.clip_from_world(), eye);  // timed: clears, draws, and waits until the picture is there
///   peer.read(rgba);                           // 4·width·height bytes, top row first
///
/// Fair to it: vertices interleaved and indices uploaded once, faces seen from behind culled, one draw call, 8-bit
/// colour without sRGB encoding, 32-bit float depth, no window system.
class Llvmpipe {
 public:
  /// `threads` rasterize; the vertices are always worked on by the calling thread, beside them. 0: that one does all.
  /// Sets LP_NUM_THREADS and LIBGL_ALWAYS_SOFTWARE in the environment. Two may live at once, so that one row of a table
  /// can have two numbers of threads. Throws Error(Unsupported) where there is no llvmpipe.
  explicit Llvmpipe(int threads);
  ~Llvmpipe();
  Llvmpipe(const Llvmpipe&) = delete;
  Llvmpipe& operator=(const Llvmpipe&) = delete;

  /// "Mesa 22.3.6 llvmpipe (LLVM 15.0.6, 256 bits)", as OpenGL names itself.
  const std::string& renderer() const;

  void load(const LlvmpipeModel& model);
  void resize(const LlvmpipePicture& picture);
  void shade(const LlvmpipeShading& shading);
  /// Draws on transparent black. `clip_from_world` is a View's: visible is −w ≤ x, y ≤ w and 0 ≤ z ≤ w, near at z = w
  /// (reversed depth), y up. Returns when all samples are resolved.
  void render(const glm::mat4& clip_from_world, const glm::vec3& eye);
  /// The picture as RGBA, 8 bits each, top row first.
  void read(std::span<std::byte> rgba);

 private:
  class Context;
  std::unique_ptr<Context> context_;
};

}  // namespace azulejo::bench
