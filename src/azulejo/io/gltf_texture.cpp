#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "azulejo/core/parallel.h"
#include "azulejo/io/convert_rows.h"
#include "azulejo/io/gltf_parts.h"
#include "azulejo/io/image_io.h"

namespace azulejo {
namespace {

/// An image of the file: where its bytes are, and what becomes of them.
struct Picture {
  std::string name;    ///< for messages
  std::string source;  ///< the file's name, if it isn't embedded
  std::optional<std::vector<std::byte>> fetched;
  std::span<const std::byte> bytes;
  std::shared_ptr<const Image> image;
  std::vector<std::string> warnings;
};

TextureWrap wrap_of(const GltfValue& value) {
  switch (value.count(10497)) {
    case 10497: return TextureWrap::Repeat;
    case 33648: return TextureWrap::Mirror;
    case 33071: return TextureWrap::Clamp;
    default: throw value.error(fmt::format("{}, expected 10497, 33648 or 33071", value.count(0)));
  }
}

void read_minification(const GltfValue& value, Texture& texture) {
  const std::uint64_t code = value.count(9987);
  if (code != 9728 && code != 9729 && (code < 9984 || code > 9987)) {
    throw value.error(fmt::format("{}, expected 9728, 9729 or 9984 to 9987", code));
  }
  texture.minification = code % 2 == 0 ? TextureFilter::Nearest : TextureFilter::Linear;
  texture.mipmaps = code < 9984 ? MipFilter::None : code < 9986 ? MipFilter::Nearest : MipFilter::Linear;
}

void read_sampler(const GltfValue& value, Texture& texture) {
  texture.wrap_u = wrap_of(value["wrapS"]);
  texture.wrap_v = wrap_of(value["wrapT"]);
  const std::uint64_t magnification = value["magFilter"].count(9729);
  if (magnification != 9728 && magnification != 9729) {
    throw value["magFilter"].error(fmt::format("{}, expected 9728 or 9729", magnification));
  }
  texture.magnification = magnification == 9728 ? TextureFilter::Nearest : TextureFilter::Linear;
  read_minification(value["minFilter"], texture);
}

/// Finds the bytes of an image; none, with a warning, if it is a file that isn't there or that may not be read.
void find_bytes(GltfFile& file, const GltfValue& value, Picture& picture) {
  const std::string uri = value["uri"].text();
  if (uri.empty()) {
    const std::size_t view = value.need("bufferView").index(file.view_count());
    if (file.options().textures) picture.bytes = file.view(view);
    return;
  }
  if (!uri.starts_with("data:")) picture.source = uri;
  if (!file.options().textures) return;
  try {
    picture.fetched = file.fetch(uri);
    if (!picture.fetched) picture.warnings.push_back(fmt::format("{}: no file {}", picture.name, printable(uri)));
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled || error.kind() == Error::Resource) throw;
    picture.warnings.push_back(fmt::format("{}: {}", picture.name, error.what()));
  }
  if (!picture.fetched) return;
  file.claim(picture.fetched->size(), 1);
  picture.bytes = *picture.fetched;
}

/// Textures have 8 bits a channel, so that all may be sampled alike.
Image in_bytes(Image image, const Run& run) {
  if (image.type() == PixelType::U8) return image;
  ImageInfo info = image.info();
  info.type = PixelType::U8;
  info.color = ColorState::Srgb;
  Image result(info, run.limits);
  RowConverter(image.info(), info).convert(std::as_const(image).any(), result.any());
  return result;
}

void decode(Picture& picture, const Run& run) {
  Run inner = run;
  inner.threads = 1;
  inner.progress = nullptr;
  inner.warn = [&](const std::string& line) { picture.warnings.push_back(line); };
  try {
    // Colour profiles in textures are to be ignored, says the specification: normals are no colours.
    Image image = read_image(picture.bytes, picture.name, {.convert_profile = false}, inner);
    picture.image = std::make_shared<const Image>(in_bytes(std::move(image), inner));
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled || error.kind() == Error::Resource) throw;
    picture.warnings.emplace_back(error.what());
  }
}

/// Claims the memory of the decoded image. What has no readable header is left to fail in `decode`.
void claim_pixels(const GltfFile& file, const Picture& picture, std::int64_t& bytes) {
  Run quiet;
  quiet.limits = file.run().limits;
  try {
    bytes += image_bytes(image_file(picture.bytes, picture.name, {}, quiet).info);
  } catch (const Error& error) {
    if (error.kind() == Error::Resource) throw;
  }
  if (bytes > file.run().limits.memory_bytes) {
    throw Error(Error::Resource, fmt::format("{}: {} bytes of images, the limit of memory is {}", file.name(), bytes,
                                             file.run().limits.memory_bytes));
  }
}

std::vector<Picture> read_pictures(GltfFile& file, const std::vector<bool>& used) {
  const GltfValue list = file.root()["images"];
  file.claim(list.size(), sizeof(Picture));
  std::vector<Picture> pictures(list.size());
  std::vector<std::size_t> present;
  std::int64_t bytes = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!used[i]) continue;
    Picture& picture = pictures[i];
    picture.name = fmt::format("{}: image {}", file.name(), i);
    find_bytes(file, list.at(i), picture);
    if (!file.options().textures || !picture.warnings.empty()) continue;
    claim_pixels(file, picture, bytes);
    present.push_back(i);
  }
  parallel_tasks(present.size(), file.run(),
                 [&](std::size_t task, int) { decode(pictures[present[task]], file.run()); });
  for (const Picture& picture : pictures) {
    for (const std::string& line : picture.warnings) warn(file.run(), line);
  }
  return pictures;
}

/// The image of a texture. Formats of extensions are taken where there is no other.
GltfValue source_of(const GltfValue& texture) {
  if (const GltfValue source = texture["source"]) return source;
  return texture["extensions"]["EXT_texture_webp"]["source"];
}

}  // namespace

std::vector<Texture> read_gltf_textures(GltfFile& file) {
  const GltfValue list = file.root()["textures"];
  const GltfValue samplers = file.root()["samplers"];
  const std::size_t images = file.root()["images"].size();
  file.claim(list.size(), sizeof(Texture));
  std::vector<Texture> textures(list.size());
  std::vector<bool> used(images);
  for (std::size_t t = 0; t < textures.size(); ++t) {
    const GltfValue value = list.at(t);
    textures[t].name = value["name"].text();
    if (const GltfValue sampler = value["sampler"])
      read_sampler(samplers.at(sampler.index(samplers.size())), textures[t]);
    const GltfValue source = source_of(value);
    if (source)
      used[source.index(images)] = true;
    else
      file.warn(fmt::format("texture {} has no image that can be read", t));
  }
  const std::vector<Picture> pictures = read_pictures(file, used);
  for (std::size_t t = 0; t < textures.size(); ++t) {
    const GltfValue source = source_of(list.at(t));
    if (!source) continue;
    const std::size_t image = source.index(images);
    textures[t].image = pictures[image].image;
    textures[t].source = pictures[image].source;
    if (textures[t].name.empty()) textures[t].name = file.root()["images"].at(image)["name"].text();
  }
  return textures;
}

}  // namespace azulejo
