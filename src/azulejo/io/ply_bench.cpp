#include "bench/models.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  add_read_row(bench, {.name = "read PLY, binary, sphere of 1 M triangles", .file = sphere_file("ply")});
  add_read_row(bench,
               {.name = "read PLY, ASCII, sphere of 1 M triangles", .file = sphere_file("ply", {.ascii = true})});
  add_shared_read_row(bench, "read PLY, ASCII, Stanford bunny (69,451 triangles)",
                      "meshes/scans/stanford_bunny_zippered.ply");
});

}  // namespace
}  // namespace azulejo::bench
