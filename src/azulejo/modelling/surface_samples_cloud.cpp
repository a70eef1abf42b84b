#include <algorithm>
#include <cmath>
#include <string_view>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/picked_attribute.h"
#include "azulejo/modelling/surface_samples.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 12;

/// What means nothing for a point, and what is made anew.
bool is_left_out(const Attribute& attribute) {
  const std::string_view name = attribute.name;
  return name == "TANGENT" || name == "face" || name == "NORMAL" || name.starts_with("JOINTS_") ||
         name.starts_with("WEIGHTS_");
}

class Cloud {
 public:
  Cloud(const Mesh& mesh, const SurfaceArea& surface, const Array<SurfaceSample>& samples, const Run& run)
      : mesh_(mesh), surface_(surface), samples_(samples), run_(run) {}

  Mesh points() {
    Mesh cloud;
    cloud.name = mesh_.name;
    cloud.space = mesh_.space;
    cloud.positions.resize(samples_.size());
    Array<std::uint32_t> face(samples_.size());
    for_each([&](std::size_t i, const SurfaceSample& sample) {
      cloud.positions[i] = glm::vec3(mixed(surface_.positions(sample.triangle), sample.shares));
      face[i] = surface_.face(sample.triangle);
    });
    cloud.attributes.push_back({"NORMAL", Domain::Vertex, 3, normals()});
    for (const Attribute& each : mesh_.attributes) {
      if (!is_left_out(each)) cloud.attributes.push_back(at_samples(each, face));
    }
    cloud.attributes.push_back({"face", Domain::Vertex, 1, std::move(face)});
    return cloud;
  }

 private:
  template <class F>
  void for_each(F f) const {
    parallel_for(samples_.size(), kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) f(i, samples_[i]);
    });
  }

  static glm::dvec3 mixed(const std::array<glm::dvec3, 3>& corner, const CornerShares& shares) {
    return corner[0] * shares[0] + corner[1] * shares[1] + corner[2] * shares[2];
  }

  /// The elements of an attribute at the corners of a triangle.
  std::array<std::size_t, 3> elements(const Attribute& attribute, std::size_t triangle) const {
    const auto corners = surface_.corners(triangle);
    std::array<std::size_t, 3> list{};
    for (std::size_t c = 0; c < 3; ++c) {
      list[c] = attribute.domain == Domain::Vertex ? mesh_.corners[corners[c]] : corners[c];
    }
    return list;
  }

  Array<float> normals() const {
    Array<float> values(3 * samples_.size());
    const Attribute* const given = mesh_.find("NORMAL");
    const bool smooth =
        given != nullptr && given->components == 3 && given->domain != Domain::Face && given->get<float>() != nullptr;
    for_each([&](std::size_t i, const SurfaceSample& sample) {
      glm::dvec3 normal(0);
      if (smooth) {
        const Array<float>& from = *given->get<float>();
        const auto at = elements(*given, sample.triangle);
        for (std::size_t c = 0; c < 3; ++c) {
          const float* const n = from.data() + 3 * at[c];
          normal += glm::dvec3(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])) *
                    sample.shares[c];
        }
      }
      double length = glm::length(normal);
      if (!(length > 1e-6) || !std::isfinite(length)) {
        const auto corner = surface_.positions(sample.triangle);
        normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        length = glm::length(normal);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        values[3 * i + k] = static_cast<float>(normal[static_cast<int>(k)] / length);
      }
    });
    return values;
  }

  Attribute at_samples(const Attribute& attribute, const Array<std::uint32_t>& face) const {
    if (attribute.domain == Domain::Face) {
      Attribute result = picked(attribute, face);
      result.domain = Domain::Vertex;
      return result;
    }
    Attribute result{attribute.name, Domain::Vertex, attribute.components, {}};
    std::visit([&](const auto& values) { result.values = mixed_values(attribute, values); }, attribute.values);
    return result;
  }

  template <class T>
  Array<T> mixed_values(const Attribute& attribute, const Array<T>& values) const {
    const auto components = static_cast<std::size_t>(attribute.components);
    Array<T> result(components * samples_.size());
    for_each([&](std::size_t i, const SurfaceSample& sample) {
      const auto at = elements(attribute, sample.triangle);
      const auto largest = static_cast<std::size_t>(std::max_element(sample.shares.begin(), sample.shares.end()) -
                                                    sample.shares.begin());
      for (std::size_t k = 0; k < components; ++k) {
        if constexpr (std::is_same_v<T, std::uint32_t>) {
          result[components * i + k] = values[components * at[largest] + k];
        } else {
          double sum = 0;
          for (std::size_t c = 0; c < 3; ++c) {
            sum += static_cast<double>(values[components * at[c] + k]) * sample.shares[c];
          }
          // Shares add up to 1 but for rounding: 255 stays 255.
          result[components * i + k] = static_cast<T>(std::is_same_v<T, float> ? sum : std::floor(sum + 0.5));
        }
      }
    });
    return result;
  }

  const Mesh& mesh_;
  const SurfaceArea& surface_;
  const Array<SurfaceSample>& samples_;
  const Run& run_;
};

}  // namespace

Mesh cloud_of(const Mesh& mesh, const SurfaceArea& surface, const Array<SurfaceSample>& samples, const Run& run) {
  return Cloud(mesh, surface, samples, run).points();
}

}  // namespace azulejo
