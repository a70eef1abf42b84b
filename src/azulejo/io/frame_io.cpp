#include "azulejo/io/frame_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <set>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/io/convert_rows.h"
#include "azulejo/io/exr.h"
#include "azulejo/io/exr_stream.h"

namespace azulejo {
namespace {

constexpr int kRowsBetweenChecks = 256;
constexpr std::size_t kLongestName = 255;  // of a channel

/// What a layer is as OpenEXR holds it.
ImageInfo stored_info(const ImageInfo& info) {
  ImageInfo stored = info;
  stored.type = PixelType::F32;
  if (stored.color == ColorState::Srgb) stored.color = ColorState::Linear;
  if (stored.alpha == AlphaState::Straight) stored.alpha = AlphaState::Premultiplied;
  return stored;
}

std::vector<std::string> channel_names(const std::string& layer, const ImageInfo& info) {
  const int colors = info.color_channels();
  std::vector<std::string> names;
  if (info.color != ColorState::Data && colors == 3) {
    names = {"R", "G", "B"};
  } else if (info.color != ColorState::Data && colors == 1) {
    names = {"Y"};
  } else if (colors == 1) {
    names = {layer == "depth" ? "Z" : "V"};
  } else if (colors == 2) {
    names = {"U", "V"};
  } else {
    names = {"X", "Y", "Z", "W"};
    names.resize(static_cast<std::size_t>(colors));
  }
  if (info.alpha != AlphaState::None) names.emplace_back("A");
  if (layer == "color" && info.color != ColorState::Data) return names;
  for (std::string& name : names) name = fmt::format("{}.{}", layer, name);
  return names;
}

void check_layers(const Frame& frame, const std::string& path) {
  if (frame.layers.empty()) throw Error(Error::Argument, fmt::format("{}: a frame without layers", path));
  const ImageInfo& first = frame.layers[0].image.info();
  std::set<std::string> names;
  for (const Frame::Layer& layer : frame.layers) {
    if (layer.image.empty() || layer.image.info().rect() != first.rect()) {
      throw Error(Error::Argument,
                  fmt::format("{}: layer \"{}\" is {}, expected {} × {} as \"{}\"", path, layer.name,
                              describe(layer.image.info()), first.width, first.height, frame.layers[0].name));
    }
    const bool good = !layer.name.empty() && layer.name.size() + 2 <= kLongestName &&
                      layer.name.find('.') == std::string::npos && layer.name.find('\0') == std::string::npos;
    if (!good || !names.insert(layer.name).second) {
      throw Error(Error::Argument,
                  fmt::format("{}: layer \"{}\", expected a name of its own without dots", path, layer.name));
    }
  }
}

/// The layers as floats, and where OpenEXR finds them.
struct Channels {
  std::list<Image> converted;
  Imf::FrameBuffer buffer;
  std::vector<std::string> names;
};

Channels channels_of(const Frame& frame, const Run& run) {
  Channels channels;
  for (const Frame::Layer& layer : frame.layers) {
    const ImageInfo info = layer.image.info();
    const ImageInfo stored = stored_info(info);
    const Image* image = &layer.image;
    if (stored != info) {
      Image floats(stored, run.limits);
      RowConverter(info, stored).convert(layer.image.any(), floats.any());
      image = &channels.converted.emplace_back(std::move(floats));
    }
    const auto view = image->view<float>();
    const std::vector<std::string> names = channel_names(layer.name, info);
    for (std::size_t c = 0; c < names.size(); ++c) {
      // OpenEXR's slices point to bytes that may be written; an output file only reads them.
      char* const base = reinterpret_cast<char*>(const_cast<float*>(view.row(0) + c));
      const auto row_bytes = static_cast<std::size_t>(view.stride) * sizeof(float);
      channels.buffer.insert(names[c], Imf::Slice(Imf::FLOAT, base, names.size() * sizeof(float), row_bytes));
      channels.names.push_back(names[c]);
    }
  }
  return channels;
}

Imf::Header header_of(const Frame& frame, const Channels& channels, const WriteOptions& options) {
  const ImageInfo& info = frame.layers[0].image.info();
  Imf::Header header(info.width, info.height);
  header.compression() = exr_compression(options.compression);
  for (const std::string& each : channels.names) header.channels().insert(each, Imf::Channel(Imf::FLOAT));
  if (options.tile > 0) {
    const auto size = static_cast<unsigned>(options.tile);
    header.setTileDescription(Imf::TileDescription(size, size, Imf::ONE_LEVEL));
  }
  if (!frame.camera.is_null()) header.insert("camera", Imf::StringAttribute(frame.camera.dump(-1)));
  return header;
}

void write_lines(Imf::OStream& stream, const Imf::Header& header, const Channels& channels, const Run& run) {
  Imf::OutputFile file(stream, header, 0);
  file.setFrameBuffer(channels.buffer);
  const int height = header.dataWindow().max.y + 1;
  for (int y = 0; y < height; y += kRowsBetweenChecks) {
    check_cancelled(run);
    file.writePixels(std::min(kRowsBetweenChecks, height - y));
  }
}

void write_tiles(Imf::OStream& stream, const Imf::Header& header, const Channels& channels, const Run& run) {
  Imf::TiledOutputFile file(stream, header, 0);
  file.setFrameBuffer(channels.buffer);
  for (int y = 0; y < file.numYTiles(); ++y) {
    check_cancelled(run);
    file.writeTiles(0, file.numXTiles() - 1, y, y);
  }
}

}  // namespace

void write_frame(const Frame& frame, const std::string& path, const WriteOptions& options, const Run& run) {
  check_layers(frame, path);
  const std::unique_ptr<Output> output = create_output(path);
  const Channels channels = channels_of(frame, run);
  ExrOutputStream stream(*output);
  try {
    const Imf::Header header = header_of(frame, channels, options);
    (options.tile > 0 ? write_tiles : write_lines)(stream, header, channels, run);
  } catch (...) {
    rethrow_exr_error(output->name(), stream.failure());
  }
  // The files' destructors write the table of offsets, and keep exceptions to themselves.
  if (stream.failure()) std::rethrow_exception(stream.failure());
  output->commit();
}

}  // namespace azulejo
