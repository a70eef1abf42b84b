#include <algorithm>

#include <fmt/format.h>

#include "azulejo/core/parallel.h"
#include "azulejo/engine/graph.h"
#include "azulejo/engine/plan.h"

namespace azulejo {
namespace {

std::string megabytes(double bytes) { return fmt::format("{:.1f} MB", bytes / 1e6); }

std::string name_of(const Graph& graph, ValueRef value) {
  const Graph::Vertex& vertex = graph.vertices()[static_cast<std::size_t>(value.vertex)];
  if (!vertex.node || vertex.result_names.size() == 1) return vertex.label;
  return vertex.label + "." + vertex.result_names[static_cast<std::size_t>(value.output)];
}

void explain_root(std::string& text, const Graph& graph, std::span<const Target> targets, const Root& root,
                  const Run& run, double& held) {
  const std::string name = name_of(graph, root.value);
  for (const Root::Analysis& analysis : root.analyses) {
    text += fmt::format("  {} is analysed for {}\n", name,
                        graph.vertices()[static_cast<std::size_t>(analysis.vertex)].label);
  }
  if (root.resident) {
    const auto bytes = static_cast<double>(image_bytes(graph.info(root.value)));
    const bool fits = held + bytes <= static_cast<double>(run.limits.memory_bytes);
    if (fits) held += bytes;
    text +=
        fmt::format("  {} is kept whole: {} {}\n", name, megabytes(bytes), fits ? "in memory" : "in a temporary file");
  }
  for (const int t : root.targets) {
    text += fmt::format("  {} is {}\n", name,
                        targets[static_cast<std::size_t>(t)].sink != nullptr ? "written by bands" : "a result");
  }
}

}  // namespace

std::string explain(const Graph& graph, std::span<const Target> targets, const Run& run) {
  const Plan plan = make_plan(graph, targets, run);
  std::string text;
  double held = 0;
  int pass = 0;
  for (const Group& group : plan.groups) {
    text += fmt::format("pass {}: ", ++pass);
    if (group.nodes.empty()) text += "copy";
    for (std::size_t n = 0; n < group.nodes.size(); ++n) {
      text += fmt::format("{}{}", n > 0 ? " + " : "", graph.vertices()[static_cast<std::size_t>(group.nodes[n])].label);
    }
    text += fmt::format(" at {}×{}, tiles {}×{}", group.width, group.height, group.tile_width, group.tile_height);
    if (group.band_height < group.height) text += fmt::format(", bands of {} rows", group.band_height);
    text += fmt::format(", {} thread{}\n", thread_count(run), thread_count(run) == 1 ? "" : "s");

    std::vector<Rect> required;
    propagate(graph, plan, group, {0, 0, group.tile_width, group.tile_height}, required);
    double tile = 0;
    for (const int v : group.nodes) {
      const auto& node = *graph.vertices()[static_cast<std::size_t>(v)].node;
      for (int o = 0; o < static_cast<int>(node.results().size()); ++o) {
        tile += static_cast<double>(required[plan.index({v, o})].area()) *
                static_cast<double>(graph.info({v, o}).pixel_bytes());
      }
    }
    text += fmt::format("  intermediates and results of a tile: {}\n", megabytes(tile));
    double bands = 0;
    for (const ValueRef file : group.files) {
      propagate(graph, plan, group, {0, 0, group.width, group.band_height}, required);
      const double bytes = 2.0 * required[plan.index(file)].height * static_cast<double>(graph.info(file).row_bytes());
      bands += bytes;
      text += fmt::format("  {} is read by bands\n", graph.vertices()[static_cast<std::size_t>(file.vertex)].label);
    }
    for (const Root& root : group.roots) {
      for (const int t : root.targets) {
        if (targets[static_cast<std::size_t>(t)].sink != nullptr) {
          bands += 2.0 * group.band_height * static_cast<double>(graph.info(root.value).row_bytes());
        }
      }
      explain_root(text, graph, targets, root, run, held);
    }
    if (bands > 0) text += fmt::format("  bands in memory: {}\n", megabytes(bands));
  }
  return text;
}

}  // namespace azulejo
