#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "azulejo/data/mesh.h"
#include "azulejo/io/model_io.h"
#include "harness.h"

/// Rows that read model files beside assimp. Every format has a row with a generated sphere; models that people have
/// come from a folder beside the project's, and their rows are left out where it is absent.
namespace azulejo::bench {

/// Gives the path of a file, which is made if it has to be.
using ModelFileMaker = std::function<std::string()>;

/// A closed unit sphere of 4·n² triangles, the whole n that gives about as many as are asked for: rings of latitude,
/// vertices shared.
Mesh sphere(std::size_t triangles);

/// That sphere with a million triangles in the format of an ending, in a temporary folder that goes with the process.
ModelFileMaker sphere_file(const std::string& ending, const ModelWriteOptions& options = {});

/// A file of the folder beside the project's, "meshes/off/camel.off". The first that is missing is told on standard
/// error, in one line for all.
std::optional<std::string> shared_model(const std::string& path);

/// How much assimp does beside reading. It works on one thread, whatever the row asks for.
enum class AssimpWork {
  Import,  ///< the triangles as its importer leaves them, mostly with vertices of their own
  Join     ///< its normals removed, then vertices joined that are equal
};

struct ReadRow {
  std::string name;  ///< "read STL, binary, as soup, sphere of 1 M triangles"
  ModelFileMaker file;
  ModelReadOptions options = {};
  AssimpWork peer = AssimpWork::Import;
  double aim = 5;
  double aim_seconds = 0;
};

/// Adds a row in megabytes of the file a second; right if both find the same number of faces. The limit is a copy of
/// the file into what is made of it.
void add_read_row(Bench& bench, ReadRow row);
/// The same with a model of the shared folder; nothing where that is absent.
void add_shared_read_row(Bench& bench, const std::string& name, const std::string& path,
                         const ModelReadOptions& options = {});

}  // namespace azulejo::bench
