#pragma once

#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// Reads an SVG as a drawing.
///
/// Page     in millimetres if the file's size is in mm, cm or in, else in pixels of 1/96 inch. A file that tells neither
///          size nor viewBox has the size of what it shows
/// Groups   g, a, switch (its first child that can be shown), use, nested svg and symbols become groups; so does a shape
///          with a transformation, a clip, or an opacity over both fill and stroke. What the root's viewBox does is a
///          group, too, where it does anything
/// Left out text, images, filters, masks, patterns, markers, animation, selectors of several steps: one warning a kind
/// Limits   elements in 1000 others; 10⁶ elements, or 256 MiB of their attributes, made by `use` and measured clips;
///          2·10⁸ comparisons of selectors; run.limits.memory_bytes
/// Names no other files; what refers to others is left out.
/// Throws   Error(Data) naming the line, Error(Resource)
/// Source   SVG 1.1 (second edition); of SVG 2: href, fr, opacity in percent
Drawing read_svg(const Input& input, const Run& run);

}  // namespace azulejo
