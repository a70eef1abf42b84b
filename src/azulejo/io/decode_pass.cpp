#include "azulejo/io/decode_pass.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/convert_rows.h"
#include "azulejo/io/exif.h"
#include "azulejo/io/orientation.h"

namespace azulejo {
namespace {

constexpr std::int64_t kStripBytes = std::int64_t{1} << 20;

/// Rows that are read, converted or placed together: about a megabyte of whole groups.
int strip_rows(const ImageInfo& info, int group) {
  const std::int64_t rows =
      std::max<std::int64_t>(1, kStripBytes / std::max<std::int64_t>(1, static_cast<std::int64_t>(info.row_bytes())));
  const std::int64_t groups = std::max<std::int64_t>(1, rows / std::max(1, group));
  return static_cast<int>(std::min<std::int64_t>(groups * std::max(1, group), info.height));
}

AnyView described_as(AnyView view, const ImageInfo& info) {
  view.info.color = info.color;
  view.info.alpha = info.alpha;
  return view;
}

/// Runs what allocates from a file's values: what the machine can't give is an error of the file's.
template <class F>
auto within_memory(const std::string& name, const F& f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
    throw Error(Error::Resource, fmt::format("{}: out of memory", name));
  } catch (const std::length_error&) {
    throw Error(Error::Resource, fmt::format("{}: out of memory", name));
  }
}

ImageInfo with_height(ImageInfo info, int height) {
  info.height = height;
  return info;
}

}  // namespace

