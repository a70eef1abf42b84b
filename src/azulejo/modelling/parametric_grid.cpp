#include "azulejo/modelling/parametric_grid.h"

namespace azulejo {

GridVertices add_grid(SurfaceBuilder& builder, const ParametricGrid& grid,
                      const std::function<SurfacePlace(double u, double v)>& surface) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  const auto rows = static_cast<std::size_t>(grid.rows);
  const auto share = [](std::size_t i, std::size_t count) {
    return static_cast<double>(i) / static_cast<double>(count);
  };
  GridVertices vertices(rows + 1, std::vector<std::uint32_t>(columns + 1));
  std::vector<std::vector<glm::dvec3>> normals(rows + 1, std::vector<glm::dvec3>(columns + 1));
  for (std::size_t j = 0; j <= rows; ++j) {
    for (std::size_t i = 0; i <= columns; ++i) {
      const bool again_u = grid.wrap_u && i == columns;
      const bool again_v = grid.wrap_v && j == rows;
      if (again_u || again_v) {
        vertices[j][i] = vertices[again_v ? 0 : j][again_u ? 0 : i];
        normals[j][i] = normals[again_v ? 0 : j][again_u ? 0 : i];
        continue;
      }
      const SurfacePlace place = surface(share(i, columns), share(j, rows));
      vertices[j][i] = builder.add_vertex(place.position);
      normals[j][i] = place.normal;
    }
  }
  const auto add_corner = [&](std::size_t i, std::size_t j) {
    builder.add_corner(vertices[j][i], normals[j][i], {share(i, columns), share(j, rows)});
  };
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      add_corner(i, j);
      add_corner(i, j + 1);
      add_corner(i + 1, j + 1);
      add_corner(i + 1, j);
      builder.end_face();
    }
  }
  return vertices;
}

}  // namespace azulejo
