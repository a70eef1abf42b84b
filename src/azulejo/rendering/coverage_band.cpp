#include "azulejo/rendering/coverage_band.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace azulejo {
namespace {

// What a pixel knows of the lines that pass it: 0 none, below kSeveral the one, kSeveral that there are more, above
// kListed which list they are in.
constexpr std::uint32_t kSeveral = 0x80000000U;
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

template <class T>
void assign(Array<T>& array, std::size_t size, T value) {
  array.resize(size);
  std::fill(array.begin(), array.end(), value);
}

}  // namespace

CoverageBand::CoverageBand(int width, int rows)
    : width_(width), blocks_((width + 1 + kBlock) / kBlock), words_((blocks_ + 63) / 64) {
  const auto height = static_cast<std::size_t>(rows);
  const auto row_size = static_cast<std::size_t>(blocks_) * kBlock;
  assign(areas_, height * row_size, std::uint32_t{0});
  assign(chains_, height * row_size, std::uint32_t{0});
  assign(touched_, height * static_cast<std::size_t>(words_), std::uint64_t{0});
  crowds_.resize(height);
  assign(sums_, row_size, std::int32_t{0});
  assign(coverage_, row_size, 0.0F);
}

void CoverageBand::move_to(int first_row, int rows) {
  first_ = first_row;
  rows_ = rows;
  used_first_ = rows;
  used_last_ = -1;
}

inline void CoverageBand::touch(int row, std::int32_t column) {
  std::uint64_t* const words = touched_.data() + static_cast<std::ptrdiff_t>(row) * words_;
  const auto block = static_cast<std::uint32_t>(column) / kBlock;
  words[block >> 6] |= std::uint64_t{1} << (block & 63);
  const auto next = static_cast<std::uint32_t>(column + 1) / kBlock;
  if (next != block) words[next >> 6] |= std::uint64_t{1} << (next & 63);
}

inline void CoverageBand::add_piece(const EdgePiece& piece, std::int32_t sign, std::uint32_t chain) {
  const std::int32_t height = piece.yb - piece.ya;
  const int row = piece.row - first_;
  const auto at = static_cast<std::size_t>(std::ptrdiff_t{row} * blocks_ * kBlock + piece.column);
  // Of its height what is left of it in its pixel goes to the next one.
  const std::int32_t left = (height * (piece.xa + piece.xb) + (1 << 12)) >> 13;
  const std::int32_t whole = height << (16 - kEdgeBits);
  areas_[at] += static_cast<std::uint32_t>(sign * (whole - left));
  areas_[at + 1] += static_cast<std::uint32_t>(sign * left);
  touch(row, piece.column);
  std::uint32_t& known = chains_[at];
  if (known == chain) return;
  crowded_ = crowded_ || known != 0;
  known = known == 0 ? chain : kSeveral;
}

void CoverageBand::add_middle(int row, std::int32_t x, std::int32_t sign) {
  const std::int32_t column = (x + kEdgeOne / 2 - 1) >> kEdgeBits;
  const int band_row = row - first_;
  areas_[static_cast<std::size_t>(std::ptrdiff_t{band_row} * blocks_ * kBlock + column)] +=
      static_cast<std::uint32_t>(sign * (1 << 16));
  touch(band_row, column);
}

void CoverageBand::use(int first, int last) {
  used_first_ = std::min(used_first_, first - first_);
  used_last_ = std::max(used_last_, last - first_);
}

void CoverageBand::add_edge(const OutlineEdge& edge, Antialias antialias) {
  const EdgeWalk walk(edge);
  const std::int32_t sign = walk.sign();
  const auto add_it = [&](const EdgePiece& piece) { add_piece(piece, sign, edge.chain); };
  if (walk.level()) {
    // Bounds no area; but what is above and below it in a pixel has different windings.
    const int row = walk.top() >> kEdgeBits;
    if (antialias == Antialias::None || (walk.top() & (kEdgeOne - 1)) == 0 || row < first_ || row >= first_ + rows_)
      return;
    use(row, row);
    return walk.level_pieces(row, row, add_it);
  }
  const int first = std::max(walk.top() >> kEdgeBits, first_);
  const int last = std::min((walk.bottom() - 1) >> kEdgeBits, first_ + rows_ - 1);
  if (first > last) return;
  use(first, last);
  if (antialias == Antialias::Area) {
    walk.pieces(first, last, add_it);
  } else {
    walk.middles(first, last, [&](int row, std::int32_t x) { add_middle(row, x, sign); });
  }
}

