#pragma once

// What the tests of SVG share.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/io/input.h"
#include "azulejo/io/output.h"
#include "azulejo/io/svg_read.h"
#include "azulejo/io/svg_write.h"

namespace azulejo {

struct SvgRead {
  Drawing drawing;
  std::vector<std::string> warnings;
};

/// Reads a whole file, and checks what a reader promises.
inline SvgRead svg_file(const std::string& text, Run run = {}) {
  SvgRead result;
  run.threads = 1;
  run.warn = [&](const std::string& line) { result.warnings.push_back(line); };
  result.drawing = read_svg(*memory_input(std::as_bytes(std::span(text)), "test.svg"), run);
  result.drawing.check("test.svg");
  return result;
}

/// Reads elements in an svg of 100 × 50 pixels.
inline SvgRead svg_elements(const std::string& elements) {
  return svg_file(
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='100' "
      "height='50'>" +
      elements + "</svg>");
}

inline std::string svg_text(const Drawing& drawing, const ModelWriteOptions& options = {}, int threads = 1) {
  std::vector<std::byte> bytes;
  Run run;
  run.threads = threads;
  write_svg(*memory_output(bytes, "test.svg"), drawing, options, run);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The style of a drawing's path.
inline const DrawingStyle& style_of(const Drawing& drawing, std::size_t path = 0) {
  return drawing.styles.at(drawing.paths.at(path).style);
}

}  // namespace azulejo
