#include "azulejo/modelling/normals.h"

#include <fmt/format.h>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

/// The largest distance of a normal from the radius of the unit sphere, where it is one of a vertex with an area.
template <class Place, class Normal>
double off_sphere(std::size_t count, Place place, Normal normal) {
  double worst = 0;
  for (std::size_t v = 0; v < count; ++v)
    worst = std::max(worst, static_cast<double>(glm::distance(place(v), normal(v))));
  return worst;
}

Row normals_row(const NormalsOptions& options, double aim) {
  const auto mesh = std::make_shared<Mesh>(sphere(1'000'000));
  const auto ours = std::make_shared<Attribute>();
  // assimp finds by itself which vertices are at one place; they aren't joined in a file of triangles with indices.
  const auto importer = std::make_shared<Assimp::Importer>();
  if (importer->ReadFile(sphere_file("ply")(), 0) == nullptr) throw Error(Error::Data, importer->GetErrorString());
  Row row;
  row.work = static_cast<double>(mesh->face_count());
  row.unit = "Mtri/s";
  row.aim = aim;
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *ours = vertex_normals(*mesh, options, run);
  };
  row.peer_name = "assimp";
  row.peer = [=](int) { importer->ApplyPostProcessing(aiProcess_GenSmoothNormals | aiProcess_ForceGenNormals); };
  row.limit = copy_limit(12 * mesh->vertex_count() + 4 * mesh->corner_count(), 12 * mesh->vertex_count());
  row.check = [=] {
    const Array<float>& values = *ours->get<float>();
    const double apart = off_sphere(
        mesh->vertex_count(), [&](std::size_t v) { return mesh->positions[v]; },
        [&](std::size_t v) { return glm::vec3(values[3 * v], values[3 * v + 1], values[3 * v + 2]); });
    const aiMesh& theirs = *importer->GetScene()->mMeshes[0];
    const auto vec = [](const aiVector3D& v) { return glm::vec3(v.x, v.y, v.z); };
    const double peer_apart = off_sphere(
        theirs.mNumVertices, [&](std::size_t v) { return vec(theirs.mVertices[v]); },
        [&](std::size_t v) { return vec(theirs.mNormals[v]); });
    return Check{apart < 0.01, fmt::format("{:.1e} off the sphere, the peer's {:.1e}", apart, peer_apart)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("normals by area, 1 M triangles", [] { return normals_row({.weight = NormalWeight::Area}, 5); });
  bench.row("normals by angle, 1 M triangles", [] { return normals_row({}, 5); });
  bench.row("normals by angle with creases, 1 M triangles", [] { return normals_row({.crease_angle = 0.7F}, 5); });
});

}  // namespace
}  // namespace azulejo::bench
