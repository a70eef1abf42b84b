#include "azulejo/engine/graph.h"

#include <cassert>

namespace azulejo {

ValueRef Graph::add_source(std::shared_ptr<ImageSource> source, std::string label) {
  Vertex vertex;
  vertex.label = std::move(label);
  vertex.source_info = source->info();
  if (const Image* image = source->image()) vertex.pixels = image->any();
  vertex.source = std::move(source);
  vertices_.push_back(std::move(vertex));
  return {static_cast<int>(vertices_.size()) - 1, 0};
}

ValueRef Graph::add_source(const ConstAnyView& pixels, std::string label) {
  Vertex vertex;
  vertex.label = std::move(label);
  vertex.source_info = pixels.info;
  vertex.pixels = pixels;
  vertices_.push_back(std::move(vertex));
  return {static_cast<int>(vertices_.size()) - 1, 0};
}

ValueRef Graph::add_node(std::unique_ptr<TileNode> node, std::vector<ValueRef> sources, std::string label,
                         std::vector<std::string> result_names) {
  assert(result_names.size() == node->results().size());
  Vertex vertex;
  vertex.label = std::move(label);
  vertex.node = std::move(node);
  vertex.sources = std::move(sources);
  vertex.result_names = std::move(result_names);
  vertices_.push_back(std::move(vertex));
  return {static_cast<int>(vertices_.size()) - 1, 0};
}

const ImageInfo& Graph::info(ValueRef value) const {
  const Vertex& vertex = vertices_[static_cast<std::size_t>(value.vertex)];
  return vertex.node ? vertex.node->results()[static_cast<std::size_t>(value.output)] : vertex.source_info;
}

}  // namespace azulejo
