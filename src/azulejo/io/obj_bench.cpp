#include "bench/models.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  add_read_row(bench, {.name = "read OBJ, sphere of 1 M triangles", .file = sphere_file("obj")});
  add_read_row(bench, {.name = "read OBJ, vertices joined by both, sphere of 1 M triangles",
                       .file = sphere_file("obj"),
                       .peer = AssimpWork::Join});
  add_shared_read_row(bench, "read OBJ, skull (100 k triangles)", "meshes/scans/skull_100k.obj");
  add_shared_read_row(bench, "read OBJ, quadrilaterals with texture coordinates, spot",
                      "meshes/classic/spot_quadrangulated.obj", {.textures = false});
});

}  // namespace
}  // namespace azulejo::bench
