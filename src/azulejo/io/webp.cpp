#include <webp/decode.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/decoded_size.h"
#include "azulejo/io/exif.h"

namespace azulejo {

extern const Codec kWebpCodec;

namespace {

struct DeleteMux {
  void operator()(WebPMux* mux) const { WebPMuxDelete(mux); }
};
using Mux = std::unique_ptr<WebPMux, DeleteMux>;

/// The `size` of a WebPData that somebody else owns.
WebPData borrowed(const void* bytes, std::size_t size) { return {static_cast<const std::uint8_t*>(bytes), size}; }

std::vector<std::uint8_t> chunk(const WebPMux* mux, const char* name) {
  WebPData data{};
  if (WebPMuxGetChunk(mux, name, &data) != WEBP_MUX_OK) return {};
  return {data.bytes, data.bytes + data.size};
}

/// Decodes at once: the whole file and the whole image are in memory.
class WebpDecoder final : public Decoder {
 public:
  WebpDecoder(std::shared_ptr<const Input> input, const Run& run);
  ~WebpDecoder() override { WebPDataClear(&frame_.bitstream); }
  WebpDecoder(const WebpDecoder&) = delete;
  WebpDecoder& operator=(const WebpDecoder&) = delete;

  bool streams() const override { return false; }
  void read(const AnyView& rows) override;

 private:
  void read_metadata(const WebPMux* mux);
  void read_first_frame(const WebPMux* mux);
  [[noreturn]] void fail(VP8StatusCode status) const;

