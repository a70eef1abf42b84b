#include "models.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "azulejo/core/error.h"

namespace azulejo::bench {
namespace {

constexpr std::size_t kTriangles = 1'000'000;

/// A folder of this process, removed when it ends.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(std::filesystem::temp_directory_path() / ("azulejo_bench_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

const TemporaryFolder& temporary_folder() {
  static const TemporaryFolder folder;
  return folder;
}

/// What a model is made of, without the attributes and images.
struct ModelSize {
  std::size_t faces = 0;
  std::size_t bytes = 0;
};

ModelSize size_of(const Mesh& mesh) {
  return {mesh.face_count(), mesh.positions.size() * sizeof(glm::vec3) +
                                 (mesh.corners.size() + mesh.face_offsets.size()) * sizeof(std::uint32_t)};
}

ModelSize size_of(const Scene& scene) {
  ModelSize sum;
  for (const auto& mesh : scene.meshes) {
    const ModelSize size = size_of(*mesh);
    sum.faces += size.faces;
    sum.bytes += size.bytes;
  }
  return sum;
}

ModelSize size_of(const Volume&) { return {}; }
ModelSize size_of(const Drawing&) { return {}; }

ModelSize size_of(const Model& model) {
  return std::visit([](const auto& value) { return size_of(value); }, model);
}

/// assimp's import of a file, its memory given back at the end as ours is.
class AssimpReader {
 public:
  explicit AssimpReader(AssimpWork work) {
    if (work == AssimpWork::Import) return;
    importer_.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS);
    steps_ = aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices;
  }

  /// Returns the number of faces.
  std::size_t read(const std::string& path) {
    const aiScene* const scene = importer_.ReadFile(path, steps_);
    if (scene == nullptr) throw Error(Error::Data, "assimp: " + std::string(importer_.GetErrorString()));
    std::size_t faces = 0;
    for (unsigned int i = 0; i < scene->mNumMeshes; ++i) faces += scene->mMeshes[i]->mNumFaces;
    importer_.FreeScene();
    return faces;
  }

 private:
  Assimp::Importer importer_;
  unsigned int steps_ = 0;
};

Row read_row(const ReadRow& what) {
  struct Found {
    std::size_t ours = 0;
    std::size_t peer = 0;
  };
  const std::string path = what.file();
  const auto found = std::make_shared<Found>();
  const auto reader = std::make_shared<AssimpReader>(what.peer);
  const auto file_bytes = static_cast<std::size_t>(std::filesystem::file_size(path));

  Row row;
  row.work = static_cast<double>(file_bytes);
  row.unit = "MB/s";
  row.ours = [=, options = what.options](int threads) {
    found->ours = size_of(read_model(path, options, Run{.threads = threads})).faces;
  };
  row.peer_name = what.peer == AssimpWork::Join ? "assimp, joining vertices" : "assimp";
  row.peer = [=](int) { found->peer = reader->read(path); };
  row.limit = copy_limit(file_bytes, size_of(read_model(path, what.options)).bytes);
  row.check = [=]() -> Check {
    return {found->ours == found->peer && found->ours > 0,
            std::to_string(found->ours) + " faces, the peer's " + std::to_string(found->peer)};
  };
  row.aim = what.aim;
  row.aim_seconds = what.aim_seconds;
  return row;
}

}  // namespace

Mesh sphere(std::size_t triangles) {
  // 2n slices; n + 1 stacks, of which the two at the poles have half the triangles.
  const auto n =
      std::max<std::size_t>(2, static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles) / 4) + 0.5));
  const std::size_t slices = 2 * n;
  Mesh mesh;
  mesh.name = "sphere";
  mesh.positions.reserve(slices * n + 2);
  mesh.corners.reserve(3 * 4 * n * n);
  mesh.positions.emplace_back(0, 1, 0);
  for (std::size_t ring = 1; ring <= n; ++ring) {
    const double polar = std::numbers::pi * static_cast<double>(ring) / static_cast<double>(n + 1);
    for (std::size_t slice = 0; slice < slices; ++slice) {
      const double around = 2 * std::numbers::pi * static_cast<double>(slice) / static_cast<double>(slices);
      mesh.positions.emplace_back(std::sin(polar) * std::sin(around), std::cos(polar),
                                  std::sin(polar) * std::cos(around));
    }
  }
  mesh.positions.emplace_back(0, -1, 0);

  const auto vertex = [&](std::size_t ring, std::size_t slice) {  // rings from 0; the slice after the last is the first
    return static_cast<std::uint32_t>(1 + ring * slices + slice % slices);
  };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.corners.insert(mesh.corners.end(), {a, b, c});
  };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::size_t slice = 0; slice < slices; ++slice) add(0, vertex(0, slice), vertex(0, slice + 1));
  for (std::size_t ring = 0; ring + 1 < n; ++ring) {
    for (std::size_t slice = 0; slice < slices; ++slice) {
      add(vertex(ring, slice), vertex(ring + 1, slice), vertex(ring + 1, slice + 1));
      add(vertex(ring, slice), vertex(ring + 1, slice + 1), vertex(ring, slice + 1));
    }
  }
  for (std::size_t slice = 0; slice < slices; ++slice) add(last, vertex(n - 1, slice + 1), vertex(n - 1, slice));
  return mesh;
}

ModelFileMaker sphere_file(const std::string& ending, const ModelWriteOptions& options) {
  return [=] {
    const std::string name = std::string(options.ascii ? "sphere_ascii." : "sphere.") + ending;
    const std::string path = (temporary_folder().path() / name).string();
    if (!std::filesystem::exists(path)) write_model(sphere(kTriangles), path, options);
    return path;
  };
}

std::optional<std::string> shared_model(const std::string& path) {
  static bool told = false;
  const std::filesystem::path file = std::filesystem::path(AZULEJO_SOURCE_FOLDER) / "../shared/data" / path;
  if (std::filesystem::exists(file)) return file.lexically_normal().string();
  if (!told) std::fprintf(stderr, "%s is absent: rows with shared models are left out\n", file.c_str());
  told = true;
  return std::nullopt;
}

void add_read_row(Bench& bench, ReadRow row) {
  std::string name = row.name;
  bench.row(std::move(name), [row = std::move(row)] { return read_row(row); });
}

void add_shared_read_row(Bench& bench, const std::string& name, const std::string& path,
                         const ModelReadOptions& options) {
  const std::optional<std::string> file = shared_model(path);
  if (file) add_read_row(bench, {.name = name, .file = [file] { return *file; }, .options = options});
}

}  // namespace azulejo::bench
