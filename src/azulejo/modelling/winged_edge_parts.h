#pragma once

#include <cstdint>

namespace azulejo {

/// WingedEdge::Vertex::edge of a vertex that was killed.
inline constexpr std::uint32_t kDeadVertex = 0xFFFFFFFE;

}  // namespace azulejo
