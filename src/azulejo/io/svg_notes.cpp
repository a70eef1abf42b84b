#include "azulejo/io/svg_notes.h"

#include <fmt/format.h>

namespace azulejo {

void SvgNotes::add(Counts& counts, std::string_view kind) {
  for (auto& [name, count] : counts) {
    if (name == kind) {
      ++count;
      return;
    }
  }
  counts.emplace_back(kind, 1);
}

void SvgNotes::tell(const std::string& file, const Run& run) const {
  const auto times = [](std::size_t count) { return count == 1 ? std::string() : fmt::format(" ({} times)", count); };
  for (const auto& [name, count] : left_out_) warn(run, fmt::format("{}: left out: {}{}", file, name, times(count)));
  for (const auto& [name, count] : wrong_) warn(run, fmt::format("{}: {}{}", file, name, times(count)));
}

}  // namespace azulejo
