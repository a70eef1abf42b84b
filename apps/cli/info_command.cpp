#include "info_command.h"

#include <cstdio>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/json.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/input.h"
#include "azulejo/io/model_io.h"
#include "azulejo/modelling/model_info.h"
#include "azulejo/modelling/scene_tree.h"

namespace azulejo::cli {
namespace {

Json as_json(const std::string& path, const ImageFile& file) {
  Json json = Json::object();
  json.set("azulejo", AZULEJO_VERSION).set("operation", "info").set("file", path).set("format", file.format);
  json.set("width", file.info.width).set("height", file.info.height).set("channels", file.info.channels);
  json.set("type", to_string(file.info.type))
      .set("color", to_string(file.info.color))
      .set("alpha", to_string(file.info.alpha));
  json.set("stored_width", file.stored_width).set("stored_height", file.stored_height).set("bits", file.bits);
  json.set("encoding", file.encoding)
      .set("pages", file.pages)
      .set("orientation", file.orientation)
      .set("streamed", file.streamed);
  json.set("profile", file.profile.empty() ? Json() : Json(file.profile));
  json.set("density_x", file.metadata.density_x > 0 ? Json(file.metadata.density_x) : Json());
  json.set("density_y", file.metadata.density_y > 0 ? Json(file.metadata.density_y) : Json());
  json.set("exif_bytes", static_cast<std::int64_t>(file.metadata.exif.size()))
      .set("xmp_bytes", static_cast<std::int64_t>(file.metadata.xmp.size()));
  Json layers = Json::array();
  for (const std::string& layer : file.layers) layers.push(layer);
  Json text = Json::object();
  for (const auto& [name, value] : file.metadata.text) text.set(name, value);
  return json.set("layers", layers).set("text", text);
}

std::string as_text(const std::string& path, const ImageFile& file) {
  std::string text = fmt::format("{}\n  {}", path, describe(file.info));
  text += fmt::format("\n  {}, {} bits a channel{}{}", file.format, file.bits, file.encoding.empty() ? "" : ", ",
                      file.encoding);
  if (file.pages > 1) text += fmt::format("\n  {} pages", file.pages);
  if (!file.layers.empty()) text += fmt::format("\n  layers: {}", fmt::join(file.layers, ", "));
  if (file.orientation != 1)
    text += fmt::format("\n  stored {}×{}, orientation {} is applied on reading", file.stored_width, file.stored_height,
                        file.orientation);
  if (!file.profile.empty()) text += fmt::format("\n  color profile: {}", file.profile);
  if (file.metadata.density_x > 0) {
    text += fmt::format("\n  {:.6g} × {:.6g} pixels per meter ({:.4g} dpi)", file.metadata.density_x,
                        file.metadata.density_y, file.metadata.density_x * 0.0254F);
  }
  if (!file.metadata.exif.empty()) text += fmt::format("\n  EXIF: {} bytes", file.metadata.exif.size());
  if (!file.metadata.xmp.empty()) text += fmt::format("\n  XMP: {} bytes", file.metadata.xmp.size());
  for (const auto& [name, value] : file.metadata.text) {
    const std::size_t end = std::min(value.find('\n'), std::size_t{100});
    text += fmt::format("\n  {}: {}{}", name, value.substr(0, end), end < value.size() ? " …" : "");
  }
  return text + (file.streamed ? "\n  read by rows, in bounded memory\n" : "\n  read whole\n");
}

using OpenInput = std::shared_ptr<const Input>;

std::string image_text(const CommandLine& line, const std::string& path, const OpenInput& input, const Run& run) {
  const ImageFile file = image_file(input, line.read, run);
  return line.json ? as_json(path, file).dump() + "\n" : as_text(path, file);
}

std::string model_text(const CommandLine& line, const std::string& path, const OpenInput& input, const Run& run) {
  const std::string format = model_format(*input, line.read_model);
  const Model model = read_model(input, line.read_model, run);
  const auto* const scene = line.tree ? std::get_if<Scene>(&model) : nullptr;
  const ModelInfo info = model_info(model, run);
  if (!line.json) {
    const std::string text = fmt::format("{}\n  {:<12}{} ({})\n{}", path, "format", format, info.kind, to_text(info));
    return scene == nullptr ? text : text + "\n" + scene_tree(*scene);
  }
  const Json described = to_json(info);
  Json json = Json::object();
  json.set("azulejo", AZULEJO_VERSION).set("operation", "info").set("file", path).set("format", format);
  for (const std::string& key : described.keys()) json.set(key, described[key]);
  if (scene != nullptr)
    json.set("tree", Json::object().set("roots", roots_json(*scene)).set("nodes", nodes_json(*scene)));
  return json.dump() + "\n";
}

}  // namespace

int info_command(const CommandLine& line) {
  if (line.positionals.empty()) throw Error(Error::Argument, "info: file missing");
  Run run;
  run.threads = line.threads;
  run.limits = line.limits;
  if (line.strict) {
    run.warn = [](const std::string& message) { throw Error(Error::Data, message + " (--strict)"); };
  } else if (!line.quiet) {
    run.warn = [](const std::string& message) { fmt::print(stderr, "azulejo: warning: {}\n", message); };
  }
  int status = 0;
  for (const std::string& path : line.positionals) {
    try {
      const OpenInput input = open_input(path, run.limits.memory_bytes);
      const bool model = line.read_model.raw || is_model_file(*input);
      const std::string text = model ? model_text(line, path, input, run) : image_text(line, path, input, run);
      std::fwrite(text.data(), 1, text.size(), stdout);
    } catch (const Error& error) {
      std::fflush(stdout);
      fmt::print(stderr, "azulejo: {}\n", error.what());
      status = 1;
    }
  }
  return status;
}

}  // namespace azulejo::cli
