#include "azulejo/io/image_io.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/decode_pass.h"
#include "azulejo/io/image_sink.h"
#include "azulejo/io/image_source.h"
#include "azulejo/io/input.h"
#include "azulejo/io/output.h"

namespace azulejo {
namespace {

constexpr int kRowsBetweenChecks = 64;

const Codec& codec_to_write(const std::string& path, const WriteOptions& options) {
  const std::string ending = !options.format.empty() ? options.format : path == "-" ? "png" : ending_of(path);
  const Codec* const codec = codec_for_ending(ending);
  if (codec != nullptr && codec->encode != nullptr) return *codec;
  throw Error(Error::Argument, fmt::format("{}: images are not written as '{}'; expected one of {}", path, ending,
                                           fmt::join(image_endings_written(), ", ")));
}

void write_through(std::unique_ptr<Output> output, const Codec& codec, const Image& image, const WriteOptions& options,
                   const Run& run) {
  std::optional<ValueRange> range;
  if (options.normalize && image.type() == PixelType::F32) range = value_range(image.any());
  const auto sink = make_file_sink(std::move(output), codec, image.info(), image.metadata(), options, range, run);
  const int step = kRowsBetweenChecks * std::max(1, sink->row_group());
  for (int y = 0; y < image.height(); y += step) {
    check_cancelled(run);
    sink->write(image.any().crop({0, y, image.width(), std::min(step, image.height() - y)}));
  }
  sink->finish();
}

void check_not_empty(const Image& image, const std::string& name) {
  if (image.empty()) throw Error(Error::Argument, fmt::format("{}: an empty image can't be written", name));
}

std::vector<std::string> endings(bool written) {
  std::vector<std::string> result;
  for (const Codec* codec : codecs()) {
    if (!written || codec->encode != nullptr) result.insert(result.end(), codec->endings.begin(), codec->endings.end());
  }
  return result;
}

}  // namespace

Image read_image(const std::string& path, const ReadOptions& options, const Run& run) {
  return DecodePass(open_input(path, run.limits.memory_bytes), options, run).decode_whole();
}

Image read_image(std::span<const std::byte> bytes, const std::string& name, const ReadOptions& options,
                 const Run& run) {
  return DecodePass(memory_input(bytes, name), options, run).decode_whole();
}

std::unique_ptr<ImageSource> open_image(const std::string& path, const ReadOptions& options, const Run& run) {
  return open_image(open_input(path, run.limits.memory_bytes), options, run);
}

std::unique_ptr<ImageSource> open_image(std::shared_ptr<const Input> input, const ReadOptions& options,
                                        const Run& run) {
  return open_file_source(std::move(input), options, run);
}

ImageFile image_file(const std::string& path, const ReadOptions& options, const Run& run) {
  return image_file(open_input(path, run.limits.memory_bytes), options, run);
}

ImageFile image_file(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run) {
  return DecodePass(std::move(input), options, run).file();
}

ImageFile image_file(std::span<const std::byte> bytes, const std::string& name, const ReadOptions& options,
                     const Run& run) {
  return DecodePass(memory_input(bytes, name), options, run).file();
}

void write_image(const Image& image, const std::string& path, const WriteOptions& options, const Run& run) {
  check_not_empty(image, path);
  const Codec& codec = codec_to_write(path, options);
  write_through(create_output(path), codec, image, options, run);
}

std::vector<std::byte> encode_image(const Image& image, const std::string& format, const WriteOptions& options,
                                    const Run& run) {
  check_not_empty(image, format);
  const Codec& codec = codec_to_write("." + format, options);
  std::vector<std::byte> bytes;
  write_through(memory_output(bytes, format), codec, image, options, run);
  return bytes;
}

std::unique_ptr<ImageSink> create_image(const std::string& path, const ImageInfo& info, const Metadata& metadata,
                                        const WriteOptions& options, const Run& run) {
  const Codec& codec = codec_to_write(path, options);
  return make_file_sink(create_output(path), codec, info, metadata, options, std::nullopt, run);
}

std::vector<std::string> image_endings_written() { return endings(true); }

std::vector<std::string> image_endings_read() { return endings(false); }

bool is_image_path(const std::string& path) {
  const Codec* const codec = codec_for_ending(ending_of(path));
  return codec != nullptr && codec->encode != nullptr;
}

}  // namespace azulejo
