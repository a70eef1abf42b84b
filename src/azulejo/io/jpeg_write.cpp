#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string_view>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/jpeg.h"

namespace azulejo {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 16;
/// Optimal Huffman tables make files 2–10 % smaller, and need all coefficients in memory: larger images go without.
constexpr std::uint64_t kMaxOptimizedBytes = std::uint64_t{256} << 20;
/// Above this quality the colours are kept at full resolution.
constexpr int kMaxSubsampledQuality = 90;
constexpr std::size_t kMaxMarkerBytes = 65533;

/// Takes libjpeg's bytes to an Output.
struct JpegSink {
  jpeg_destination_mgr manager{};  ///< first: libjpeg hands back a pointer to it
  JpegErrors* errors = nullptr;
  Output* output = nullptr;
  std::exception_ptr thrown;  ///< by Output::write
  std::array<std::byte, kBuffer> buffer;

  bool flush(std::size_t count) noexcept {
    try {
      output->write(std::span(buffer).first(count));
    } catch (...) {
      thrown = std::current_exception();
      return false;
    }
    manager.next_output_byte = reinterpret_cast<JOCTET*>(buffer.data());
    manager.free_in_buffer = kBuffer;
    return true;
  }
};

JpegSink& sink_of(j_compress_ptr codec) { return *reinterpret_cast<JpegSink*>(codec->dest); }

void init_destination(j_compress_ptr codec) {
  JpegSink& sink = sink_of(codec);
  sink.manager.next_output_byte = reinterpret_cast<JOCTET*>(sink.buffer.data());
  sink.manager.free_in_buffer = kBuffer;
}

boolean empty_output_buffer(j_compress_ptr codec) {
  JpegSink& sink = sink_of(codec);
  if (!sink.flush(kBuffer)) leave_jpeg(*sink.errors, "can't write");
  return TRUE;
}

void term_destination(j_compress_ptr codec) {
  JpegSink& sink = sink_of(codec);
  if (!sink.flush(kBuffer - sink.manager.free_in_buffer)) leave_jpeg(*sink.errors, "can't write");
}

class JpegEncoder final : public Encoder {
 public:
  JpegEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, int quality, const Run& run)
      : info_(info) {
    codec_.err = set_up_jpeg_errors(errors_);
    sink_.errors = &errors_;
    sink_.output = &output;
    sink_.manager.init_destination = init_destination;
    sink_.manager.empty_output_buffer = empty_output_buffer;
    sink_.manager.term_destination = term_destination;
    if (!jpeg_guarded(errors_, [this] { jpeg_create_compress(&codec_); })) throw_failure();
    try {
      start(metadata, quality);
      write_metadata(metadata, run);
    } catch (...) {
      jpeg_destroy_compress(&codec_);
      throw;
    }
  }
  ~JpegEncoder() override { jpeg_destroy_compress(&codec_); }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  void write(const ConstAnyView& rows) override;
  void finish() override {
    if (!jpeg_guarded(errors_, [this] { jpeg_finish_compress(&codec_); })) throw_failure();
  }

 private:
  void start(const Metadata& metadata, int quality);
  void set_density(const Metadata& metadata);
  void write_metadata(const Metadata& metadata, const Run& run);
  void write_marker(int marker, std::string_view mark, std::span<const std::uint8_t> bytes, const char* what,
                    const Run& run);
  [[noreturn]] void throw_failure() const {
    if (sink_.thrown) std::rethrow_exception(sink_.thrown);
    throw Error(Error::Resource, fmt::format("{}: {}", sink_.output->name(), errors_.message));
  }

  ImageInfo info_;
  JpegErrors errors_;
  JpegSink sink_;
  jpeg_compress_struct codec_{};
};

void JpegEncoder::start(const Metadata& metadata, int quality) {
  codec_.dest = &sink_.manager;
  codec_.image_width = static_cast<JDIMENSION>(info_.width);
  codec_.image_height = static_cast<JDIMENSION>(info_.height);
  codec_.input_components = info_.channels;
  codec_.in_color_space = info_.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  const auto samples = static_cast<std::uint64_t>(info_.row_bytes()) * static_cast<std::uint64_t>(info_.height);
  const bool optimize = samples * sizeof(JCOEF) <= kMaxOptimizedBytes;
  const bool started = jpeg_guarded(errors_, [this, quality, optimize, &metadata] {
    jpeg_set_defaults(&codec_);
    jpeg_set_quality(&codec_, quality, TRUE);
    codec_.optimize_coding = optimize ? TRUE : FALSE;
    if (quality > kMaxSubsampledQuality) codec_.comp_info[0].h_samp_factor = codec_.comp_info[0].v_samp_factor = 1;
    set_density(metadata);
    jpeg_start_compress(&codec_, TRUE);
  });
  if (!started) throw_failure();
}

