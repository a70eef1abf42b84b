#pragma once

#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// Writes a drawing as SVG 1.1 (vector-effect, fr and aria-label are of SVG 2). Same bytes for any thread count.
///
/// Numbers  the shortest that are read as the same float; what is not finite leaves its segment out. Colors have 8 bits
///          a channel, alpha is kept
/// Groups   as they are; one without an id around a single path becomes attributes of the path
/// Styles   attributes; a class for what many paths share. A style's opacity goes into its paints where there are two
/// Patterns gradients as they are; hatches and stipples as patterns, a stipple's pixel being a unit of the path
/// Points   shapes in a path of their own, whose size is right at one pixel a unit of the page (96 an inch)
/// Texts    outlines with an aria-label; as <text> with options.svg_text
/// Ids      made valid and unique
/// Clips    groups in clips become attributes of their paths. Throws Error(Unsupported) for a path in a clip that two
///          further clips cut
/// Cost     O(commands + items); beyond the drawing a few MB, and the ids
void write_svg(Output& output, const Drawing& drawing, const ModelWriteOptions& options, const Run& run);

}  // namespace azulejo
