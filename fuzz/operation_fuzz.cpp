// Every operation with any options on small images of any kind, or on small meshes. The first bytes choose the image
// or the mesh, the rest is the text of stages, separated by spaces: they give a result or an Error.
#include <cstddef>
#include <cstdint>
#include <string>

#include "azulejo/core/error.h"
#include "azulejo/pipeline.h"

namespace {

using namespace azulejo;

Image image_from(const std::uint8_t* data, std::size_t size) {
  const int channels = 1 + data[0] % 4;
  const ImageInfo info{1 + data[1] % 40,
                       1 + data[2] % 40,
                       channels,
                       static_cast<PixelType>(data[3] % 3),
                       static_cast<ColorState>(data[3] / 3 % 3),
                       channels % 2 == 0 ? static_cast<AlphaState>(data[3] / 9 % 3) : AlphaState::None};
  Image image(info);
  for (int y = 0; y < info.height; ++y) {
    for (std::size_t i = 0; i < info.row_bytes(); ++i) {
      image.any().row(y)[i] = static_cast<std::byte>(data[(i + static_cast<std::size_t>(y) * 7) % size]);
    }
  }
  return image;
}

/// Any coordinates, and faces of up to 7 corners.
Mesh mesh_from(const std::uint8_t* data, std::size_t size) {
  const auto at = [&](std::size_t i) { return data[i % size]; };
  Mesh mesh;
  mesh.positions.resize(1U + data[1] % 40U);
  auto* bytes = reinterpret_cast<std::uint8_t*>(mesh.positions.data());
  for (std::size_t i = 0; i < mesh.positions.size() * sizeof(glm::vec3); ++i) bytes[i] = at(3 * i + 1);
  if (data[3] % 2 == 0) {
    for (glm::vec3& position : mesh.positions) position = glm::vec3(at(1), at(2), bytes[0]) / 16.0F;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i].x += at(5 * i) / 8.0F;
  }
  mesh.face_offsets.push_back(0);
  for (std::size_t face = 0; face < data[2] % 60U; ++face) {
    for (unsigned corner = 0; corner < at(face) % 8U; ++corner) {
      mesh.corners.push_back(at(11 * face + corner) % static_cast<std::uint32_t>(mesh.positions.size()));
    }
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 4) return 0;
  Run run;
  run.threads = 1;
  run.limits.pixels = 1 << 16;
  run.limits.memory_bytes = 1 << 24;
  try {
    Pipeline pipeline(run);
    pipeline.add_value(data[0] < 128 ? Value(image_from(data, size)) : Value(mesh_from(data, size)), "fuzz");
    pipeline.add_stage("as:start");
    const std::string text(reinterpret_cast<const char*>(data) + 4, size - 4);
    std::size_t begin = 0;
    for (int stages = 0; stages < 4 && begin < text.size(); ++stages) {
      const std::size_t end = std::min(text.find(' ', begin), text.size());
      const std::string stage = text.substr(begin, end - begin);
      // Arguments may name files: only named values are wanted here.
      if (stage.find("=/") == std::string::npos && stage.find("=.") == std::string::npos) pipeline.add_stage(stage);
      begin = end + 1;
    }
    pipeline.explain();
    pipeline.compute();
  } catch (const Error&) {
    // What a caller gets who asks for the impossible.
  }
  return 0;
}
