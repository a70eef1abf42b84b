#pragma once

#include "azulejo/io/model_codec.h"

namespace azulejo {

/// glTF 2.0: JSON (.gltf) with buffers and images beside it or inside, or all in one file (.glb). Written as GLB.
///
/// Reading
///   meshes      One Mesh each, its primitives one after the other; primitives that name the very same accessors share
///               their vertices. All modes: triangles, strips and fans become triangles, lines `lines`, points vertices
///               without faces. Where only some primitives have an attribute, the others get white (COLOR), else 0: a
///               normal of length 0 means that there is none. COLOR, TEXCOORD, WEIGHTS become f32, JOINTS u32, others
///               u8, u32 or f32 as they are. Quantized and sparse accessors are read; Draco and meshopt are
///               Error(Unsupported), unless the file has the plain values too.
///   materials   Metal-rough, unlit; specular-glossiness as diffuse colour and 1 − glossiness; emissive strength
///               multiplied in. Other extensions are kept as Json; textures keep their indices, so those in there stay
///               right.
///   images      u8, colour profiles ignored (as glTF wants it). One that is missing, outside or damaged: null, and a
///               warning. Decoded on all threads.
///   nodes       Those of the default scene are shown, or of the first, or all. EXT_mesh_gpu_instancing becomes child
///               nodes. Any depth. A node's own morph weights, or its mesh's.
///   Throws      Error(Data) naming the place for anything malformed: indices out of range, views beyond their buffers,
///               cycles, nodes with two parents, falling times; Error(Unsupported) for a required extension that isn't
///               known; Error(Resource): memory stays within run.limits.memory_bytes, and within 256 MiB + 64 times
///               the bytes read.
///
/// Writing
///   meshes      A primitive per material, and one for lines, one for points. Attributes of corners split vertices (equal
///               corners stay one); n-gons become fans of triangles. Attributes of faces are left out, with a warning.
///               Colours of u8 become linear f32.
///   materials   Phong becomes metal-rough: roughness √(2 ÷ (shininess + 2)).
///   images      PNG, embedded, each once. A missing one stays a texture without image.
///   space       Z up becomes a root node that turns it; units become metres where they are known.
///   Throws      Error(Data) for a scene that Scene::check refuses or that has numbers which JSON can't hold;
///               Error(Resource) above 4 GiB, which is as much as a GLB holds.
/// What was read, and is written and read again, is the same: ids, names, numbers to the last bit.
extern const ModelCodec kGltf;

void write_gltf_scene(Output& output, const Scene& scene, const std::string& folder, const std::string& stem,
                      const ModelWriteOptions& options, const Run& run);

}  // namespace azulejo