  std::string name_;
  std::vector<std::byte> file_;
  Run run_;
  WebPMuxFrameInfo frame_{};  ///< of an animation: where its first frame lies, and its bytes
};

WebpDecoder::WebpDecoder(std::shared_ptr<const Input> input, const Run& run)
    : name_(input->name()), file_(input->read_all(run.limits.memory_bytes)), run_(run) {
  WebPBitstreamFeatures features{};
  const VP8StatusCode status =
      WebPGetFeatures(reinterpret_cast<const std::uint8_t*>(file_.data()), file_.size(), &features);
  if (status != VP8_STATUS_OK) fail(status);
  check_decoded_size(name_, static_cast<std::uint64_t>(features.width), static_cast<std::uint64_t>(features.height),
                     run);
  ImageFile& file = header_.file;
  file.format = "webp";
  file.stored_width = features.width;
  file.stored_height = features.height;
  file.info = {.width = features.width, .height = features.height, .channels = 3};
  if (features.has_alpha != 0 || features.has_animation != 0) {
    file.info.channels = 4;
    file.info.alpha = AlphaState::Straight;
  }
  file.encoding = features.format == 1 ? "lossy" : features.format == 2 ? "lossless" : "mixed";
  const WebPData whole = borrowed(file_.data(), file_.size());
  const Mux mux(WebPMuxCreate(&whole, 0));
  if (mux) {
    read_metadata(mux.get());
  } else {
    warn(run, fmt::format("{}: the file's chunks don't fit together or end early: metadata is not read", name_));
  }
  if (features.has_animation == 0) return;
  if (!mux) throw Error(Error::Data, fmt::format("{}: the animation's chunks don't fit together or end early", name_));
  file.encoding += ", animated";
  read_first_frame(mux.get());
  warn(run_, fmt::format("{}: an animation: only its first frame is read", name_));
}

void WebpDecoder::read_metadata(const WebPMux* mux) {
  Metadata& metadata = header_.file.metadata;
  header_.icc = chunk(mux, "ICCP");
  metadata.xmp = chunk(mux, "XMP ");
  metadata.exif = chunk(mux, "EXIF");
  // Some writers keep JPEG's mark.
  constexpr char kMark[] = "Exif\0";
  if (metadata.exif.size() >= sizeof kMark && std::memcmp(metadata.exif.data(), kMark, sizeof kMark) == 0) {
    metadata.exif.erase(metadata.exif.begin(), metadata.exif.begin() + sizeof kMark);
  }
  const ExifSummary exif = parse_exif(metadata.exif);
  header_.file.orientation = exif.orientation;
  metadata.density_x = exif.density_x;
  metadata.density_y = exif.density_y;
}

void WebpDecoder::read_first_frame(const WebPMux* mux) {
  if (WebPMuxGetFrame(mux, 1, &frame_) != WEBP_MUX_OK) {
    throw Error(Error::Data, fmt::format("{}: the animation has no first frame", name_));
  }
}

void WebpDecoder::read(const AnyView& rows) {
  WebPDecoderConfig config;
  if (WebPInitDecoderConfig(&config) == 0) throw Error(Error::Unsupported, "an incompatible libwebp");
  const bool animated = frame_.bitstream.size > 0;
  const WebPData data = animated ? frame_.bitstream : borrowed(file_.data(), file_.size());
  VP8StatusCode status = WebPGetFeatures(data.bytes, data.size, &config.input);
  if (status != VP8_STATUS_OK) fail(status);
  AnyView part = rows;
  if (animated) {
    for (int y = 0; y < rows.height(); ++y) std::memset(rows.row(y), 0, rows.info.row_bytes());
    part = rows.crop({frame_.x_offset, frame_.y_offset, config.input.width, config.input.height});
    if (frame_.x_offset < 0 || frame_.y_offset < 0 || frame_.x_offset > rows.width() - part.width() ||
        frame_.y_offset > rows.height() - part.height()) {
      throw Error(Error::Data, fmt::format("{}: the first frame reaches beyond the image", name_));
    }
  } else if (config.input.width != rows.width() || config.input.height != rows.height()) {
    throw Error(Error::Data, fmt::format("{}: pictures of different sizes in one file", name_));
  }
  config.output.colorspace = rows.info.channels == 4 ? MODE_RGBA : MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA.rgba = reinterpret_cast<std::uint8_t*>(part.data);
  config.output.u.RGBA.stride = static_cast<int>(part.stride);
  config.output.u.RGBA.size =
      static_cast<std::size_t>(part.stride) * static_cast<std::size_t>(part.height() - 1) + part.info.row_bytes();
  status = WebPDecode(data.bytes, data.size, &config);
  WebPFreeDecBuffer(&config.output);
  if (status != VP8_STATUS_OK) fail(status);
}

void WebpDecoder::fail(VP8StatusCode status) const {
  switch (status) {
    case VP8_STATUS_NOT_ENOUGH_DATA:
    case VP8_STATUS_SUSPENDED:
      throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early", name_, file_.size()));
    case VP8_STATUS_OUT_OF_MEMORY: throw Error(Error::Resource, fmt::format("{}: no memory left", name_));
    case VP8_STATUS_UNSUPPORTED_FEATURE:
      throw Error(Error::Unsupported, fmt::format("{}: a feature of WebP that libwebp doesn't know", name_));
    default: throw Error(Error::Data, fmt::format("{}: the WebP data is damaged", name_));
  }
}

/// Gathers the whole image, as libwebp needs it, and encodes it at the end.
class WebpEncoder final : public Encoder {
 public:
  WebpEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions& options)
      : output_(output),
        info_(info),
        metadata_(metadata),
        options_(options),
        pixels_(info.row_bytes() * static_cast<std::size_t>(info.height)) {}

  void write(const ConstAnyView& rows) override {
    for (int y = 0; y < rows.height(); ++y) {
      std::memcpy(pixels_.data() + filled_, rows.row(y), info_.row_bytes());
      filled_ += info_.row_bytes();
    }
  }
  void finish() override;

 private:
  void encode(WebPMemoryWriter& writer);
  void write_with_metadata(const WebPData& image);
  [[noreturn]] void fail(int code) const {
    throw Error(code == VP8_ENC_ERROR_OUT_OF_MEMORY ? Error::Resource : Error::Unsupported,
                fmt::format("{}: libwebp refused the image with code {}", output_.name(), code));
  }

