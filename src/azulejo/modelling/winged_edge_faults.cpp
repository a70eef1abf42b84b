#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "azulejo/modelling/winged_edge.h"
#include "azulejo/modelling/winged_edge_parts.h"

namespace azulejo {
namespace {

using Half = WingedEdge::Half;

/// Looks at a structure that may be anything: every number is checked before it is followed.
class Inspection {
 public:
  Inspection(const WingedEdge& solid, std::size_t at_most) : solid_(solid), at_most_(at_most) {}

  std::vector<std::string> faults() {
    for (std::uint32_t e = 0; e < solid_.edge_slots() && room(); ++e) check_edge(e);
    // Rings are walked only where every step leads somewhere.
    if (faults_.empty()) {
      for (std::uint32_t e = 0; e < solid_.edge_slots() && room(); ++e) check_wings(e);
    }
    if (faults_.empty()) {
      in_loop_.assign(2 * solid_.edge_slots(), 0);
      for (std::uint32_t f = 0; f < solid_.face_slots() && room(); ++f) check_face(f);
      check_halves();
      check_vertices();
    }
    return std::move(faults_);
  }

 private:
  bool room() const { return faults_.size() < at_most_; }
  template <class... Arguments>
  void fault(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
    if (room()) faults_.push_back(fmt::format(words, std::forward<Arguments>(arguments)...));
  }
  bool is_vertex(std::uint32_t v) const { return v < solid_.vertex_slots() && solid_.vertex_alive(v); }
  bool is_edge(std::uint32_t e) const { return e < solid_.edge_slots() && solid_.edge_alive(e); }
  bool is_face(std::uint32_t f) const { return f < solid_.face_slots() && solid_.face_alive(f); }
  bool ends_at(std::uint32_t edge, std::uint32_t vertex) const {
    return solid_.edge(edge).vertex[0] == vertex || solid_.edge(edge).vertex[1] == vertex;
  }

  void check_edge(std::uint32_t e) {
    if (!solid_.edge_alive(e)) return;
    const WingedEdge::Edge& edge = solid_.edge(e);
    for (const std::uint32_t v : edge.vertex) {
      if (!is_vertex(v)) fault("edge {} names vertex {}, which isn't there", e, v);
    }
    if (edge.vertex[0] == edge.vertex[1]) fault("edge {} has vertex {} at both ends", e, edge.vertex[0]);
    if (edge.face[0] == kNoElement && edge.face[1] == kNoElement) fault("edge {} has no face", e);
    for (const std::uint32_t f : edge.face) {
      if (f != kNoElement && !is_face(f)) fault("edge {} names face {}, which isn't there", e, f);
    }
    for (int w = 0; w < 4; ++w) {
      const std::uint32_t wing = edge.wing[static_cast<std::size_t>(w)];
      const std::uint32_t vertex = edge.vertex[w < 2 ? 0 : 1];
      if (!is_edge(wing)) {
        fault("wing {} of edge {} is edge {}, which isn't there", w, e, wing);
      } else if (!ends_at(wing, vertex)) {
        fault("wing {} of edge {} is edge {}, which doesn't meet it at vertex {}", w, e, wing, vertex);
      }
    }
  }

  void check_wings(std::uint32_t e) {
    if (!solid_.edge_alive(e)) return;
    for (const Half half : {e << 1, e << 1 | 1U}) {
      const Half after = solid_.next(half);
      if (solid_.from(after) != solid_.to(half)) {
        fault("edges {} and {} follow each other, but not at one vertex", e, after >> 1);
      } else if (solid_.previous(after) != half) {
        fault("after edge {} comes edge {} around a face, but before that comes edge {}", e, after >> 1,
              solid_.previous(after) >> 1);
      } else if (solid_.left(after) != solid_.left(half)) {
        fault("edges {} and {} follow each other around face {}, but one names face {}", e, after >> 1,
              name(solid_.left(half)), name(solid_.left(after)));
      }
    }
  }

  static std::string name(std::uint32_t face) { return face == kNoElement ? "none" : fmt::format("{}", face); }

  void check_face(std::uint32_t f) {
    if (!solid_.face_alive(f)) return;
    std::size_t loops = 0;
    for (std::uint32_t loop = solid_.face(f).loop; loop != kNoElement; loop = solid_.loop(loop).next) {
      if (loops++ > solid_.loop_count()) return fault("the loops of face {} go around in a circle", f);
      const WingedEdge::Loop& record = solid_.loop(loop);
      if (record.face != f) fault("loop {} of face {} names face {}", loop, f, name(record.face));
      if (record.half == kNoElement) {
        if (!is_vertex(record.vertex) || solid_.vertex(record.vertex).edge != kNoElement) {
          fault("loop {} of face {} has no edges and no lone vertex", loop, f);
        }
        continue;
      }
      if (!is_edge(record.half >> 1)) {
        fault("loop {} of face {} begins with edge {}, which isn't there", loop, f, record.half >> 1);
      } else if (solid_.left(record.half) != f) {
        fault("face {} names edge {}, which names face {} there", f, record.half >> 1, name(solid_.left(record.half)));
      } else {
        mark(loop, f);
      }
    }
  }

  void mark(std::uint32_t loop, std::uint32_t f) {
    for (const Half half : solid_.halves_of(loop)) {
      if (in_loop_[half] != 0) return fault("face {} has one loop twice, that of edge {}", f, half >> 1);
      in_loop_[half] = 1;
    }
  }

  void check_halves() {
    for (Half half = 0; half < in_loop_.size() && room(); ++half) {
      if (!solid_.edge_alive(half >> 1) || solid_.left(half) == kNoElement || in_loop_[half] != 0) continue;
      fault("edge {} names face {}, none of whose loops has it", half >> 1, solid_.left(half));
    }
  }

  void check_vertices() {
    std::vector<std::size_t> ends(solid_.vertex_slots(), 0);
    for (std::uint32_t e = 0; e < solid_.edge_slots(); ++e) {
      if (!solid_.edge_alive(e)) continue;
      for (const std::uint32_t v : solid_.edge(e).vertex) ++ends[v];
    }
    for (std::uint32_t v = 0; v < ends.size() && room(); ++v) {
      if (!solid_.vertex_alive(v)) continue;
      const std::uint32_t edge = solid_.vertex(v).edge;
      if (edge == kNoElement) {
        if (ends[v] != 0) fault("vertex {} names no edge, and {} end there", v, ends[v]);
      } else if (!is_edge(edge) || !ends_at(edge, v)) {
        fault("vertex {} names edge {}, which doesn't end there", v, edge);
      } else if (const std::size_t around = solid_.degree(v); around != ends[v]) {
        fault("vertex {} has {} edges, of which {} are around it", v, ends[v], around);
      }
    }
  }

  const WingedEdge& solid_;
  std::size_t at_most_;
  std::vector<std::string> faults_;
  std::vector<std::uint8_t> in_loop_;
};

}  // namespace

std::vector<std::string> WingedEdge::faults(std::size_t at_most) const { return Inspection(*this, at_most).faults(); }

}  // namespace azulejo
