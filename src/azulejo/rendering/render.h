#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/frame.h"
#include "azulejo/data/scene.h"
#include "azulejo/engine/field.h"
#include "azulejo/math/color.h"
#include "azulejo/rendering/camera_choice.h"
#include "azulejo/rendering/lighting.h"
#include "azulejo/rendering/zbuffer.h"

namespace azulejo {

enum class RendererKind : std::uint8_t { ZBuffer };
constexpr std::array<std::string_view, 1> enum_names(RendererKind) { return {"zbuffer"}; }

enum class FrameLayer : std::uint8_t { Color, Depth, Normal, Position, Uv, Albedo, Object, Material, Face };
constexpr std::array<std::string_view, 9> enum_names(FrameLayer) {
  return {"color", "depth", "normal", "position", "uv", "albedo", "object_id", "material_id", "face_id"};
}

struct RenderOptions {
  RendererKind renderer = RendererKind::ZBuffer;
  int width = 1024;
  int height = 768;
  CameraOptions camera = {};
  LightingOptions lighting = {};
  Color background = {0, 0, 0, 0};  ///< behind everything; transparent by default
  Shading shading = Shading::Phong;
  PolygonMode polygon_mode = PolygonMode::Filled;
  int antialias = 4;                       ///< samples a pixel: 1, 4, 8 or 16
  float exposure = 0;                      ///< stops, added to the lights' own exposure; of display output
  std::optional<FrameOutput> output = {};  ///< of the color; auto: display8
  std::vector<FrameLayer> layers = {FrameLayer::Color};
  std::string animation = {};        ///< name or number from 0; empty: the first
  std::optional<float> time_s = {};  ///< the scene as it is then; auto: as the file has it at rest
  float crease_angle_deg = 40;       ///< without normals, edges sharper than this stay sharp
  float line_width = 1.5F;           ///< pixels
  float point_size = 3;              ///< pixels
};

/// What happened on the way to a picture. The times are no part of reports: those are the same each time.
struct RenderStatistics {
  ZBufferStatistics faces;
  LightChoice lights = LightChoice::Default;
  float exposure = 1;     ///< factor
  std::string camera;     ///< name of the file's; empty: placed or framed
  double prepare_ms = 0;  ///< pose, triangles, normals, mipmaps
  double draw_ms = 0;
};

/// A scene made ready for many pictures that differ in the camera only. The scene must outlive it.
class AZULEJO_EXPORT SceneRenderer {
 public:
  /// Animates and poses the scene, where that is asked for or needed, and prepares it.
  /// Throws as `render`.
  SceneRenderer(const Scene& scene, const RenderOptions& options, const Run& run = {});

  /// The scene as it is drawn.
  const Scene& scene() const { return posed_ ? *posed_ : scene_; }
  Frame draw(const CameraOptions& camera, const Run& run = {}, RenderStatistics* statistics = nullptr) const;
  /// The same over an image of the options' size, in the viewport only, background and all: see picture_onto.
  Frame draw_onto(const Image& under, const CameraOptions& camera, const Run& run = {},
                  RenderStatistics* statistics = nullptr) const;

 private:
  Frame draw(const CameraOptions& camera, const Image* under, const Run& run, RenderStatistics* statistics) const;

  const Scene& scene_;
  std::optional<Scene> posed_;
  RenderOptions options_;
  double prepare_ms_ = 0;
  std::optional<ZBufferRenderer> renderer_;
};

/// A picture of a scene.
///
/// scene    any; an empty one gives the background
/// camera   see CameraOptions: named, placed, the file's first, or framed
/// lights   see choose_lighting: the file's, else three that move with the camera
/// motion   with `time_s` or `animation` the nodes stand as the animation has them then; skins and morphs are applied
/// Result   the layers asked for, in their order, color first; `Frame::camera` has the camera as JSON
/// Throws   Error(Argument) for options out of range, unknown cameras and animations, sizes outside 1–65536;
///          Error(Resource) for pictures and scenes that pass run.limits
/// Stages   "world", "view", "ndc", "viewport": the scene as a mesh in each; "matrices"
/// Cost     see ZBufferRenderer
AZULEJO_EXPORT Frame render(const Scene& scene, const RenderOptions& options = {}, const Run& run = {},
                            RenderStatistics* statistics = nullptr);

/// The options for a picture over another one: its size, and linear output over linear colors.
/// Throws  Error(Argument), beginning with `onto`, where `layers` are without color
AZULEJO_EXPORT RenderOptions options_onto(const Image& under, const RenderOptions& options);

/// The scene as an animation has it, its skins and morphs applied; nothing where it is that already.
AZULEJO_EXPORT std::optional<Scene> posed_scene(const Scene& scene, const std::string& animation,
                                                std::optional<float> time_s, const Run& run = {});

/// Seconds from 0 to the last key of an animation; 0: it has none. Throws Error(Argument) for one that isn't there.
AZULEJO_EXPORT float animation_duration(const Scene& scene, const std::string& animation);

}  // namespace azulejo
