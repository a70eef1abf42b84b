#include "bench/models.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  add_read_row(bench, {.name = "read GLB, sphere of 1 M triangles", .file = sphere_file("glb")});
  // assimp keeps images as the file has them, so neither is asked to decode them.
  add_shared_read_row(bench, "read glTF without its images, damaged helmet",
                      "scenes/gltf/DamagedHelmet/DamagedHelmet.glb", {.textures = false});
});

}  // namespace
}  // namespace azulejo::bench
