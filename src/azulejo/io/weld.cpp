#include "azulejo/io/weld.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <tuple>
#include <vector>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;
constexpr std::size_t kRecordsOfPart = std::size_t{1} << 13;  ///< a part's table stays in the second-level cache
constexpr std::size_t kMostParts = 512;                       ///< more streams are slower to write than tables to read

struct Record {
  glm::vec3 position;
  std::uint32_t corner;
};

/// Corners divided by the hash of their positions: equal ones come into one part, each part in order.
class Parts {
 public:
  Parts(std::span<const glm::vec3> corners, const Run& run)
      : count_(std::clamp(std::bit_ceil(corners.size() / kRecordsOfPart + 1), std::size_t{1}, kMostParts)),
        records_(corners.size()) {
    const std::size_t chunks = (corners.size() + kChunk - 1) / kChunk;
    std::vector<std::uint32_t> places(chunks * count_);
    parallel_for(corners.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* const counts = &places[begin / kChunk * count_];
      for (std::size_t i = begin; i < end; ++i) ++counts[part_of(corners[i])];
    });
    std::uint32_t place = 0;
    for (std::size_t part = 0; part < count_; ++part) {
      starts_.push_back(place);
      for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        place += std::exchange(places[chunk * count_ + part], place);
      }
    }
    starts_.push_back(place);
    parallel_for(corners.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* const next = &places[begin / kChunk * count_];
      for (std::size_t i = begin; i < end; ++i) {
        records_[next[part_of(corners[i])]++] = {corners[i], static_cast<std::uint32_t>(i)};
      }
    });
  }

  std::size_t size() const { return count_; }
  std::span<Record> operator[](std::size_t part) {
    return std::span(records_).subspan(starts_[part], starts_[part + 1] - starts_[part]);
  }

 private:
  std::size_t part_of(const glm::vec3& position) const {
    return count_ == 1 ? 0 : position_hash(position) >> (64 - std::countr_zero(count_));
  }

  std::size_t count_;
  Array<Record> records_;
  std::vector<std::uint32_t> starts_;
};

bool same(const glm::vec3& a, const glm::vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
bool is_nan(const glm::vec3& p) { return !same(p, p); }

/// Finds for each corner of a part the first corner at its position.
class FirstCorners {
 public:
  FirstCorners(std::uint32_t* first_of_corner, std::uint8_t* is_first)
      : first_of_corner_(first_of_corner), is_first_(is_first) {}

  void find(std::span<Record> records) {
    if (!find_by_table(records)) find_by_sorting(records);
  }

 private:
  void set(std::uint32_t corner, std::uint32_t first) {
    first_of_corner_[corner] = first;
    is_first_[corner] = corner == first ? 1 : 0;
  }

  /// False, and nothing lost, where so many positions meet at the same places that it would take long: by chance
  /// that doesn't happen.
  bool find_by_table(std::span<const Record> records) {
    const std::size_t size = std::bit_ceil(records.size() + records.size() / 4 + 1);
    table_.assign(size, 0);
    unique_.clear();
    std::size_t patience = 16 * records.size() + 1024;
    for (const Record& record : records) {
      if (is_nan(record.position)) {
        set(record.corner, record.corner);
        continue;
      }
      std::size_t slot = position_hash(record.position) >> 16 & (size - 1);
      while (table_[slot] != 0 && !same(unique_[table_[slot] - 1].position, record.position)) {
        slot = (slot + 1) & (size - 1);
        if (--patience == 0) return false;
      }
      if (table_[slot] == 0) {
        unique_.push_back(record);
        table_[slot] = static_cast<std::uint32_t>(unique_.size());
      }
      set(record.corner, unique_[table_[slot] - 1].corner);
    }
    return true;
  }

  void find_by_sorting(std::span<Record> records) {
    const auto end =
        std::partition(records.begin(), records.end(), [](const Record& r) { return !is_nan(r.position); });
    for (auto each = end; each != records.end(); ++each) set(each->corner, each->corner);
    const auto key = [](const Record& r) { return std::tuple(r.position.x, r.position.y, r.position.z, r.corner); };
    std::sort(records.begin(), end, [&](const Record& a, const Record& b) { return key(a) < key(b); });
    for (auto first = records.begin(); first != end;) {
      const std::uint32_t corner = first->corner;
      const glm::vec3 position = first->position;
      for (; first != end && same(first->position, position); ++first) set(first->corner, corner);
    }
  }

  std::uint32_t* first_of_corner_;
  std::uint8_t* is_first_;
  Array<std::uint32_t> table_;  ///< numbers of unique_, from 1; 0: free
  Array<Record> unique_;
};

/// Numbers the first corners in order, and gives every corner the number of its first.
Array<glm::vec3> number_vertices(std::span<const glm::vec3> corners, Array<std::uint32_t>& vertex_of_corner,
                                 const Array<std::uint8_t>& is_first, const Run& run) {
  std::vector<std::size_t> next((corners.size() + kChunk - 1) / kChunk);
  parallel_for(corners.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += is_first[i];
    next[begin / kChunk] = count;
  });
  std::size_t total = 0;
  for (std::size_t& each : next) total += std::exchange(each, total);
  Array<glm::vec3> positions(total);
  parallel_for(corners.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    std::size_t vertex = next[begin / kChunk];
    for (std::size_t i = begin; i < end; ++i) {
      if (is_first[i] == 0) continue;
      positions[vertex] = corners[i];
      vertex_of_corner[i] = static_cast<std::uint32_t>(vertex++);
    }
  });
  parallel_for(corners.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_first[i] == 0) vertex_of_corner[i] = vertex_of_corner[vertex_of_corner[i]];
    }
  });
  return positions;
}

}  // namespace

std::uint64_t position_hash(const glm::vec3& position) {
  const auto bits = [](float value) { return std::uint64_t{std::bit_cast<std::uint32_t>(value + 0.0F)}; };  // -0 to 0
  std::uint64_t hash = (bits(position.x) | bits(position.y) << 32) * 0x9E3779B97F4A7C15;
  hash = ((hash ^ hash >> 32) + bits(position.z)) * 0xD6E8FEB86659FD93;
  return hash ^ hash >> 29;
}

Welded weld_exactly(std::span<const glm::vec3> corners, const Run& run) {
  assert(corners.size() < 0xFFFFFFFF);
  Welded result;
  result.corners.resize(corners.size());
  Array<std::uint8_t> is_first(corners.size());
  {
    Parts parts(corners, run);
    std::vector<FirstCorners> finders(static_cast<std::size_t>(thread_count(run)),
                                      FirstCorners(result.corners.data(), is_first.data()));
    parallel_tasks(parts.size(), run,
                   [&](std::size_t part, int worker) { finders[static_cast<std::size_t>(worker)].find(parts[part]); });
  }
  result.positions = number_vertices(corners, result.corners, is_first, run);
  return result;
}

}  // namespace azulejo
