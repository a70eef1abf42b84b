#include "azulejo/modelling/subdivided_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/subdivision_values.h"

namespace azulejo::subdivision {
namespace {

/// Calls set(corner of the level below, corner, other corner) with the two corners of a face that it is between, the
/// same twice for the corner itself, and set_center(corner of the level below, face) for the center of a face.
template <class FacesOf, class Set, class SetCenter>
void split_face(const FacesOf& faces, bool quads, std::size_t face, Set set, SetCenter set_center) {
  const std::size_t end = faces.end(face);
  const std::size_t begin = faces.begin(face);
  std::size_t before = end - 1;
  for (std::size_t c = begin; c < end; before = c++) {
    const std::size_t next = c + 1 == end ? begin : c + 1;
    const std::size_t at = quads ? 4 * c : 12 * face + 3 * (c - begin);
    set(at, c, c);
    set(at + 1, c, next);
    set(at + (quads ? 3 : 2), c, before);
    if (quads) {
      set_center(at + 2, face);
    } else {
      set(12 * face + 9 + (c - begin), c, next);
    }
  }
}

template <std::size_t kCount>
Array<float> split_corners(const Level& level, bool quads, const Array<float>& in, const Run& run) {
  Array<float> out(4 * in.size());
  with_faces(level, [&](auto faces) {
    for_each(level.face_count(), run, [&](std::size_t face) {
      WeightedSum<kCount> mean;
      if (quads) {
        for (std::size_t c = faces.begin(face); c < faces.end(face); ++c) mean.add(in.data() + kCount * c);
        mean.scale(1.0 / static_cast<double>(faces.end(face) - faces.begin(face)));
      }
      split_face(
          faces, quads, face,
          [&](std::size_t place, std::size_t a, std::size_t b) {
            WeightedSum<kCount> sum;
            sum.add(in.data() + kCount * a, 0.5);
            sum.add(in.data() + kCount * b, 0.5);
            sum.store(out.data() + kCount * place);
          },
          [&](std::size_t place, std::size_t) { mean.store(out.data() + kCount * place); });
    });
  });
  return out;
}

}  // namespace

Weighed::Weighed(const Attribute& attribute) : name(attribute.name), components(attribute.components) {
  if (const auto* floats = attribute.get<float>()) {
    values = *floats;
  } else {
    const Array<std::uint8_t>& from = *attribute.get<std::uint8_t>();
    bytes = true;
    values.assign(from.begin(), from.end());
  }
}

Weighed::Weighed(const MorphTarget& target) : name(target.name), components(3) {
  values.resize(3 * target.positions.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = target.positions[i / 3][static_cast<int>(i % 3)];
}

Attribute Weighed::attribute(Domain domain) && {
  Attribute result{name, domain, components, {}};
  if (bytes) {
    Array<std::uint8_t> rounded(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      rounded[i] = static_cast<std::uint8_t>(std::lrint(std::clamp(values[i], 0.0F, 255.0F)));
    }
    result.values = std::move(rounded);
  } else {
    result.values = std::move(values);
  }
  return result;
}

void Weighed::into(MorphTarget& target) && {
  target.positions.resize(values.size() / 3);
  for (std::size_t i = 0; i < target.positions.size(); ++i) {
    target.positions[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }
}

Inherited::Inherited(const Attribute& attribute)
    : name(attribute.name), components(attribute.components), values(*attribute.get<std::uint32_t>()) {}

Attribute Inherited::attribute(Domain domain) && { return {name, domain, components, std::move(values)}; }

void split_corners(const Level& level, bool quads, Weighed& of_corners, const Run& run) {
  with_count(of_corners.components,
             [&](auto count) { of_corners.values = split_corners<count()>(level, quads, of_corners.values, run); });
}

void split_corners(const Level& level, bool quads, Inherited& of_corners, const Run& run) {
  const auto count = static_cast<std::size_t>(of_corners.components);
  Array<std::uint32_t> out(4 * of_corners.values.size());
  const auto set = [&](std::size_t place, std::size_t corner) {
    std::copy_n(of_corners.values.data() + count * corner, count, out.data() + count * place);
  };
  with_faces(level, [&](auto faces) {
    for_each(level.face_count(), run, [&](std::size_t face) {
      split_face(
          faces, quads, face, [&](std::size_t place, std::size_t corner, std::size_t) { set(place, corner); },
          [&](std::size_t place, std::size_t) { set(place, place / 4); });
    });
  });
  of_corners.values = std::move(out);
}

void split_vertices(const Level& level, bool quads, Inherited& of_vertices, const Run& run) {
  const auto count = static_cast<std::size_t>(of_vertices.components);
  Array<std::uint32_t>& values = of_vertices.values;
  const std::size_t vertices = level.vertex_count;
  const std::size_t edges = level.edges.size();
  values.resize(count * (vertices + edges + (quads ? level.face_count() : 0)));
  const auto copy = [&](std::size_t place, std::size_t vertex) {
    std::copy_n(values.data() + count * vertex, count, values.data() + count * place);
  };
  for_each(edges, run, [&](std::size_t edge) { copy(vertices + edge, level.edges[edge][0]); });
  if (!quads) return;
  with_faces(level, [&](auto faces) {
    for_each(level.face_count(), run,
             [&](std::size_t face) { copy(vertices + edges + face, level.corners[faces.begin(face)]); });
  });
}

}  // namespace azulejo::subdivision
