#include "azulejo/modelling/subdivide.h"

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <random>

#include "azulejo/modelling/primitive.h"
#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

namespace far_ = OpenSubdiv::Far;

constexpr int kLevels = 2;

/// A vertex as OpenSubdiv wants it.
struct Point {
  glm::vec3 at{0};
  void Clear() { at = glm::vec3(0); }
  void AddWithWeight(const Point& other, float weight) { at += weight * other.at; }
};

/// Its tables are made and its levels refined, on one thread: that is all that it offers for this.
class OpenSubdivMesh {
 public:
  std::vector<Point> points;
  std::vector<int> corners;

  void subdivide(const Mesh& mesh, bool quads) {
    std::vector<int> counts(mesh.face_count());
    for (std::size_t f = 0; f < counts.size(); ++f) {
      counts[f] = static_cast<int>(mesh.face_end(f) - mesh.face_begin(f));
    }
    far_::TopologyDescriptor description;
    description.numVertices = static_cast<int>(mesh.vertex_count());
    description.numFaces = static_cast<int>(mesh.face_count());
    description.numVertsPerFace = counts.data();
    description.vertIndicesPerFace = reinterpret_cast<const int*>(mesh.corners.data());
    OpenSubdiv::Sdc::Options options;
    options.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = far_::TopologyRefinerFactory<far_::TopologyDescriptor>;
    refiner_.reset(Factory::Create(
        description,
        Factory::Options(quads ? OpenSubdiv::Sdc::SCHEME_CATMARK : OpenSubdiv::Sdc::SCHEME_LOOP, options)));
    refiner_->RefineUniform(far_::TopologyRefiner::UniformOptions(kLevels));
    const far_::PrimvarRefiner weights(*refiner_);
    points.resize(mesh.vertex_count());
    for (std::size_t v = 0; v < points.size(); ++v) points[v].at = mesh.positions[v];
    for (int level = 1; level <= kLevels; ++level) {
      std::vector<Point> next(static_cast<std::size_t>(refiner_->GetLevel(level).GetNumVertices()));
      weights.Interpolate(level, points, next);
      points = std::move(next);
    }
    const far_::TopologyLevel& last = refiner_->GetLevel(kLevels);
    corners.clear();
    corners.reserve(static_cast<std::size_t>(last.GetNumFaceVertices()));
    for (int f = 0; f < last.GetNumFaces(); ++f) {
      const far_::ConstIndexArray face = last.GetFaceVertices(f);
      corners.insert(corners.end(), face.begin(), face.end());
    }
  }

  /// Middles of the faces that come from each face of the first level.
  std::vector<std::vector<glm::vec3>> middles() const {
    std::vector<std::vector<glm::vec3>> result(static_cast<std::size_t>(refiner_->GetLevel(0).GetNumFaces()));
    const far_::TopologyLevel& last = refiner_->GetLevel(kLevels);
    for (int f = 0; f < last.GetNumFaces(); ++f) {
      glm::vec3 sum(0);
      for (const int v : last.GetFaceVertices(f)) sum += points[static_cast<std::size_t>(v)].at;
      int parent = f;
      for (int level = kLevels; level > 0; --level) parent = refiner_->GetLevel(level).GetFaceParentFace(parent);
      result[static_cast<std::size_t>(parent)].push_back(sum / static_cast<float>(last.GetFaceVertices(f).size()));
    }
    return result;
  }

 private:
  std::unique_ptr<far_::TopologyRefiner> refiner_;
};

/// The largest distance from a face of ours to the nearest of the peer's that come from the same face.
Check compared(const Mesh& ours, const OpenSubdivMesh& peer) {
  const auto middles = peer.middles();
  const std::size_t parts = ours.face_count() / middles.size();
  float apart = ours.corner_count() == peer.corners.size() && ours.vertex_count() == peer.points.size() ? 0 : 1e9F;
  for (std::size_t f = 0; f < ours.face_count(); ++f) {
    glm::vec3 sum(0);
    for (std::size_t c = ours.face_begin(f); c < ours.face_end(f); ++c) sum += ours.positions[ours.corners[c]];
    sum /= static_cast<float>(ours.face_end(f) - ours.face_begin(f));
    float nearest = 1e9F;
    for (const glm::vec3& other : middles[f / parts]) nearest = std::min(nearest, glm::distance(sum, other));
    apart = std::max(apart, nearest);
  }
  return {apart < 1e-5F, fmt::format("{:.1e} apart", apart)};
}

Mesh roughened(Mesh mesh) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> step(-0.003F, 0.003F);
  mesh.attributes.clear();
  for (glm::vec3& each : mesh.positions) each += glm::vec3(step(random), step(random), step(random));
  return mesh;
}

Row subdivision(Mesh made, SubdivisionScheme scheme, bool with_peer) {
  const auto mesh = std::make_shared<Mesh>(std::move(made));
  const auto ours = std::make_shared<Mesh>();
  const auto peer = std::make_shared<OpenSubdivMesh>();
  const bool quads = scheme == SubdivisionScheme::CatmullClark;
  Row row;
  row.work = static_cast<double>(mesh->face_count()) * 16;
  row.unit = "Mface/s";
  row.aim_seconds = 0.4;
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *ours = subdivide(*mesh, {.scheme = scheme, .levels = kLevels}, run);
  };
  row.peer_name = "OpenSubdiv";
  if (with_peer) row.peer = [=](int) { peer->subdivide(*mesh, quads); };
  row.limit_name = "copy";
  row.limit = copy_limit(0, mesh->corner_count() * 16 * 4 + mesh->vertex_count() * 16 * 12);
  row.check = [=] { return with_peer ? compared(*ours, *peer) : Check{ours->face_count() > 1500000, "not compared"}; };
  return row;
}

const Rows kRows([](Bench& bench) {
  const auto quads = [] { return roughened(primitive({.kind = PrimitiveKind::Torus, .segments = 448, .rings = 224})); };
  const auto triangles = [] { return roughened(sphere(100000)); };
  bench.row("subdivide loop, 100 k to 1.6 M triangles",
            [=] { return subdivision(triangles(), SubdivisionScheme::Loop, true); });
  bench.row("subdivide catmull_clark, 100 k to 1.6 M quads",
            [=] { return subdivision(quads(), SubdivisionScheme::CatmullClark, true); });
  bench.row("subdivide catmull_clark, 100 k to 1.6 M quads, with a border", [] {
    Mesh sheet = primitive({.kind = PrimitiveKind::Plane, .segments = 316, .rings = 316});
    return subdivision(roughened(std::move(sheet)), SubdivisionScheme::CatmullClark, true);
  });
  bench.row("subdivide midpoint, 100 k to 1.6 M triangles",
            [=] { return subdivision(triangles(), SubdivisionScheme::Midpoint, false); });
});

}  // namespace
}  // namespace azulejo::bench
