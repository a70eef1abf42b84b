#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "azulejo/core/run.h"

namespace azulejo {

/// What of an SVG is left out, by kind.
class SvgNotes {
 public:
  /// "text"
  void left_out(std::string_view kind) { add(left_out_, kind); }
  /// "path data ends with an error"
  void wrong(std::string_view what) { add(wrong_, what); }
  /// One warning a kind: "drawing.svg: left out: text (2 times)".
  void tell(const std::string& file, const Run& run) const;

 private:
  using Counts = std::vector<std::pair<std::string, std::size_t>>;
  static void add(Counts& counts, std::string_view kind);

  Counts left_out_;
  Counts wrong_;
};

}  // namespace azulejo
