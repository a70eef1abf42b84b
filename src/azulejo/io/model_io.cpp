#include "azulejo/io/model_io.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/decode_pass.h"
#include "azulejo/io/gzip.h"
#include "azulejo/io/model_codec.h"

namespace azulejo {
namespace {

constexpr std::size_t kHead = 512;

std::string without_gz(const std::string& name) {
  return ending_of(name) == "gz" ? name.substr(0, name.size() - 3) : name;
}

const ModelCodec* codec_named_by(const std::string& ending) {
  for (const ModelCodec* codec : model_codecs()) {
    if (std::find(codec->endings.begin(), codec->endings.end(), ending) != codec->endings.end()) return codec;
  }
  return nullptr;
}

/// What is known of a file before it is read: its beginning, unpacked.
struct Beginning {
  std::vector<std::byte> head;
  std::uint64_t size = 0;  ///< of a packed file this isn't known without unpacking it: that of its head
  std::string name;        ///< without .gz
};

Beginning beginning_of(const Input& input) {
  if (is_gzip(input)) {
    std::vector<std::byte> head = unpack_gzip_head(input, kHead);
    const std::size_t size = head.size();
    return {std::move(head), size, without_gz(input.name())};
  }
  std::vector<std::byte> head(kHead);
  head.resize(input.read(0, head));
  return {std::move(head), input.size(), input.name()};
}

const ModelCodec* matching_codec(const Beginning& file) {
  for (const ModelCodec* codec : model_codecs()) {
    if (codec->matches(file.head, file.size, file.name)) return codec;
  }
  return nullptr;
}

const Codec* matching_image_codec(const Beginning& file) {
  const auto head = std::span(file.head).first(std::min<std::size_t>(file.head.size(), 64));
  for (const Codec* codec : codecs()) {
    if (codec->matches(head, file.name)) return codec;
  }
  return nullptr;
}

const ModelCodec& recognized(const Input& input, const ModelReadOptions& options) {
  const Beginning file = beginning_of(input);
  const ModelCodec* const codec = options.raw ? codec_named_by("raw") : matching_codec(file);
  if (codec != nullptr) return *codec;
  if (input.size() == 0) throw Error(Error::Data, fmt::format("{}: byte 0: the file is empty", input.name()));
  if (const ModelCodec* const named = codec_named_by(ending_of(file.name))) {
    throw Error(Error::Data,
                fmt::format("{}: byte 0: a file of format {} doesn't begin like this", input.name(), named->name));
  }
  throw Error(Error::Unsupported, fmt::format("{}: byte 0: not a model of a known format", input.name()));
}

void take_options(Space& space, const ModelReadOptions& options) {
  if (options.up) space.up = *options.up;
  if (options.metres_per_unit) space.metres_per_unit = *options.metres_per_unit;
}

void finish(Mesh& mesh, const std::string& name, const ModelReadOptions& options) {
  take_options(mesh.space, options);
  mesh.check(name);
}

void finish(Scene& scene, const std::string& name, const ModelReadOptions& options) {
  take_options(scene.space, options);
  for (const auto& mesh : scene.meshes) mesh->check(name);
  scene.check(name);
}

void finish(Drawing& drawing, const std::string& name, const ModelReadOptions&) { drawing.check(name); }

void finish(Volume& volume, const std::string& name, const ModelReadOptions& options) {
  if (options.metres_per_unit) volume.metres_per_unit = *options.metres_per_unit;
  const std::size_t wanted = volume.width < 0 || volume.height < 0 || volume.depth < 0
                                 ? volume.samples.size() + 1
                                 : volume.index(0, 0, volume.depth);
  if (volume.samples.size() != wanted) {
    throw Error(Error::Data, fmt::format("{}: {} samples, expected {} × {} × {}", name, volume.samples.size(),
                                         volume.width, volume.height, volume.depth));
  }
}

}  // namespace

Model read_model(std::shared_ptr<const Input> input, const ModelReadOptions& options, const Run& run) {
  const std::string name = input->name();
  const std::string folder = input->folder();
  try {
    if (is_gzip(*input)) input = unpack_gzip(*input, run.limits.memory_bytes);
    const ModelCodec& codec = recognized(*input, options);
    Model model = codec.read({std::move(input), folder}, options, run);
    std::visit([&](auto& value) { finish(value, name, options); }, model);
    return model;
  } catch (const std::bad_alloc&) {
    throw Error(Error::Resource, fmt::format("{}: out of memory", name));
  } catch (const std::length_error&) {
    throw Error(Error::Resource, fmt::format("{}: out of memory", name));
  }
}

namespace {

std::vector<std::string> endings(bool written) {
  std::vector<std::string> result;
  for (const ModelCodec* codec : model_codecs()) {
    if (written && !codec->is_written()) continue;
    result.insert(result.end(), codec->endings.begin(), codec->endings.end());
  }
  return result;
}

/// The codec that writes files of this ending.
const ModelCodec& codec_to_write(const std::string& path, const std::string& ending) {
  const ModelCodec* const codec = codec_named_by(ending_of("." + ending));
  if (codec != nullptr && codec->is_written()) return *codec;
  throw Error(Error::Argument, fmt::format("{}: models are not written as '{}'; expected one of {}", path, ending,
                                           fmt::join(model_endings_written(), ", ")));
}

/// Where the files of a scene go that lie beside it.
struct Beside {
  std::string folder;  ///< empty: nowhere
  std::string stem;
};

Beside beside(const std::string& path) {
  if (path == "-") return {};
  const std::filesystem::path file(path);
  const std::filesystem::path folder = file.parent_path();
  return {folder.empty() ? "." : folder.string(), file.stem().string()};
}

Error holds_other(const Output& output, const ModelCodec& codec, const char* got, const char* advice = "") {
  const char* const held = codec.write_drawing != nullptr ? "drawing" : codec.write_scene != nullptr ? "scene" : "mesh";
  return Error(Error::Argument,
               fmt::format("{}: format {} holds a {}, got a {}{}", output.name(), codec.name, held, got, advice));
}

void write_into(Output& output, const ModelCodec& codec, const Scene& scene, const Beside& place,
                const ModelWriteOptions& options, const Run& run) {
  if (codec.write_scene == nullptr) {
    throw holds_other(output, codec, "scene", codec.write_mesh != nullptr ? ": flatten it first" : "");
  }
  codec.write_scene(output, scene, place.folder, place.stem, options, run);
  output.commit();
}

void write_into(Output& output, const ModelCodec& codec, const Mesh& mesh, const Beside& place,
                const ModelWriteOptions& options, const Run& run) {
  if (codec.write_mesh == nullptr) return write_into(output, codec, scene_of(mesh.clone()), place, options, run);
  codec.write_mesh(output, mesh, options, run);
  output.commit();
}

void write_into(Output& output, const ModelCodec& codec, const Drawing& drawing, const Beside&,
                const ModelWriteOptions& options, const Run& run) {
  if (codec.write_drawing == nullptr) throw holds_other(output, codec, "drawing");
  codec.write_drawing(output, drawing, options, run);
  output.commit();
}

/// In what standard output is written.
const char* piped_format(const Mesh&) { return "ply"; }
const char* piped_format(const Scene&) { return "glb"; }
const char* piped_format(const Drawing&) { return "svg"; }

template <class T>
void write_file(const T& model, const std::string& path, const ModelWriteOptions& options, const Run& run) {
  const ModelCodec& codec = codec_to_write(path, path == "-" ? piped_format(model) : ending_of(path));
  write_into(*create_output(path), codec, model, beside(path), options, run);
}

template <class T>
std::vector<std::byte> encode(const T& model, const std::string& format, const ModelWriteOptions& options,
                              const Run& run) {
  const ModelCodec& codec = codec_to_write(format, format);
  std::vector<std::byte> bytes;
  write_into(*memory_output(bytes, format), codec, model, {}, options, run);
  return bytes;
}

}  // namespace

Model read_model(const std::string& path, const ModelReadOptions& options, const Run& run) {
  return read_model(open_input(path, run.limits.memory_bytes), options, run);
}

Model read_model(std::span<const std::byte> bytes, const std::string& name, const ModelReadOptions& options,
                 const Run& run) {
  return read_model(memory_input(bytes, name), options, run);
}

std::string model_format(const std::string& path, const ModelReadOptions& options, const Run& run) {
  return model_format(*open_input(path, run.limits.memory_bytes), options);
}

std::string model_format(const Input& input, const ModelReadOptions& options) {
  return recognized(input, options).name;
}

bool is_model_file(const std::string& path, const Run& run) {
  return is_model_file(*open_input(path, run.limits.memory_bytes));
}

bool is_model_file(const Input& input) {
  const Beginning file = beginning_of(input);
  const Codec* const image = matching_image_codec(file);
  const std::string ending = ending_of(file.name);
  // Targa and binary STL have no signature: where both could be meant the ending decides.
  if (image != nullptr && codec_for_ending(ending) == image) return false;
  if (matching_codec(file) != nullptr) return true;
  return image == nullptr && codec_named_by(ending) != nullptr;
}

void write_model(const Mesh& mesh, const std::string& path, const ModelWriteOptions& options, const Run& run) {
  write_file(mesh, path, options, run);
}

void write_model(const Scene& scene, const std::string& path, const ModelWriteOptions& options, const Run& run) {
  write_file(scene, path, options, run);
}

void write_model(const Drawing& drawing, const std::string& path, const ModelWriteOptions& options, const Run& run) {
  write_file(drawing, path, options, run);
}

std::vector<std::byte> encode_model(const Mesh& mesh, const std::string& format, const ModelWriteOptions& options,
                                    const Run& run) {
  return encode(mesh, format, options, run);
}

std::vector<std::byte> encode_model(const Scene& scene, const std::string& format, const ModelWriteOptions& options,
                                    const Run& run) {
  return encode(scene, format, options, run);
}

std::vector<std::byte> encode_model(const Drawing& drawing, const std::string& format, const ModelWriteOptions& options,
                                    const Run& run) {
  return encode(drawing, format, options, run);
}

std::vector<std::string> model_endings_written() { return endings(true); }

std::vector<std::string> model_endings_read() { return endings(false); }

bool is_model_path(const std::string& path) {
  const ModelCodec* const codec = codec_named_by(ending_of(path));
  return codec != nullptr && codec->is_written();
}

bool is_scene_path(const std::string& path) {
  const ModelCodec* const codec = codec_named_by(path == "-" ? piped_format(Scene()) : ending_of(path));
  return codec != nullptr && codec->write_scene != nullptr;
}

bool is_drawing_path(const std::string& path) {
  const ModelCodec* const codec = codec_named_by(path == "-" ? piped_format(Drawing()) : ending_of(path));
  return codec != nullptr && codec->write_drawing != nullptr;
}

}  // namespace azulejo
