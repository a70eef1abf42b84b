#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/frame.h"
#include "azulejo/data/scene.h"
#include "azulejo/rendering/polygon_mode.h"
#include "azulejo/rendering/program.h"
#include "azulejo/rendering/shading_light.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

enum class Shading : std::uint8_t { Flat, Gouraud, Phong };
constexpr std::array<std::string_view, 3> enum_names(Shading) { return {"flat", "gouraud", "phong"}; }

enum class FrameOutput : std::uint8_t {
  Display8,   ///< sRGB, u8
  Display16,  ///< sRGB, u16
  Linear,     ///< f32, linear, premultiplied
};
constexpr std::array<std::string_view, 3> enum_names(FrameOutput) { return {"display8", "display16", "linear"}; }

struct ZBufferOptions {
  Shading shading = Shading::Phong;
  int antialias = 4;                               ///< samples a pixel: 1, 4, 8 or 16
  std::array<float, 4> background = {0, 0, 0, 0};  ///< linear, straight alpha
  float exposure = 1;                              ///< factor of the light in display output
  FrameOutput output = FrameOutput::Display8;
  std::vector<std::string> layers = {"color"};  ///< see Frame
  float crease_angle = 0.6981317F;  ///< radians; where a mesh has no normals, faces that meet at more are not smoothed
  Program program = {};             ///< user code in the pipeline
  PolygonMode polygon_mode = PolygonMode::Filled;
  float line_width = 1.5F;  ///< pixels
  float point_size = 3;     ///< pixels
};

/// What happened to the faces of a picture. Each of `faces_in` is counted in one of outside, culled, empty and drawn;
/// those that are clipped are counted apart as well.
struct ZBufferStatistics {
  std::uint64_t faces_in = 0;          ///< triangles, lines and points, over all instances
  std::uint64_t faces_outside = 0;     ///< outside the view volume
  std::uint64_t faces_culled = 0;      ///< seen from behind, single-sided
  std::uint64_t faces_empty = 0;       ///< no area, not finite, or between all samples
  std::uint64_t faces_clipped = 0;     ///< cut by a plane of the view volume
  std::uint64_t faces_drawn = 0;       ///< rasterized
  std::uint64_t fragments_tested = 0;  ///< samples compared with the depth buffer
  std::uint64_t fragments_passed = 0;
  std::uint64_t fragments_shaded = 0;
};

/// Draws a scene with a z-buffer, from any number of sides.
///
/// geometry     positions are rounded to 1/256 pixel; a sample is covered by the top-left rule, so an edge that two
///              triangles share is drawn once and never leaves a gap. Clipped in homogeneous space
/// depth        reversed f32; of two surfaces at the same depth the earlier in the scene is seen
/// shading      once for every triangle that is seen in a pixel, at its centre (or the nearest point of the triangle)
/// order        the same picture for any number of threads, and for any order of triangles none of which are at the same
///              depth in a sample
/// transparent  materials that blend are sorted per sample, exactly, in front of what is opaque
/// data layers  hold what most samples of a pixel see of the opaque surfaces
/// normals      the mesh's, or angle-weighted ones broken at creases where it has none
/// lines        and points are squares and strips of a width in pixels, unlit where they have no normals
/// polygon mode edges: of every face, each once, as lines; vertices: as points. Lit and hidden as faces are, with their
///              materials and normals; neither culled nor hidden by faces, which are not there
/// memory       16 bytes a vertex and about 5 a triangle beside the scene and the picture
class AZULEJO_EXPORT ZBufferRenderer {
 public:
  /// Triangulates, makes normals where there are none, and mipmaps. The scene's meshes and images are shared; the
  /// options can't be changed later. Throws Error(Resource) for more than 2^31 triangles over all instances.
  ZBufferRenderer(const Scene& scene, const ZBufferOptions& options = {}, const Run& run = {});

  /// Throws Error(Argument) for sizes outside 1–65536, unknown layers, numbers of samples that there are not;
  /// Error(Resource) past run.limits.
  Frame draw(const View& view, const Lighting& lighting, const Run& run = {},
             ZBufferStatistics* statistics = nullptr) const;
  /// Into the layers of a frame that `draw` gave for a view of the same size. The data layers must be reset by the caller.
  void draw_into(Frame& frame, const View& view, const Lighting& lighting, const Run& run = {},
                 ZBufferStatistics* statistics = nullptr) const;

 private:
  struct Prepared;
  ZBufferOptions options_;
  std::shared_ptr<Prepared> prepared_;
};

}  // namespace azulejo