std::string ending_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] == '/') return {};
  std::string ending = path.substr(dot + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

const Codec* codec_for_ending(const std::string& ending) {
  const std::string wanted = ending_of("." + ending);
  for (const Codec* codec : codecs()) {
    if (std::find(codec->endings.begin(), codec->endings.end(), wanted) != codec->endings.end()) return codec;
  }
  return nullptr;
}

const Codec& recognized_codec(const Input& input) {
  std::array<std::byte, 64> head = {};
  const std::size_t count = input.read(0, head);
  for (const Codec* codec : codecs()) {
    if (codec->matches(std::span(head).first(count), input.name())) return *codec;
  }
  if (count == 0) throw Error(Error::Data, fmt::format("{}: byte 0: the file is empty", input.name()));
  if (const Codec* const named = codec_for_ending(ending_of(input.name()))) {
    throw Error(Error::Data,
                fmt::format("{}: byte 0: a file of format {} doesn't begin like this", input.name(), named->name));
  }
  throw Error(Error::Unsupported, fmt::format("{}: byte 0: not an image of a known format", input.name()));
}

Image allocate_image(const std::string& name, const ImageInfo& info, std::int64_t memory_bytes, const Run& run) {
  const std::int64_t pixels = std::int64_t{info.width} * info.height;
  if (pixels > run.limits.pixels) {
    throw Error(Error::Resource,
                fmt::format("{}: {}×{} pixels, the limit is {}", name, info.width, info.height, run.limits.pixels));
  }
  const std::int64_t bytes = image_bytes(info);
  if (bytes <= memory_bytes) return Image(info, run.limits);
  if (bytes > run.limits.temporary_bytes) {
    throw Error(Error::Resource, fmt::format("{}: {} bytes of pixels, the limit of temporary files is {}", name, bytes,
                                             run.limits.temporary_bytes));
  }
  return Image::in_temporary_file(info, run.limits);
}

DecodePass::DecodePass(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run)
    : input_(std::move(input)), run_(run), memory_left_(run.limits.memory_bytes) {
  const Codec& codec = recognized_codec(*input_);
  decoder_ = within_memory(input_->name(), [&] { return codec.decode(input_, options, run_); });
  file_ = decoder_->header().file;
  stored_ = file_.info;
  if (std::int64_t{stored_.width} * stored_.height > run_.limits.pixels) {
    throw Error(Error::Resource, fmt::format("{}: {}×{} pixels, the limit is {}", input_->name(), stored_.width,
                                             stored_.height, run_.limits.pixels));
  }
  take_exif();
  choose_colors(options);
  file_.info = turned_info(colored_, file_.orientation);
  file_.streamed = decoder_->streams() && file_.orientation == 1;
}

/// Orientation and density, where the format has none of its own that the codec knew.
void DecodePass::take_exif() {
  Metadata& metadata = file_.metadata;
  const ExifSummary exif = parse_exif(metadata.exif);
  if (file_.orientation == 1) file_.orientation = exif.orientation;
  reset_exif_orientation(metadata.exif);
  if (metadata.density_x == 0 && metadata.density_y == 0) {
    metadata.density_x = exif.density_x;
    metadata.density_y = exif.density_y;
  }
}

void DecodePass::choose_colors(const ReadOptions& options) {
  const DecodedHeader& header = decoder_->header();
  straight_ = colored_ = stored_;
  if (!header.icc.empty()) {
    file_.profile = profile_description(header.icc);
    if (options.convert_profile || header.cmyk) {
      ProfileConversion conversion = profile_to_srgb(header.icc, stored_, header.cmyk, input_->name(), run_);
      transform_ = std::move(conversion.transform);
      if (conversion.understood) colored_.color = ColorState::Srgb;
    }
  } else if (header.gamma > 0 && options.convert_profile) {
    transform_ = gamma_to_srgb(header.gamma, stored_);
  }
  if (header.cmyk) {
    if (!transform_) transform_ = cmyk_to_srgb();
    colored_.channels = 3;
  }
  if (transform_ && stored_.alpha == AlphaState::Premultiplied) {
    straight_.alpha = colored_.alpha = AlphaState::Straight;
  }
}

Image DecodePass::allocate(const ImageInfo& info) {
  Image image = allocate_image(input_->name(), info, memory_left_, run_);
  if (image_bytes(info) <= memory_left_) memory_left_ -= image_bytes(info);
  return image;
}

void DecodePass::read(const AnyView& rows) { read_colored(rows); }

void DecodePass::read_colored(const AnyView& rows) {
  within_memory(input_->name(), [&] {
    if (!transform_) return decoder_->read(described_as(rows, stored_));
    if (stored_.channels == colored_.channels && stored_.alpha == colored_.alpha) {
      decoder_->read(described_as(rows, stored_));
      return transform_->apply(described_as(rows, stored_), rows);
    }
    const int strip = decoder_->streams() ? strip_rows(stored_, decoder_->row_group()) : stored_.height;
    Image buffer =
        allocate_image(input_->name(), with_height(stored_, std::min(strip, rows.height())), memory_left_, run_);
    for (int y = 0; y < rows.height(); y += strip) {
      const int count = std::min(strip, rows.height() - y);
      read_through(buffer.any().crop({0, 0, stored_.width, count}), rows.crop({0, y, stored_.width, count}));
    }
  });
}

/// Reads into `stored`, and from there through the transform into `rows`.
void DecodePass::read_through(const AnyView& stored, const AnyView& rows) {
  decoder_->read(stored);
  if (stored_.alpha == straight_.alpha) return transform_->apply(stored, rows);
  RowConverter(stored_, straight_).convert(stored, rows);
  transform_->apply(described_as(rows, straight_), rows);
}

Image DecodePass::decode_whole() {
  return within_memory(input_->name(), [&] {
    Image upright = allocate(file_.info);
    upright.set_metadata(file_.metadata);
    const bool turned = file_.orientation != 1;
    const int height = stored_.height;
    const int strip = decoder_->streams() ? strip_rows(colored_, decoder_->row_group()) : height;
    Image buffer = turned ? allocate(with_height(colored_, strip)) : Image();
    for (int y = 0; y < height; y += strip) {
      check_cancelled(run_);
      const Rect part = {0, 0, colored_.width, std::min(strip, height - y)};
      if (!turned) {
        read_colored(upright.any().crop({0, y, part.width, part.height}));
        continue;
      }
      read_colored(buffer.any().crop(part));
      place_turned_rows(buffer.any().crop(part), y, file_.orientation, upright.any());
    }
    return upright;
  });
}

}  // namespace azulejo
