#include "azulejo/rendering/edge_chains.h"

#include <cstddef>

namespace azulejo {
namespace {

using Edges = std::span<const std::pair<std::uint32_t, std::uint32_t>>;

class Chains {
 public:
  Chains(Edges edges, std::size_t vertices, std::size_t longest)
      : edges_(edges), longest_(longest), next_(vertices + 1, 0), used_(edges.size(), false) {
    for (const auto& [a, b] : edges) {
      ++next_[a + 1];
      ++next_[b + 1];
    }
    for (std::size_t v = 0; v < vertices; ++v) next_[v + 1] += next_[v];
    end_.assign(next_.begin() + 1, next_.end());
    at_.resize(2 * edges.size());
    Array<std::uint32_t> place(next_.begin(), next_.end() - 1);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      at_[place[edges[e].first]++] = e;
      at_[place[edges[e].second]++] = e;
    }
  }

  EdgeChains take_all() {
    result_.vertices.reserve(edges_.size() + edges_.size() / 4);
    result_.first.push_back(0);
    const std::size_t vertices = end_.size();
    for (std::uint32_t v = 0; v < vertices; ++v) {
      if ((end_[v] - next_[v]) % 2 == 1) walk(v);  // one line ends here: what is left is even
    }
    for (std::uint32_t v = 0; v < vertices; ++v) {
      while (unused(v)) walk(v);
    }
    return std::move(result_);
  }

 private:
  bool unused(std::uint32_t vertex) {
    while (next_[vertex] < end_[vertex] && used_[at_[next_[vertex]]]) ++next_[vertex];
    return next_[vertex] < end_[vertex];
  }

  /// Goes along unused edges until there is none.
  void walk(std::uint32_t vertex) {
    if (!unused(vertex)) return;
    result_.vertices.push_back(vertex);
    std::size_t length = 0;
    while (unused(vertex)) {
      if (length++ == longest_) {
        result_.first.push_back(result_.vertices.size());
        result_.vertices.push_back(vertex);
        length = 1;
      }
      const std::uint32_t edge = at_[next_[vertex]++];
      used_[edge] = true;
      vertex = edges_[edge].first == vertex ? edges_[edge].second : edges_[edge].first;
      result_.vertices.push_back(vertex);
    }
    result_.first.push_back(result_.vertices.size());
  }

  Edges edges_;
  std::size_t longest_;
  Array<std::uint32_t> next_;  ///< of each vertex, the first of its edges that may be unused, in `at_`
  Array<std::uint32_t> end_;
  Array<std::uint32_t> at_;  ///< the edges at each vertex
  std::vector<bool> used_;
  EdgeChains result_;
};

}  // namespace

EdgeChains edge_chains(Edges edges, std::size_t vertices, std::size_t longest) {
  return Chains(edges, vertices, longest).take_all();
}

}  // namespace azulejo
