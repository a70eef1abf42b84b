#include "azulejo/modelling/plane_noding.h"

#include <algorithm>
#include <queue>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/modelling/sweep_line.h"

namespace azulejo::plane {
namespace {

__extension__ using Wide = __int128;

/// A place in coordinates along the diagonals, whole numbers and fractions in 0 … 1: u + u_part / parts, v + v_part /
/// parts. Whole coordinates have 26 bits, `parts` 54.
struct Place {
  std::int64_t u = 0;
  std::int64_t v = 0;
  std::int64_t u_part = 0;
  std::int64_t v_part = 0;
  std::int64_t parts = 1;
};

int compare_fractions(std::int64_t a, std::int64_t a_parts, std::int64_t b, std::int64_t b_parts) {
  const Wide left = static_cast<Wide>(a) * b_parts;
  const Wide right = static_cast<Wide>(b) * a_parts;
  return left < right ? -1 : left > right ? 1 : 0;
}

/// In the order of the sweep.
int compare(const Place& a, const Place& b) {
  if (a.u != b.u) return a.u < b.u ? -1 : 1;
  const int by_u = compare_fractions(a.u_part, a.parts, b.u_part, b.parts);
  if (by_u != 0) return by_u;
  if (a.v != b.v) return a.v < b.v ? -1 : 1;
  return compare_fractions(a.v_part, a.parts, b.v_part, b.parts);
}

/// An edge in coordinates along the diagonals, in the order of the sweep.
struct Turned {
  std::int32_t u = 0;
  std::int32_t v = 0;
  std::int32_t du = 0;
  std::int32_t dv = 0;
  std::uint32_t edge = 0;
};

std::int64_t side(const Turned& line, std::int64_t u, std::int64_t v) {
  return line.du * (v - line.v) - line.dv * (u - line.u);
}

/// Positive where the place is above the line.
int side(const Turned& line, const Place& place) {
  const std::int64_t whole = side(line, place.u, place.v);
  const std::int64_t reach = std::int64_t{line.du} + std::abs(line.dv);  // of what the fractions add, at most
  if (place.parts == 1 || std::abs(whole) >= reach) return whole > 0 ? 1 : whole < 0 ? -1 : 0;
  const Wide sum = static_cast<Wide>(whole) * place.parts + static_cast<Wide>(line.du) * place.v_part -
                   static_cast<Wide>(line.dv) * place.u_part;
  return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

/// Of two lines that cross.
Place crossing(const Turned& a, const Turned& b) {
  std::int64_t parts = std::int64_t{a.du} * b.dv - std::int64_t{a.dv} * b.du;
  std::int64_t along = (std::int64_t{b.u} - a.u) * b.dv - (std::int64_t{b.v} - a.v) * b.du;
  if (parts < 0) {
    parts = -parts;
    along = -along;
  }
  Place place;
  place.parts = parts;
  const auto divide = [&](std::int64_t origin, std::int64_t step, std::int64_t& whole, std::int64_t& part) {
    const Wide product = static_cast<Wide>(step) * along;
    Wide quotient = product / parts;
    if (quotient * parts > product) --quotient;
    whole = origin + static_cast<std::int64_t>(quotient);
    part = static_cast<std::int64_t>(product - quotient * parts);
  };
  divide(a.u, a.du, place.u, place.u_part);
  divide(a.v, a.dv, place.v, place.v_part);
  return place;
}

/// The square that a place is in, of those around the points of the grid, with their left and lower sides. Of
/// coordinates u = x + y, v = x − y.
GridPoint square_of(const Place& place) {
  const std::int64_t sum = place.u + place.v + 1 + (place.u_part + place.v_part >= place.parts ? 1 : 0);
  const std::int64_t difference = place.u - place.v + 1 - (place.u_part < place.v_part ? 1 : 0);
  return {static_cast<std::int32_t>(sum >> 1), static_cast<std::int32_t>(difference >> 1)};
}

/// An edge goes through the square around a point of the grid.
struct Pass {
  std::uint32_t edge = 0;
  GridPoint square;
};

/// Along which diagonal the line sweeps.
enum class Diagonal : std::uint8_t { Rising, Falling };

class DiagonalSweep {
 public:
  DiagonalSweep(const Graph& graph, Diagonal diagonal, const Run& run, Array<Pass>& passes)
      : diagonal_(diagonal), run_(run), passes_(passes) {
    lines_.reserve(graph.edges.size());
    events_.reserve(2 * graph.edges.size());
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      GridPoint begin = turned(graph.points[graph.edges[e].low]);
      GridPoint end = turned(graph.points[graph.edges[e].high]);
      if (end < begin) std::swap(begin, end);
      lines_.push_back({begin.x, begin.y, end.x - begin.x, end.y - begin.y, e});
      events_.push_back({begin, e});
      events_.push_back({end, kPlain});
    }
  }

  /// Notes the edges that go through a crossing or another one's end.
  void find_crossings() {
    finding_ = true;
    sweep();
  }

  /// Notes the edges across the diagonals, of squares, that the line passes all at once.
  void find_passes(std::span<const GridPoint> squares) {
    for (const GridPoint& square : squares) events_.push_back({turned(square), kSquare});
    sweep();
  }

 private:
  static constexpr std::uint32_t kPlain = 0xFFFFFFFF;
  static constexpr std::uint32_t kSquare = 0xFFFFFFFE;
  struct Event {
    GridPoint at;                 ///< u, v
    std::uint32_t what = kPlain;  ///< the edge that begins
  };
  struct Later {
    bool operator()(const Place& a, const Place& b) const { return compare(a, b) > 0; }
  };
  using Line = SweepLine<Turned>;

  GridPoint turned(const GridPoint& point) const {
    const GridPoint rising{point.x + point.y, point.x - point.y};
    return diagonal_ == Diagonal::Rising ? rising : GridPoint{rising.y, rising.x};
  }

  void sweep() {
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    std::size_t next = 0;
    for (std::size_t step = 0; next < events_.size() || !crossings_.empty(); ++step) {
      if (step % 65536 == 0) check_limits();
      Place place;
      if (next < events_.size()) place = {events_[next].at.x, events_[next].at.y};
      if (next == events_.size() || (!crossings_.empty() && compare(crossings_.top(), place) < 0)) {
        place = crossings_.top();
      }
      while (!crossings_.empty() && compare(crossings_.top(), place) == 0) crossings_.pop();
      going_.clear();
      bool is_square = false;
      for (;
           place.parts == 1 && next < events_.size() && events_[next].at.x == place.u && events_[next].at.y == place.v;
           ++next) {
        if (events_[next].what == kSquare) is_square = true;
        if (events_[next].what < kSquare) going_.push_back(lines_[events_[next].what]);
      }
      visit(place, is_square);
    }
  }

  void visit(const Place& place, bool is_square) {
    const std::uint32_t below = line_.last_below([&](const Turned& each) { return side(each, place) > 0; });
    const std::size_t beginning = going_.size();
    std::uint32_t above = line_.above(below);
    for (; above != Line::kEnd && side(line_[above], place) == 0; above = line_.above(above)) {
      const Turned& each = line_[above];
      const bool ends = place.parts == 1 && each.u + each.du == place.u && each.v + each.dv == place.v;
      if (!ends) going_.push_back(each);
    }
    if (finding_ && going_.size() > beginning) {
      const GridPoint square = square_of(place);
      for (std::size_t i = beginning; i < going_.size(); ++i) passes_.push_back({going_[i].edge, square});
    }
    std::sort(going_.begin(), going_.end(), [](const Turned& a, const Turned& b) {
      const std::int64_t turn = std::int64_t{a.du} * b.dv - std::int64_t{a.dv} * b.du;
      return turn != 0 ? turn > 0 : a.edge < b.edge;
    });
    const std::uint32_t last = replace(below, above);
    if (last == below) {
      look_at(below, above);
    } else {
      look_at(below, line_.above(below));
      look_at(last, above);
    }
    if (is_square) note_square(place, below);
  }

  /// What goes on from a place stands between the two nodes then. The uppermost of it, or `below`.
  std::uint32_t replace(std::uint32_t below, std::uint32_t above) {
    std::uint32_t old = line_.above(below);
    std::uint32_t place = below;
    for (const Turned& each : going_) {
      if (old != above) {
        place = old;
        old = line_.above(old);
        line_[place] = each;
      } else {
        place = line_.insert_above(place, each);
      }
    }
    while (old != above) {
      const std::uint32_t gone = old;
      old = line_.above(old);
      line_.erase(gone);
    }
    return place;
  }

  /// Keeps the crossing of two neighbours for later. Where one ends on the other is met as it comes.
  void look_at(std::uint32_t lower, std::uint32_t upper) {
    if (lower == Line::kEnd || upper == Line::kEnd) return;
    const Turned& a = line_[lower];
    const Turned& b = line_[upper];
    const GridPoint a_end{a.u + a.du, a.v + a.dv};
    const GridPoint b_end{b.u + b.du, b.v + b.dv};
    const bool cross = a_end < b_end ? side(b, a_end.x, a_end.y) > 0 : side(a, b_end.x, b_end.y) < 0;
    if (cross) crossings_.push(crossing(a, b));
  }

  /// Notes what goes across the diagonal of a square that stands on the sweep line, two units long. Its ends are corners:
  /// of the four, the one to the left and below belongs to the square, the lower end of the rising diagonal.
  void note_square(const Place& place, std::uint32_t below) {
    const GridPoint at{static_cast<std::int32_t>(place.u), static_cast<std::int32_t>(place.v)};
    const GridPoint square = diagonal_ == Diagonal::Rising ? GridPoint{(at.x + at.y) / 2, (at.x - at.y) / 2}
                                                           : GridPoint{(at.x + at.y) / 2, (at.y - at.x) / 2};
    const std::int64_t least = diagonal_ == Diagonal::Rising ? -1 : 0;
    for (std::uint32_t n = below; n != Line::kEnd && side(line_[n], place.u, place.v - 1) <= least;
         n = line_.below(n)) {
      passes_.push_back({line_[n].edge, square});
    }
    for (std::uint32_t n = line_.above(below); n != Line::kEnd; n = line_.above(n)) {
      // Those along the sweep line go through the centre: they begin below it and haven't ended.
      if (line_[n].du != 0 && side(line_[n], place.u, place.v + 1) <= 0) break;
      passes_.push_back({line_[n].edge, square});
    }
  }

  void check_limits() const {
    check_cancelled(run_);
    const std::size_t bytes = passes_.size() * 3 * sizeof(Pass) + crossings_.size() * sizeof(Place);
    if (static_cast<double>(bytes) > static_cast<double>(run_.limits.memory_bytes)) {
      throw Error(Error::Resource, fmt::format("edges cross {} times and more: the limit is {} bytes",
                                               passes_.size() / 2, run_.limits.memory_bytes));
    }
  }

  Diagonal diagonal_;
  const Run& run_;
  Array<Pass>& passes_;
  bool finding_ = false;
  Array<Turned> lines_;
  Array<Event> events_;
  std::priority_queue<Place, std::vector<Place>, Later> crossings_;
  Line line_;
  std::vector<Turned> going_;
};

/// Edges through their squares, in the order in which they pass them: both coordinates of these rise, or fall.
Graph lead_through(const Graph& graph, Array<Pass>& passes) {
  const auto falls = [&](std::uint32_t edge) {
    return graph.points[graph.edges[edge].high].y < graph.points[graph.edges[edge].low].y;
  };
  std::sort(passes.begin(), passes.end(), [&](const Pass& a, const Pass& b) {
    if (a.edge != b.edge) return a.edge < b.edge;
    if (a.square.x != b.square.x) return a.square.x < b.square.x;
    return falls(a.edge) ? a.square.y > b.square.y : a.square.y < b.square.y;
  });
  Array<GridPoint> points(graph.points);
  Array<Segment> segments;
  segments.reserve(graph.edges.size() + passes.size());
  auto pass = passes.begin();
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    std::uint32_t from = edge.low;
    for (; pass != passes.end() && pass->edge == e; ++pass) {
      if (pass->square == points[from]) continue;
      segments.push_back({from, static_cast<std::uint32_t>(points.size()), edge.winding});
      from = static_cast<std::uint32_t>(points.size());
      points.push_back(pass->square);
    }
    segments.push_back({from, edge.high, edge.winding});
  }
  return make_graph(points, segments);
}

}  // namespace

Graph snap_rounded(const Graph& graph, const Run& run) {
  Array<Pass> passes;
  DiagonalSweep(graph, Diagonal::Rising, run, passes).find_crossings();
  Array<GridPoint> squares(graph.points);
  for (const Pass& pass : passes) squares.push_back(pass.square);
  std::sort(squares.begin(), squares.end());
  squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
  DiagonalSweep(graph, Diagonal::Rising, run, passes).find_passes(squares);
  DiagonalSweep(graph, Diagonal::Falling, run, passes).find_passes(squares);
  return lead_through(graph, passes);
}

}  // namespace azulejo::plane
