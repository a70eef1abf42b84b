#include "stage_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/text_file.h"

namespace azulejo::cli {
namespace {

struct Extrema {
  float minimum = std::numeric_limits<float>::infinity();
  float maximum = -std::numeric_limits<float>::infinity();
};

Extrema extrema(const ImageView<const float>& view) {
  Extrema found;
  for (int y = 0; y < view.height; ++y) {
    for (int i = 0; i < view.width * view.channels; ++i) {
      const float value = view.row(y)[i];
      if (!std::isfinite(value)) continue;
      found.minimum = std::min(found.minimum, value);
      found.maximum = std::max(found.maximum, value);
    }
  }
  return found;
}

}  // namespace

StageFolder::StageFolder(std::string folder) : folder_(std::move(folder)) {
  std::error_code failure;
  std::filesystem::create_directories(folder_, failure);
  if (failure) throw Error(Error::Io, fmt::format("{}: {}", folder_, failure.message()));
}

void StageFolder::image(const std::string& step, const std::string& name, const Image& image) {
  const std::string file = fmt::format("{}-{}.png", step, name);
  Json entry = Json::object();
  entry.set("step", step).set("name", name).set("file", file);
  entry.set("width", image.width())
      .set("height", image.height())
      .set("channels", image.channels())
      .set("type", to_string(image.type()));
  WriteOptions options;
  if (image.type() == PixelType::F32) {
    const Extrema found = extrema(image.view<float>());
    entry.set("black", found.minimum).set("white", found.maximum);
    options.normalize = true;
  }
  write_image(image, folder_ + "/" + file, options);
  list_.push(entry);
}

void StageFolder::mesh(const std::string& step, const std::string& name, const Mesh& mesh) {
  const std::string file = fmt::format("{}-{}.ply", step, name);
  write_model(mesh, folder_ + "/" + file);
  list_.push(Json::object()
                 .set("step", step)
                 .set("name", name)
                 .set("file", file)
                 .set("vertices", static_cast<std::uint64_t>(mesh.vertex_count()))
                 .set("faces", static_cast<std::uint64_t>(mesh.face_count())));
}

void StageFolder::drawing(const std::string& step, const std::string& name, const Drawing& drawing) {
  const std::string file = fmt::format("{}-{}.svg", step, name);
  write_model(drawing, folder_ + "/" + file);
  list_.push(Json::object()
                 .set("step", step)
                 .set("name", name)
                 .set("file", file)
                 .set("paths", static_cast<std::uint64_t>(drawing.paths.size())));
}

void StageFolder::report(const std::string& step, const std::string& name, const Json& report) {
  const std::string file = fmt::format("{}-{}.json", step, name);
  write_text_file(folder_ + "/" + file, report.dump() + "\n");
  list_.push(Json::object().set("step", step).set("name", name).set("file", file));
}

void StageFolder::finish() { write_text_file(folder_ + "/stages.json", list_.dump() + "\n"); }

}  // namespace azulejo::cli
