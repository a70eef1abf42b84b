#include "bench/models.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  add_read_row(bench, {.name = "read OFF, sphere of 1 M triangles", .file = sphere_file("off")});
  add_shared_read_row(bench, "read OFF, mannequin", "meshes/off/mannequin-devil.off");
});

}  // namespace
}  // namespace azulejo::bench
