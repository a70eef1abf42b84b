#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/quaternion_float.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/data/image.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// Names an element of one of a Scene's lists; false: none.
template <class T>
struct Id {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t index = kNone;

  Id() = default;
  explicit Id(std::size_t at) : index(static_cast<std::uint32_t>(at)) {}
  explicit operator bool() const { return index != kNone; }
  friend bool operator==(const Id&, const Id&) = default;
};

struct Node;
struct Texture;
struct Material;
struct LightSource;
struct Camera;
struct Skin;
using MeshId = Id<Mesh>;
using NodeId = Id<Node>;
using TextureId = Id<Texture>;
using MaterialId = Id<Material>;
using LightId = Id<LightSource>;
using CameraId = Id<Camera>;
using SkinId = Id<Skin>;

enum class TextureWrap : std::uint8_t { Repeat, Mirror, Clamp };
enum class TextureFilter : std::uint8_t { Nearest, Linear };
enum class MipFilter : std::uint8_t { None, Nearest, Linear };

/// An image with how it is looked up. Several textures may share one image.
struct Texture {
  std::string name;
  std::shared_ptr<const Image>
      image;           ///< u8, 1–4 channels, as the file stores it; null: it was missing (and warned of)
  std::string source;  ///< the file's name as the model gives it; empty: embedded
  TextureWrap wrap_u = TextureWrap::Repeat;
  TextureWrap wrap_v = TextureWrap::Repeat;
  TextureFilter magnification = TextureFilter::Linear;
  TextureFilter minification = TextureFilter::Linear;
  MipFilter mipmaps = MipFilter::Linear;
};

/// A texture as a material uses it: uv' = offset + R(rotation) · scale · uv (KHR_texture_transform).
struct TextureUse {
  TextureId texture;
  int texcoord = 0;  ///< TEXCOORD_n
  glm::vec2 offset{0, 0};
  glm::vec2 scale{1, 1};
  float rotation = 0;  ///< radians
  float strength = 1;  ///< of normal and occlusion textures
};

enum class MaterialModel : std::uint8_t {
  MetalRough,  ///< glTF's
  Phong,       ///< MTL's: ambient, base_color as diffuse, specular, shininess
  Unlit,       ///< base_color as it is
};
enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// How a surface looks. Colours are linear.
struct Material {
  std::string name;
  MaterialModel model = MaterialModel::MetalRough;
  glm::vec4 base_color{1, 1, 1, 1};  ///< diffuse colour and opacity
  TextureUse base_color_texture;     ///< sRGB, with opacity in a fourth channel
  float metallic = 0;
  float roughness = 0.5F;
  TextureUse metallic_roughness_texture;  ///< linear: green roughness, blue metallic
  TextureUse normal_texture;              ///< linear, tangent space
  TextureUse occlusion_texture;           ///< linear: red
  glm::vec3 emissive{0, 0, 0};            ///< may exceed 1 (KHR_materials_emissive_strength)
  TextureUse emissive_texture;            ///< sRGB
  glm::vec3 ambient{1, 1, 1};             ///< Phong: factor of base_color under ambient light
  glm::vec3 specular{0, 0, 0};            ///< Phong
  TextureUse specular_texture;            ///< Phong, sRGB
  float shininess = 32;                   ///< Phong: exponent
  AlphaMode alpha_mode = AlphaMode::Opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
  Json extensions;  ///< what the file says beyond this, by its name there ("KHR_materials_clearcoat"); null: nothing
};

enum class LightKind : std::uint8_t { Directional, Point, Spot };

/// A light, shining along its node's −z.
struct LightSource {
  std::string name;
  LightKind kind = LightKind::Directional;
  glm::vec3 color{1, 1, 1};  ///< linear
  float intensity = 1;       ///< candela, of directional lights lux
  float range = 0;           ///< metres; 0: unbounded
  float inner_cone = 0;      ///< of spot lights, radians from the axis to where it begins to fall
  float outer_cone = 0.785398163F;
};

/// A camera, looking along its node's −z, y up.
struct Camera {
  std::string name;
  bool perspective = true;
  float fov_y = 0.785398163F;  ///< of a perspective camera: the whole vertical angle, radians
  float height = 2;            ///< of an orthographic one: what it sees from bottom to top, in units
  float aspect = 0;            ///< width ÷ height that it was made for; 0: the picture's
  float near = 0;              ///< 0: chosen from the scene
  float far = 0;               ///< 0: infinite, or chosen
};

struct Placement {
  glm::vec3 translation{0, 0, 0};
  glm::quat rotation{1, 0, 0, 0};  ///< w, x, y, z
  glm::vec3 scale{1, 1, 1};
};

struct Node {
  std::string name;
  std::variant<Placement, glm::mat4> placement;  ///< animated nodes have the first
  std::vector<NodeId> children;
  MeshId mesh;
  CameraId camera;
  LightId light;
  SkinId skin;
  std::vector<float> morph_weights;  ///< empty: the mesh's own are 0
  bool visible = true;
};

struct Skin {
  std::string name;
  std::vector<NodeId> joints;
  std::vector<glm::mat4> inverse_bind_matrices;  ///< one a joint, or empty: identities
  NodeId skeleton;
};

enum class KeyInterpolation : std::uint8_t { Step, Linear, Cubic };
enum class AnimatedProperty : std::uint8_t { Translation, Rotation, Scale, MorphWeights };

struct AnimationChannel {
  NodeId node;
  AnimatedProperty property = AnimatedProperty::Translation;
  KeyInterpolation interpolation = KeyInterpolation::Linear;
  Array<float> times;   ///< seconds, rising
  Array<float> values;  ///< of each time; with Cubic: in-tangent, value, out-tangent
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
};

/// Nodes in a hierarchy, and what they show. Meshes and images are shared, never changed; the lists are cheap to copy,
/// but copying is said aloud all the same.
///
/// Invariants: ids name elements of their lists, faces name materials or nothing, children form a forest over `roots`.
struct AZULEJO_EXPORT Scene {
  std::string name;
  std::vector<Node> nodes;
  std::vector<NodeId>
      roots;  ///< of what is shown; nodes that can't be reached from here belong to other scenes of the file
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<LightSource> lights;
  std::vector<Camera> cameras;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  Space space;

  Scene() = default;
  Scene(Scene&&) noexcept = default;
  Scene& operator=(Scene&&) noexcept = default;
  ~Scene() = default;
  Scene clone() const { return Scene(*this); }

  /// Throws Error(Data), beginning with `what`, where an invariant doesn't hold: ids, cycles, nodes with two parents.
  /// Meshes are taken to be checked. Cost O(nodes + faces); any depth.
  void check(std::string_view what) const;

 private:
  Scene(const Scene&) = default;
  Scene& operator=(const Scene&) = default;
};

/// A node as `walk` comes to it.
struct PlacedNode {
  NodeId node;
  glm::mat4 world_from_node{1.0F};
  bool visible = true;  ///< the node and all above it
};

/// The node's own matrix.
AZULEJO_EXPORT glm::mat4 parent_from_node(const Node& node);
/// All nodes below `scene.roots`, parents before children, siblings in order. Any depth. Cost O(nodes).
AZULEJO_EXPORT std::vector<PlacedNode> walk(const Scene& scene);
/// A scene that shows the mesh alone. Its material, where it names none, is the default: light gray, not metallic.
AZULEJO_EXPORT Scene scene_of(Mesh mesh);
/// Of all visible meshes, in world coordinates, by the vertices that are finite.
AZULEJO_EXPORT Box3 bounds(const Scene& scene);

}  // namespace azulejo
