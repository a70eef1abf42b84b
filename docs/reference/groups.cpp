#include "groups.h"

#include <algorithm>

#include <fmt/format.h>

#include "azulejo/operations.h"

namespace azulejo::reference {

std::span<const Group> groups() {
  static const std::vector<Group> list{
      {"Acquisition",
       "What happens to a scene on its way into numbers: sampling, quantization, noise.",
       {"noise", "quantize", "sample", "test_pattern", "time_sample"}},
      {"Points",
       "Each value by itself.",
       {"brightness_contrast", "contrast_stretch", "exposure", "gamma", "invert", "level_slice", "lut", "posterize",
        "threshold"}},
      {"Color",
       "Channels, spaces, colors for what has none.",
       {"channels", "color_space", "convert", "false_color", "grayscale", "pseudo_color"}},
      {"Histograms",
       "How often values occur, and what follows from that.",
       {"clahe", "equalize", "histogram", "match_histogram", "statistics"}},
      {"Arithmetic",
       "Several images, pixel by pixel.",
       {"add", "blend", "difference", "divide", "mask", "multiply", "subtract"}},
      {"Smoothing", "Less noise, less detail.", {"bilateral", "box", "gaussian", "median", "weighted_median"}},
      {"Sharpening and edges",
       "What smoothing would take away.",
       {"high_boost", "high_pass", "laplacian", "sobel", "unsharp_mask"}},
      {"Any kernel",
       "Weights of your own, and what they do to frequencies.",
       {"convolve", "frequency_filter", "kernel_response", "spectrum"}},
      {"Geometry", "Which pixels, and how many; what is where.", {"crop", "pad", "resize", "transform"}},
      {"Selected areas", "Only a part of the image.", {"within"}},
      {"Comparing", "How far two images are apart.", {"compare"}},
      {"Charts",
       "Numbers become pictures, and pictures say what is in them.",
       {"annotate", "chart", "color_by", "glyphs"}},
      {"Modelling", "Models that are made.", {"height_field", "primitive", "surface"}},
      {"Drawing", "Pictures of lines and curves.", {"curve", "draw"}},
      {"Polygons",
       "What drawings fill: triangles, parts, unions, distances, inside and outside.",
       {"classify_points", "clip", "offset", "path_boolean", "tessellate"}},
      {"Inspecting models",
       "What a model is, before it is trusted.",
       {"distance", "measure", "topology", "winged_edge"}},
      {"Meshes",
       "Surfaces are mended, made finer and coarser, smoothed.",
       {"convex_hull", "decimate", "normals", "repair", "sample_points", "smooth", "subdivide", "tangents", "weld"}},
      {"Rendering", "Models become images.", {"render", "wireframe"}},
  };
  return list;
}

std::vector<std::string> faults_of_groups() {
  std::vector<std::string> faults;
  std::vector<std::string> listed;
  for (const Group& group : groups()) listed.insert(listed.end(), group.operations.begin(), group.operations.end());
  for (const std::string& name : listed) {
    if (find_operation(name) == nullptr)
      faults.push_back(fmt::format("docs/reference/groups.cpp: {}: no such operation", name));
  }
  for (const Operation* operation : operations()) {
    const auto count = std::count(listed.begin(), listed.end(), operation->name);
    if (count != 1) {
      faults.push_back(
          fmt::format("docs/reference/groups.cpp: {}: in {} groups, expected one", operation->name, count));
    }
  }
  return faults;
}

}  // namespace azulejo::reference
