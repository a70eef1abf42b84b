#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace azulejo {

/// What of a polygon is drawn.
enum class PolygonMode : std::uint8_t { Filled, Edges, Vertices };
constexpr std::array<std::string_view, 3> enum_names(PolygonMode) { return {"filled", "edges", "vertices"}; }

}  // namespace azulejo
