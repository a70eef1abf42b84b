#include "azulejo/io/text_rows.h"

#include <utility>

namespace azulejo {

std::vector<std::uint64_t> first_rows(const TextPieces& file, char comment, const Run& run) {
  std::vector<std::uint64_t> rows(file.size() + 1);
  file.for_each(run, [&](const TextPiece& piece, int) {
    std::uint64_t count = 0;
    for (const char* next = behind_space(piece.begin); next != piece.end; next = behind_space(next)) {
      if (comment == '\0' || *next != comment) ++count;
      next = end_of_line(next, piece.end);
    }
    rows[piece.index] = count;
  });
  std::uint64_t total = 0;
  for (std::uint64_t& each : rows) total += std::exchange(each, total);
  return rows;
}

}  // namespace azulejo
