#pragma once

// What each model of the shared set of sample files is expected to give: a table, and long for that reason only.

#include <cstddef>

namespace azulejo {

enum class ModelOutcome {
  Mesh,
  Scene,
  Volume,
  Drawing,
  Refused,
};

struct SharedModel {
  const char* path;  ///< in the shared set
  ModelOutcome outcome;
  std::size_t vertices;  ///< of a scene: of all meshes together, each once; of a volume: samples
  std::size_t faces;
  const char* said;  ///< a part of the warning or of the refusal; "": nothing is said
};

// clang-format off
inline constexpr SharedModel kSharedModels[] = {
    {"meshes/broken/OutOfMemory.off", ModelOutcome::Refused, 0, 0, "353535235358 vertices and 6 faces don't fit 288 bytes"},
    {"meshes/broken/ascii_HalfDonut.stl", ModelOutcome::Mesh, 144, 288, ""},
    {"meshes/broken/ascii_Moon.stl", ModelOutcome::Mesh, 60, 116, ""},
    {"meshes/broken/bad-stl-tardis.stl", ModelOutcome::Mesh, 1796, 3636, ""},
    {"meshes/broken/bad-stl-wing.stl", ModelOutcome::Mesh, 423, 842, "1 of 842 stored normals point against"},
    {"meshes/broken/binary_HalfDonut.stl", ModelOutcome::Mesh, 144, 288, "byte 14484: 1 bytes behind the last triangle"},
    {"meshes/broken/binary_StarWithEmptyHeader.stl", ModelOutcome::Mesh, 36, 68, ""},
    {"meshes/broken/busted.stl", ModelOutcome::Mesh, 1941, 3878, ""},
    {"meshes/broken/cube_binary_header_with_RN_newline.ply", ModelOutcome::Mesh, 8, 12, ""},
    {"meshes/broken/cube_binary_starts_with_nl.ply", ModelOutcome::Mesh, 8, 6, ""},
    {"meshes/broken/degtri_sliding.off", ModelOutcome::Mesh, 8, 8, ""},
    {"meshes/broken/elephant-with-holes.off", ModelOutcome::Mesh, 2798, 4463, ""},
    {"meshes/broken/empty.stl", ModelOutcome::Mesh, 0, 0, ""},
    {"meshes/broken/float_inf_point_cloud.ply", ModelOutcome::Mesh, 16, 0, ""},
    {"meshes/broken/many_small_holes.ply", ModelOutcome::Mesh, 2004, 3524, ""},
    {"meshes/broken/mech-holes-shark.off", ModelOutcome::Mesh, 5246, 10192, ""},
    {"meshes/broken/non_manif_hole.ply", ModelOutcome::Mesh, 432, 755, ""},
    {"meshes/broken/ply_empty_header.ply", ModelOutcome::Mesh, 0, 0, "holds no vertices"},
    {"meshes/broken/points_ascii_with_lists.ply", ModelOutcome::Mesh, 5, 0, ""},
    {"meshes/broken/soup.stl", ModelOutcome::Mesh, 300, 100, ""},
    {"meshes/broken/sphereWithHole.stl", ModelOutcome::Mesh, 146, 285, ""},
    {"meshes/broken/spherewithholes.stl", ModelOutcome::Mesh, 593, 1146, ""},
    {"meshes/broken/stl_empty_ascii.stl", ModelOutcome::Mesh, 0, 0, ""},
    {"meshes/broken/triangle_with_empty_solid.stl", ModelOutcome::Mesh, 3, 1, ""},
    {"meshes/broken/triangle_with_two_solids.stl", ModelOutcome::Mesh, 6, 2, ""},
    {"meshes/cad/adis16480.stl", ModelOutcome::Mesh, 3672, 7436, ""},
    {"meshes/cad/cycloidal.ply", ModelOutcome::Mesh, 21384, 43368, ""},
    {"meshes/cad/featuretype.stl", ModelOutcome::Mesh, 2010, 3476, ""},
    {"meshes/cad/fixed_top.ply", ModelOutcome::Mesh, 2374, 4772, ""},
    {"meshes/cad/plate_holes.stl", ModelOutcome::Mesh, 618, 1252, ""},
    {"meshes/cad/tray_1002_tray_bottom.stl", ModelOutcome::Mesh, 2216, 4520, ""},
    {"meshes/genus/3torus.off", ModelOutcome::Mesh, 19, 23, ""},
    {"meshes/genus/brain.ply", ModelOutcome::Mesh, 18844, 36752, ""},
    {"meshes/genus/double-torus-example.off", ModelOutcome::Mesh, 231, 220, ""},
    {"meshes/genus/eight.off", ModelOutcome::Mesh, 315, 634, ""},
    {"meshes/genus/fertility.off", ModelOutcome::Mesh, 4494, 9000, ""},
    {"meshes/multishell/multibody.stl", ModelOutcome::Mesh, 20, 32, ""},
    {"meshes/off/P.off", ModelOutcome::Mesh, 26, 25, ""},
    {"meshes/off/cactus.off", ModelOutcome::Mesh, 620, 1236, ""},
    {"meshes/off/camel.off", ModelOutcome::Mesh, 9770, 19536, ""},
    {"meshes/off/camelhead.off", ModelOutcome::Mesh, 11381, 22704, ""},
    {"meshes/off/cube_quad.off", ModelOutcome::Mesh, 8, 6, ""},
    {"meshes/off/elephant.off", ModelOutcome::Mesh, 2775, 5558, ""},
    {"meshes/off/lion-head.off", ModelOutcome::Mesh, 8356, 16674, ""},
    {"meshes/off/mannequin-devil.off", ModelOutcome::Mesh, 12977, 25888, ""},
    {"meshes/off/mesh_with_colors.off", ModelOutcome::Mesh, 8, 4, ""},
    {"meshes/off/pig.off", ModelOutcome::Mesh, 468, 891, ""},
    {"meshes/off/polygon_mesh.off", ModelOutcome::Mesh, 16344, 32245, ""},
    {"meshes/off/quint_tris.off", ModelOutcome::Mesh, 12, 20, ""},
    {"meshes/scans/stanford_bunny_zippered.ply", ModelOutcome::Mesh, 35947, 69451, ""},
    {"meshes/scans/stanford_dragon_full.ply.gz", ModelOutcome::Mesh, 437645, 871414, ""},
    {"meshes/scans/stanford_dragon_res2.ply.gz", ModelOutcome::Mesh, 100250, 202520, ""},
    {"meshes/scans/stanford_dragon_res4.ply.gz", ModelOutcome::Mesh, 5205, 11102, ""},
};
// clang-format on

/// Endings whose files must all be in the table.
inline constexpr const char* kSharedModelEndings[] = {".stl", ".ply", ".off", ".ply.gz"};

}  // namespace azulejo
