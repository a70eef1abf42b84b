// The topology of real files, beside what another program counted: the tables of the folder's README.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/io/model_io.h"
#include "azulejo/modelling/flatten.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {
namespace {

const std::filesystem::path kData = AZULEJO_SOURCE_FOLDER "/../shared/data";

/// A row of a table.
struct Known {
  std::string path;
  std::string said;  ///< "components 1, boundary edges 0, non-manifold edges 0, Euler 2, closed genus 0"

  /// The number behind a word.
  std::optional<long> number(const std::string& word) const {
    const std::size_t at = said.find(word + " ");
    if (at == std::string::npos) return std::nullopt;
    return std::stol(said.substr(at + word.size() + 1));
  }
};

std::vector<Known> known_meshes() {
  std::vector<Known> list;
  std::ifstream readme(kData / "README.md");
  std::string folder;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("## ")) folder = line.substr(3);
    if (!folder.starts_with("meshes/") || !line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    for (std::size_t at = 1, end = 0; (end = line.find('|', at)) != std::string::npos; at = end + 1) {
      const std::string cell = line.substr(at, end - at);
      const std::size_t first = cell.find_first_not_of(' ');
      cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    if (cells.size() > 3 && cells[2].find("Euler") != std::string::npos) {
      list.push_back({folder + "/" + cells[0], cells[2]});
    }
  }
  return list;
}

/// What is counted otherwise here, and why.
struct Otherwise {
  const char* said;
  const char* why;
  bool agrees_by_position;
};
const std::map<std::string, Otherwise>& otherwise() {
  static const std::map<std::string, Otherwise> list = {
      {"meshes/multishell/joined_tetrahedra.obj",
       {"components 2, boundary edges 0, non-manifold edges 0, Euler 4",
        "its two objects are two meshes, which have no vertex in common", true}},
      {"meshes/multishell/groups.obj",
       {"components 2, boundary edges 18, non-manifold edges 0, Euler 2",
        "its two groups are two meshes, which have no vertex in common", true}},
      {"meshes/broken/deg_faces.obj",
       {"components 1, boundary edges 5, non-manifold edges 0, Euler 1",
        "a face that names a vertex twice is none, and has no edges", false}},
  };
  return list;
}

Mesh mesh_of_file(const std::string& path) {
  Model model = read_model(path);
  if (auto* const mesh = std::get_if<Mesh>(&model)) return std::move(*mesh);
  return flatten(std::get<Scene>(model));
}

std::string counted(const Topology& found) {
  std::string text = "components " + std::to_string(found.components) + ", boundary edges " +
                     std::to_string(found.count(MeshFaultKind::BorderEdge)) + ", non-manifold edges " +
                     std::to_string(found.count(MeshFaultKind::SingularEdge)) + ", Euler " +
                     std::to_string(found.euler());
  return text;
}

TEST(TopologyOfFiles, IsWhatTheirTablesSay) {
  if (!std::filesystem::exists(kData / "README.md")) GTEST_SKIP() << "absent: " << kData;
  const std::vector<Known> known = known_meshes();
  const auto agrees = [](const Topology& found, const Known& wanted) {
    return wanted.said.substr(0, counted(found).size()) == counted(found);
  };
  EXPECT_GT(known.size(), 70U) << "the tables are read";
  std::size_t differing = 0;
  for (const Known& each : known) {
    SCOPED_TRACE(each.path);
    const Mesh mesh = mesh_of_file((kData / each.path).string());
    const Topology found = topology(mesh);
    if (const auto other = otherwise().find(each.path); other != otherwise().end()) {
      ++differing;
      EXPECT_EQ(counted(found), other->second.said) << other->second.why;
      EXPECT_EQ(agrees(topology(mesh, {.by_position = true}), each), other->second.agrees_by_position);
      continue;
    }
    EXPECT_TRUE(agrees(found, each)) << counted(found) << "; expected " << each.said;
    if (const std::optional<long> genus = each.number("closed genus"); genus && found.genus()) {
      EXPECT_EQ(static_cast<long>(*found.genus()), *genus);
    }
    EXPECT_EQ(found.euler_poincare().value_or(0), 0);
  }
  EXPECT_EQ(differing, otherwise().size());
}

}  // namespace
}  // namespace azulejo
