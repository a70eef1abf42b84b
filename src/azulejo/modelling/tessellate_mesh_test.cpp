#include <gtest/gtest.h>

#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/tessellate.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {
namespace {

TEST(TessellateMesh, KeepsTheSurfaceAndWhatIsOnIt) {
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Dodecahedron, PrimitiveKind::Cylinder}) {
    Mesh mesh = primitive({.kind = kind});
    Array<std::uint32_t> numbers;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) numbers.push_back(f);
    mesh.material = numbers;
    mesh.attributes.push_back({"number", Domain::Face, 1, numbers});
    const Mesh triangles = tessellate(mesh);
    EXPECT_NO_THROW(triangles.check("triangles"));
    EXPECT_TRUE(triangles.all_triangles());
    EXPECT_EQ(triangles.face_count(), mesh.triangle_count());
    EXPECT_EQ(triangles.material, *triangles.find("number")->get<std::uint32_t>());
    const Topology before = topology(mesh);
    const Topology after = topology(triangles);
    EXPECT_TRUE(after.printable());
    EXPECT_NEAR(after.shells[0].volume, before.shells[0].volume, 1e-5);
    EXPECT_NEAR(after.shells[0].area, before.shells[0].area, 1e-5);
    // A triangle's corners keep the coordinates that they have in their face.
    const Array<float>& texture = *mesh.find("TEXCOORD_0")->get<float>();
    const Array<float>& kept = *triangles.find("TEXCOORD_0")->get<float>();
    for (std::size_t t = 0; t < triangles.face_count(); ++t) {
      const std::size_t face = triangles.material[t];
      for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
        bool found = false;
        for (std::size_t k = mesh.face_begin(face); k < mesh.face_end(face); ++k) {
          found = found || (mesh.corners[k] == triangles.corners[c] && texture[2 * k] == kept[2 * c] &&
                            texture[2 * k + 1] == kept[2 * c + 1]);
        }
        ASSERT_TRUE(found) << t;
      }
    }
  }
}

TEST(TessellateMesh, LeavesOutWhatIsNoFace) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.corners = {0, 1, 0, 1, 3, 2};
  mesh.face_offsets = {0, 2, 2, 6};
  EXPECT_EQ(tessellate(mesh).face_count(), 2U);
  EXPECT_EQ(tessellate(Mesh()).face_count(), 0U);
}

}  // namespace
}  // namespace azulejo
