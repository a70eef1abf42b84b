#include "azulejo/io/mtl_images.h"

#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/convert_rows.h"
#include "azulejo/io/image_io.h"

namespace azulejo {
namespace {

Image in_bytes(Image image) {
  if (image.type() == PixelType::U8 && image.info().color != ColorState::Linear &&
      image.info().alpha != AlphaState::Premultiplied) {
    return image;
  }
  ImageInfo info = image.info();
  info.type = PixelType::U8;
  if (info.color == ColorState::Linear) info.color = ColorState::Srgb;
  if (info.alpha == AlphaState::Premultiplied) info.alpha = AlphaState::Straight;
  Image result(info);
  RowConverter(image.info(), info).convert(image.any(), result.any());
  return result;
}

bool has_alpha(const Image& image) { return image.info().alpha != AlphaState::None; }

/// Opacity that a pixel of an opacity map stands for.
std::uint8_t opacity_at(const std::uint8_t* pixel, const Image& image) {
  if (has_alpha(image)) return pixel[image.channels() - 1];
  if (image.channels() < 3) return pixel[0];
  return static_cast<std::uint8_t>((pixel[0] + pixel[1] + pixel[2] + 1) / 3);
}

Image with_alpha_of(const Image* color, const Image& opacity) {
  ImageInfo info = opacity.info();
  info.channels = 4;
  info.color = ColorState::Srgb;
  info.alpha = AlphaState::Straight;
  Image result(info);
  for (int y = 0; y < info.height; ++y) {
    std::uint8_t* to = result.view<std::uint8_t>().row(y);
    const std::uint8_t* alpha = opacity.view<std::uint8_t>().row(y);
    const std::uint8_t* from = color != nullptr ? color->view<std::uint8_t>().row(y) : nullptr;
    for (int x = 0; x < info.width; ++x, to += 4, alpha += opacity.channels()) {
      for (int c = 0; c < 3; ++c) to[c] = from == nullptr ? 255 : from[color->info().color_channels() < 3 ? 0 : c];
      to[3] = opacity_at(alpha, opacity);
      if (from != nullptr) from += color->channels();
    }
  }
  return result;
}

/// What stands behind the last / or \.
std::string base_name(const std::string& name) { return name.substr(name.find_last_of("/\\") + 1); }

}  // namespace

Opacity opacity_of(const Image& image) {
  if (!has_alpha(image)) return Opacity::Opaque;
  bool masked = false;
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* pixel = image.view<std::uint8_t>().row(y) + image.channels() - 1;
    for (int x = 0; x < image.width(); ++x, pixel += image.channels()) {
      if (*pixel != 0 && *pixel != 255) return Opacity::Blended;
      masked = masked || *pixel == 0;
    }
  }
  return masked ? Opacity::Masked : Opacity::Opaque;
}

std::shared_ptr<const Input> open_near(const ModelFile& file, const std::string& name, const ModelReadOptions& options,
                                       const Run& run, std::string& refused) {
  for (const std::string& candidate : {name, base_name(name)}) {
    try {
      if (auto input = open_beside(file, candidate, options, run)) return input;
    } catch (const Error& error) {
      if (error.kind() == Error::Resource || error.kind() == Error::Cancelled) throw;
      refused = error.what();
    }
  }
  return nullptr;
}

std::shared_ptr<const Image> MtlImages::decoded(const Input& input) {
  try {
    const std::vector<std::byte> bytes = input.read_all(run_.limits.memory_bytes);
    Run quiet = run_;
    quiet.progress = {};
    auto image = std::make_shared<const Image>(in_bytes(read_image(bytes, input.name(), {}, quiet)));
    count(*image);
    return image;
  } catch (const Error& error) {
    if (error.kind() == Error::Resource || error.kind() == Error::Cancelled) throw;
    warn(run_, fmt::format("{}: a texture that can't be read: {}", file_.input->name(), error.what()));
    return nullptr;
  }
}

void MtlImages::count(const Image& image) {
  bytes_ += image.bytes();
  if (bytes_ > run_.limits.memory_bytes) {
    throw Error(Error::Resource, fmt::format("{}: textures of more than {} bytes, the limit of memory",
                                             file_.input->name(), run_.limits.memory_bytes));
  }
}

std::shared_ptr<const Image> MtlImages::read(const std::string& name) {
  if (!options_.textures) return nullptr;
  const auto [place, fresh] = images_.try_emplace(name);
  if (!fresh) return place->second;
  std::string refused;
  if (const auto input = open_near(file_, name, options_, run_, refused)) return place->second = decoded(*input);
  warn(run_, refused.empty() ? fmt::format("{}: texture '{}' is missing", file_.input->name(), name) : refused);
  return nullptr;
}

std::shared_ptr<const Image> MtlImages::with_opacity(const std::string& color, const std::string& opacity) {
  if (!options_.textures) return nullptr;
  const auto [place, fresh] = combined_.try_emplace({color, opacity});
  if (fresh) place->second = combined(color, opacity);
  return place->second;
}

std::shared_ptr<const Image> MtlImages::combined(const std::string& color, const std::string& opacity) {
  const auto colors = color.empty() ? nullptr : read(color);
  const auto alpha = read(opacity);
  if (alpha == nullptr || (colors == nullptr && !color.empty())) return nullptr;
  if (colors != nullptr && (colors->width() != alpha->width() || colors->height() != alpha->height())) {
    warn(run_, fmt::format("{}: opacity '{}' is left out: it is {}×{}, '{}' is {}×{}", file_.input->name(), opacity,
                           alpha->width(), alpha->height(), color, colors->width(), colors->height()));
    return nullptr;
  }
  auto image = std::make_shared<const Image>(with_alpha_of(colors.get(), *alpha));
  count(*image);
  return image;
}

}  // namespace azulejo