void CoverageBand::add(std::span<const OutlineEdge> edges, Antialias antialias) {
  for (const OutlineEdge& edge : edges) add_edge(edge, antialias);
}

void CoverageBand::add(std::span<const OutlineEdge> edges, std::span<const std::uint32_t> chosen, Antialias antialias) {
  for (const std::uint32_t index : chosen) add_edge(edges[index], antialias);
}

void CoverageBand::gather_piece(const EdgePiece& piece, std::int32_t sign) {
  if (piece.column >= width_) return;
  const int row = piece.row - first_;
  std::uint32_t& known = chains_[static_cast<std::size_t>(std::ptrdiff_t{row} * blocks_ * kBlock + piece.column)];
  if (known < kSeveral) return;
  std::vector<Crowded>& crowd = crowds_[static_cast<std::size_t>(row)];
  if (known == kSeveral) {
    crowd.push_back({piece.column, kNone});
    known = kSeveral + static_cast<std::uint32_t>(crowd.size());
  }
  std::uint32_t& head = crowd[known - kSeveral - 1].head;
  const std::int32_t top = piece.row << kEdgeBits;
  pieces_.push_back({{piece.xa, piece.ya - top, piece.xb, piece.yb - top, sign}, head});
  head = static_cast<std::uint32_t>(pieces_.size() - 1);
}

void CoverageBand::gather_edge(const OutlineEdge& edge) {
  const EdgeWalk walk(edge);
  const std::int32_t sign = walk.sign();
  const auto take = [&](const EdgePiece& piece) { gather_piece(piece, sign); };
  if (walk.level()) {
    walk.level_pieces(first_, first_ + rows_ - 1, take);
  } else {
    walk.pieces(first_, first_ + rows_ - 1, take);
  }
}

void CoverageBand::gather(std::span<const OutlineEdge> edges) {
  for (const OutlineEdge& edge : edges) gather_edge(edge);
}

void CoverageBand::gather(std::span<const OutlineEdge> edges, std::span<const std::uint32_t> chosen) {
  for (const std::uint32_t index : chosen) gather_edge(edges[index]);
}

void CoverageBand::settle(int row, FillRule rule) {
  std::vector<Crowded>& crowd = crowds_[static_cast<std::size_t>(row)];
  for (const Crowded& pixel : crowd) {
    edges_.clear();
    for (std::uint32_t i = pixel.head; i != kNone; i = pieces_[i].next) edges_.push_back(pieces_[i].edge);
    const auto x = static_cast<std::size_t>(pixel.column);
    coverage_[x] = pixel_.inside(edges_, sums_[x], rule);
  }
  crowd.clear();
}

void CoverageBand::sum_run(int row, int first, int last, FillRule rule, std::int32_t& carry) {
  const std::ptrdiff_t from = std::ptrdiff_t{first} * kBlock;
  const std::ptrdiff_t at = std::ptrdiff_t{row} * blocks_ * kBlock + from;
  carry = kernels::sum_areas(areas_.data() + at, carry, (last - first) * kBlock, rule, sums_.data() + from,
                             coverage_.data() + from);
  std::fill_n(chains_.data() + at, (last - first) * kBlock, 0U);
  runs_.push_back({first, last, 0, true});
}

std::span<const CoverageRun> CoverageBand::row(int row, FillRule rule) {
  runs_.clear();
  std::uint64_t* const words = touched_.data() + static_cast<std::ptrdiff_t>(row) * words_;
  std::int32_t carry = 0;
  int done = 0;
  // From one touched block to where they end, word by word.
  for (int w = 0; w < words_; ++w) {
    std::uint64_t bits = std::exchange(words[w], 0);
    while (bits != 0) {
      const int skip = std::countr_zero(bits);
      const int count = std::countr_one(bits >> skip);
      bits = skip + count == 64 ? 0 : bits >> (skip + count) << (skip + count);
      const int first = w * 64 + skip;
      if (first > done) {
        const float value = kernels::inside_of(carry, rule);
        if (value > 0) runs_.push_back({done, first, value, false});
      }
      done = first + count;
      sum_run(row, first, done, rule, carry);
    }
  }
  if (done < blocks_) {
    const float value = kernels::inside_of(carry, rule);
    if (value > 0) runs_.push_back({done, blocks_, value, false});
  }
  settle(row, rule);
  return runs_;
}

void CoverageBand::finish() {
  crowded_ = false;
  pieces_.clear();
  used_first_ = rows_;
  used_last_ = -1;
}

}  // namespace azulejo
