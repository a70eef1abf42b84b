#include "azulejo/charting/iso_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace azulejo {
namespace {

/// Edges of a cell, clockwise as seen.
enum Edge : std::uint8_t { Top, Right, Bottom, Left, NoEdge };

/// What is above the level of a cell's corners: bits of the upper left, upper right, lower right, lower left one; of a
/// cell with two opposite ones a further bit says that they are joined. 0 is a cell without lines, or of lines passed.
using Code = std::uint8_t;
constexpr Code kJoined = 16;
constexpr Code kUpperLeftSaddle = 5;
constexpr Code kUpperRightSaddle = 10;

/// The line of a cell that has one, with what is above on its left.
struct Segment {
  Edge from;
  Edge to;
};
constexpr std::array<Segment, 16> kSegments{{{NoEdge, NoEdge},
                                             {Left, Top},
                                             {Top, Right},
                                             {Left, Right},
                                             {Right, Bottom},
                                             {NoEdge, NoEdge},
                                             {Top, Bottom},
                                             {Left, Bottom},
                                             {Bottom, Left},
                                             {Bottom, Top},
                                             {NoEdge, NoEdge},
                                             {Bottom, Right},
                                             {Right, Left},
                                             {Right, Top},
                                             {Top, Left},
                                             {NoEdge, NoEdge}}};

/// The two lines of a saddle, as the codes of cells that have one of them.
std::array<Code, 2> lines_of(Code saddle) {
  switch (saddle) {
    case kUpperLeftSaddle: return {1, 4};
    case kUpperLeftSaddle | kJoined: return {13, 7};
    case kUpperRightSaddle: return {2, 8};
    default: return {14, 11};
  }
}

bool is_saddle(Code code) { return (code & 15) == kUpperLeftSaddle || (code & 15) == kUpperRightSaddle; }

/// Takes one line after the other out of the cells.
class Tracer {
 public:
  Tracer(const ImageView<const float>& field, float level)
      : field_(field),
        level_(level),
        columns_(field.width - 1),
        rows_(field.height - 1),
        codes_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  IsoLines trace() {
    for (int y = 0; y < rows_; ++y) classify(y);
    for (int y = 0; y < rows_; ++y) {
      const Code* const row = &codes_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_)];
      for (int x = 0; x < columns_; ++x) {
        std::uint64_t eight = 0;
        if (x + 8 <= columns_) {
          std::memcpy(&eight, row + x, 8);
          if (eight == 0) {
            x += 7;
            continue;
          }
        }
        while (row[x] != 0) trace_from(x, y);
      }
    }
    return std::move(lines_);
  }

 private:
  Code& code(int x, int y) {
    return codes_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)];
  }

  void classify(int y) {
    const float* const upper = field_.row(y);
    const float* const lower = field_.row(y + 1);
    Code* const codes = &code(0, y);
    const float level = level_;
    const auto above = [level](float value) { return static_cast<unsigned>(value >= level); };
    // A difference with itself is 0 of finite values only.
    const auto finite = [](float value) { return static_cast<unsigned>(value - value == 0); };
    for (int x = 0; x < columns_; ++x) {
      const unsigned bits =
          above(upper[x]) | above(upper[x + 1]) << 1 | above(lower[x + 1]) << 2 | above(lower[x]) << 3;
      const unsigned known = finite(upper[x]) & finite(upper[x + 1]) & finite(lower[x + 1]) & finite(lower[x]);
      codes[x] = static_cast<Code>((bits & (0U - known)) & (0U - static_cast<unsigned>(bits != 15)));
    }
    for (int x = 0; x < columns_; ++x) {
      if (is_saddle(codes[x]) && joins(x, y, codes[x])) codes[x] |= kJoined;
    }
  }

  /// Whether what is above meets in the middle of a saddle.
  bool joins(int x, int y, Code saddle) const {
    const double a = static_cast<double>(field_(x, y)) - level_;
    const double b = static_cast<double>(field_(x + 1, y)) - level_;
    const double c = static_cast<double>(field_(x + 1, y + 1)) - level_;
    const double d = static_cast<double>(field_(x, y + 1)) - level_;
    // The bilinear value at the saddle, (ac − bd) ÷ (a + c − b − d), whose divisor has the sign of the diagonal above.
    const double value = a * c - b * d;
    return saddle == kUpperLeftSaddle ? value >= 0 : value <= 0;
  }

  glm::vec2 crossing(int x, int y, Edge edge) const {
    const bool level_edge = edge == Top || edge == Bottom;
    const int x0 = edge == Right ? x + 1 : x;
    const int y0 = edge == Bottom ? y + 1 : y;
    const double first = field_(x0, y0);
    const double second = level_edge ? field_(x0 + 1, y0) : field_(x0, y0 + 1);
    const auto share = static_cast<float>((level_ - first) / (second - first));
    return {static_cast<float>(x0) + (level_edge ? share : 0), static_cast<float>(y0) + (level_edge ? 0 : share)};
  }

  /// Takes a line out of a cell: the one that begins (or ends, backwards) at an edge; NoEdge: any.
  Segment take(int x, int y, Edge edge, bool backwards) {
    Code& here = code(x, y);
    if (!is_saddle(here)) {
      const Segment segment = kSegments[here];
      if (edge != NoEdge && (backwards ? segment.to : segment.from) != edge) return {NoEdge, NoEdge};
      here = 0;
      return segment;
    }
    const std::array<Code, 2> lines = lines_of(here);
    for (std::size_t i = 0; i < 2; ++i) {
      const Segment segment = kSegments[lines[i]];
      if (edge != NoEdge && (backwards ? segment.to : segment.from) != edge) continue;
      here = lines[1 - i];
      return segment;
    }
    return {NoEdge, NoEdge};
  }

  /// An edge of a cell.
  struct Gate {
    int x;
    int y;
    Edge edge;
    friend bool operator==(const Gate&, const Gate&) = default;
  };

  /// Follows a line that leaves a cell through a gate, adding the places where it leaves further ones. Whether it comes
  /// to the gate `home`, from outside.
  bool follow(Gate gate, const Gate& home, bool backwards, std::vector<glm::vec2>& points) {
    while (true) {
      gate.x += gate.edge == Right ? 1 : gate.edge == Left ? -1 : 0;
      gate.y += gate.edge == Bottom ? 1 : gate.edge == Top ? -1 : 0;
      if (gate.x < 0 || gate.y < 0 || gate.x >= columns_ || gate.y >= rows_) return false;
      gate.edge = static_cast<Edge>((gate.edge + 2) & 3);
      if (gate == home) return true;
      const Segment segment = take(gate.x, gate.y, gate.edge, backwards);
      if (segment.from == NoEdge) return false;
      gate.edge = backwards ? segment.from : segment.to;
      points.push_back(crossing(gate.x, gate.y, gate.edge));
    }
  }

  void trace_from(int x, int y) {
    const Segment segment = take(x, y, NoEdge, false);
    const std::size_t first = lines_.points.size();
    lines_.points.push_back(crossing(x, y, segment.from));
    lines_.points.push_back(crossing(x, y, segment.to));
    const Gate home{x, y, segment.from};
    const bool closed = follow({x, y, segment.to}, home, false, lines_.points);
    if (closed) {
      lines_.points.pop_back();  // the first one again
    } else {
      before_.clear();
      follow(home, {x, y, NoEdge}, true, before_);
      lines_.points.insert(lines_.points.begin() + static_cast<std::ptrdiff_t>(first), before_.rbegin(),
                           before_.rend());
    }
    lines_.starts.push_back(lines_.points.size());
    lines_.closed.push_back(closed ? 1 : 0);
  }

  ImageView<const float> field_;
  float level_;
  int columns_;
  int rows_;
  std::vector<Code> codes_;
  IsoLines lines_;
  std::vector<glm::vec2> before_;
};

}  // namespace

IsoLines iso_lines(const ImageView<const float>& field, float level) {
  if (field.width < 2 || field.height < 2 || !std::isfinite(level)) return {};
  return Tracer(field, level).trace();
}

}  // namespace azulejo
