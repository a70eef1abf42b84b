#include "bench/models.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  const auto binary = sphere_file("stl");
  const auto ascii = sphere_file("stl", {.ascii = true});
  const std::string sphere = ", sphere of 1 M triangles";
  add_read_row(bench, {.name = "read STL, binary, triangle by triangle" + sphere,
                       .file = binary,
                       .options = {.weld = false},
                       .aim_seconds = 0.020});
  add_read_row(
      bench,
      {.name = "read STL, binary, welded" + sphere, .file = binary, .peer = AssimpWork::Join, .aim_seconds = 0.100});
  add_read_row(bench,
               {.name = "read STL, ASCII, triangle by triangle" + sphere, .file = ascii, .options = {.weld = false}});
  add_read_row(bench, {.name = "read STL, ASCII, welded" + sphere, .file = ascii, .peer = AssimpWork::Join});
});

}  // namespace
}  // namespace azulejo::bench