  Output& output_;
  ImageInfo info_;
  Metadata metadata_;
  WriteOptions options_;
  std::vector<std::uint8_t> pixels_;
  std::size_t filled_ = 0;
};

void WebpEncoder::encode(WebPMemoryWriter& writer) {
  WebPConfig config;
  WebPPicture picture;
  if (WebPConfigInit(&config) == 0 || WebPPictureInit(&picture) == 0) {
    throw Error(Error::Unsupported, "an incompatible libwebp");
  }
  config.quality = static_cast<float>(options_.lossless ? 75 : options_.quality);
  config.lossless = options_.lossless ? 1 : 0;
  config.exact = 1;  // colours under transparent pixels are kept
  picture.use_argb = config.lossless;
  picture.width = info_.width;
  picture.height = info_.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  const auto stride = static_cast<int>(info_.row_bytes());
  const bool encoded = (info_.channels == 4 ? WebPPictureImportRGBA(&picture, pixels_.data(), stride)
                                            : WebPPictureImportRGB(&picture, pixels_.data(), stride)) != 0 &&
                       WebPEncode(&config, &picture) != 0;
  const int code = picture.error_code;
  WebPPictureFree(&picture);
  if (!encoded) fail(code);
}

void WebpEncoder::finish() {
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> owner(&writer, WebPMemoryWriterClear);
  encode(writer);
  if (metadata_.exif.empty() && metadata_.xmp.empty()) {
    output_.write(std::as_bytes(std::span(writer.mem, writer.size)));
  } else {
    write_with_metadata(borrowed(writer.mem, writer.size));
  }
}

void WebpEncoder::write_with_metadata(const WebPData& image) {
  const Mux mux(WebPMuxNew());
  if (!mux) throw Error(Error::Resource, fmt::format("{}: no memory left", output_.name()));
  const WebPData exif = borrowed(metadata_.exif.data(), metadata_.exif.size());
  const WebPData xmp = borrowed(metadata_.xmp.data(), metadata_.xmp.size());
  WebPData file{};
  const bool assembled = WebPMuxSetImage(mux.get(), &image, 0) == WEBP_MUX_OK &&
                         (exif.size == 0 || WebPMuxSetChunk(mux.get(), "EXIF", &exif, 0) == WEBP_MUX_OK) &&
                         (xmp.size == 0 || WebPMuxSetChunk(mux.get(), "XMP ", &xmp, 0) == WEBP_MUX_OK) &&
                         WebPMuxAssemble(mux.get(), &file) == WEBP_MUX_OK;
  const std::unique_ptr<WebPData, decltype(&WebPDataClear)> owner(&file, WebPDataClear);
  if (!assembled) throw Error(Error::Resource, fmt::format("{}: can't put WebP's chunks together", output_.name()));
  output_.write(std::as_bytes(std::span(file.bytes, file.size)));
}

bool matches_webp(std::span<const std::byte> head, std::string_view) {
  return head.size() >= 12 && std::memcmp(head.data(), "RIFF", 4) == 0 && std::memcmp(head.data() + 8, "WEBP", 4) == 0;
}

std::unique_ptr<Decoder> decode_webp(std::shared_ptr<const Input> input, const ReadOptions&, const Run& run) {
  return std::make_unique<WebpDecoder>(std::move(input), run);
}

ImageInfo storable_in_webp(const ImageInfo& info, const WriteOptions&) {
  if (info.alpha == AlphaState::None && info.channels % 2 == 0) {
    throw Error(Error::Unsupported,
                fmt::format("WebP can't hold {} channels without alpha; TIFF and OpenEXR can", info.channels));
  }
  ImageInfo result = info;
  result.type = PixelType::U8;
  result.channels = info.alpha == AlphaState::None ? 3 : 4;
  if (info.alpha != AlphaState::None) result.alpha = AlphaState::Straight;
  if (info.color == ColorState::Linear) result.color = ColorState::Srgb;
  return result;
}

std::unique_ptr<Encoder> encode_webp(Output& output, const ImageInfo& info, const Metadata& metadata,
                                     const WriteOptions& options, const Run&) {
  if (info.width > WEBP_MAX_DIMENSION || info.height > WEBP_MAX_DIMENSION) {
    throw Error(Error::Argument, fmt::format("{}: WebP holds at most {} pixels a side, the image has {}×{}",
                                             output.name(), WEBP_MAX_DIMENSION, info.width, info.height));
  }
  if (options.quality < 1 || options.quality > 100) {
    throw Error(Error::Argument, fmt::format("{}: quality {}, 1 to 100 expected", output.name(), options.quality));
  }
  return std::make_unique<WebpEncoder>(output, info, metadata, options);
}

}  // namespace

const Codec kWebpCodec = {"webp", {"webp"}, matches_webp, decode_webp, storable_in_webp, encode_webp};

}  // namespace azulejo