/// JFIF knows whole pixels per inch or centimetre: the unit that comes closer is taken.
void JpegEncoder::set_density(const Metadata& metadata) {
  if (metadata.density_x <= 0 || metadata.density_y <= 0) return;
  const float per_inch[] = {metadata.density_x * 0.0254F, metadata.density_y * 0.0254F};
  const float per_centimetre[] = {metadata.density_x * 0.01F, metadata.density_y * 0.01F};
  const auto error = [](const float(&of)[2]) {
    return std::max(std::abs(of[0] - std::round(of[0])) / of[0], std::abs(of[1] - std::round(of[1])) / of[1]);
  };
  const bool inches = error(per_inch) <= error(per_centimetre);
  const auto whole = [](float value) { return static_cast<UINT16>(std::clamp(std::round(value), 1.0F, 65535.0F)); };
  codec_.density_unit = inches ? 1 : 2;
  codec_.X_density = whole(inches ? per_inch[0] : per_centimetre[0]);
  codec_.Y_density = whole(inches ? per_inch[1] : per_centimetre[1]);
}

void JpegEncoder::write_metadata(const Metadata& metadata, const Run& run) {
  write_marker(JPEG_APP0 + 1, {kExifMark, sizeof kExifMark}, metadata.exif, "EXIF", run);
  write_marker(JPEG_APP0 + 1, {kXmpMark, sizeof kXmpMark}, metadata.xmp, "XMP", run);
  if (const auto comment = metadata.text.find("comment"); comment != metadata.text.end()) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(comment->second.data());
    write_marker(JPEG_COM, {}, {bytes, comment->second.size()}, "the comment", run);
  }
}

void JpegEncoder::write_marker(int marker, std::string_view mark, std::span<const std::uint8_t> bytes, const char* what,
                               const Run& run) {
  if (bytes.empty()) return;
  if (mark.size() + bytes.size() > kMaxMarkerBytes) {
    warn(run, fmt::format("{}: {} has {} bytes, more than a JPEG marker holds: left out", sink_.output->name(), what,
                          bytes.size()));
    return;
  }
  std::vector<std::uint8_t> joined(mark.begin(), mark.end());
  joined.insert(joined.end(), bytes.begin(), bytes.end());
  const JOCTET* data = joined.data();
  const auto size = static_cast<unsigned>(joined.size());
  if (!jpeg_guarded(errors_, [this, marker, data, size] { jpeg_write_marker(&codec_, marker, data, size); })) {
    throw_failure();
  }
}

void JpegEncoder::write(const ConstAnyView& rows) {
  std::vector<JSAMPROW> pointers(static_cast<std::size_t>(rows.height()));
  for (int y = 0; y < rows.height(); ++y) {
    // libjpeg takes rows that it does not change as non-const.
    pointers[static_cast<std::size_t>(y)] = const_cast<JSAMPROW>(reinterpret_cast<const JSAMPLE*>(rows.row(y)));
  }
  const auto count = static_cast<JDIMENSION>(rows.height());
  JSAMPARRAY lines = pointers.data();
  const bool written = jpeg_guarded(errors_, [this, lines, count] {
    for (JDIMENSION done = 0; done < count;) done += jpeg_write_scanlines(&codec_, lines + done, count - done);
  });
  if (!written) throw_failure();
}

}  // namespace

ImageInfo storable_in_jpeg(const ImageInfo& info, const WriteOptions&) {
  if (info.alpha == AlphaState::None && info.channels % 2 == 0) {
    throw Error(Error::Unsupported,
                fmt::format("JPEG can't hold {} channels without alpha; TIFF and OpenEXR can", info.channels));
  }
  ImageInfo result = info;
  result.type = PixelType::U8;
  result.channels = info.color_channels() >= 3 ? 3 : 1;
  result.alpha = AlphaState::None;
  if (info.color == ColorState::Linear) result.color = ColorState::Srgb;
  return result;
}

std::unique_ptr<Encoder> encode_jpeg(Output& output, const ImageInfo& info, const Metadata& metadata,
                                     const WriteOptions& options, const Run& run) {
  if (info.width > JPEG_MAX_DIMENSION || info.height > JPEG_MAX_DIMENSION) {
    throw Error(Error::Argument, fmt::format("{}: JPEG holds at most {} pixels a side, the image has {}×{}",
                                             output.name(), JPEG_MAX_DIMENSION, info.width, info.height));
  }
  if (options.quality < 1 || options.quality > 100) {
    throw Error(Error::Argument, fmt::format("{}: quality {}, 1 to 100 expected", output.name(), options.quality));
  }
  return std::make_unique<JpegEncoder>(output, info, metadata, options.quality, run);
}

}  // namespace azulejo
