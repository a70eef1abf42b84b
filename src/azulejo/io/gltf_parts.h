#pragma once

// The parts of a glTF file, each read into the list of a Scene. Everything is checked; Error(Data) names the place.

#include <cstddef>
#include <vector>

#include "azulejo/data/scene.h"
#include "azulejo/io/gltf_accessor.h"
#include "azulejo/io/gltf_file.h"

namespace azulejo {

/// `meshes`; materials are named out of `materials`. See gltf.h for how primitives become one Mesh.
std::vector<std::shared_ptr<const Mesh>> read_gltf_meshes(GltfFile& file, GltfAccessors& accessors,
                                                          std::size_t materials);
/// Triangles out of the vertices of a primitive (mode 4, 5 or 6), or pairs (1, 2, 3), each shifted by `first`; what a
/// mode can't use is dropped, and so are triangles of strips that use a vertex twice. Appended to `result`.
void append_gltf_elements(std::uint64_t mode, const Array<std::uint32_t>& vertices, std::uint32_t first,
                          Array<std::uint32_t>& result);

/// `materials`, naming textures out of `textures`.
std::vector<Material> read_gltf_materials(GltfFile& file, std::size_t textures);
/// `textures` with their samplers and images, decoded on several threads if options.textures. An image that is
/// missing or damaged is null, with a warning.
std::vector<Texture> read_gltf_textures(GltfFile& file);

/// `skins`, naming nodes out of `nodes`.
std::vector<Skin> read_gltf_skins(GltfFile& file, GltfAccessors& accessors, std::size_t nodes);
/// `animations` of the nodes of `scene`. Channels that azulejo can't play are left out, with a warning.
std::vector<Animation> read_gltf_animations(GltfFile& file, GltfAccessors& accessors, const Scene& scene);

std::vector<Camera> read_gltf_cameras(GltfFile& file);
std::vector<LightSource> read_gltf_lights(GltfFile& file);
/// `nodes`, `roots` and `name` of a scene whose other lists were read.
void read_gltf_nodes(GltfFile& file, GltfAccessors& accessors, Scene& scene);

}  // namespace azulejo
