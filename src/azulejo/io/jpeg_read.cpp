#include <jerror.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/decoded_size.h"
#include "azulejo/io/exif.h"
#include "azulejo/io/jpeg.h"

namespace azulejo {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 16;
/// A progressive file of a few kilobytes can ask for thousands of passes over a large image; encoders make about 10.
constexpr int kMaxScans = 500;
constexpr float kInchesPerMetre = 1.0F / 0.0254F;

/// Feeds an Input to libjpeg.
struct JpegSource {
  jpeg_source_mgr manager{};  ///< first: libjpeg hands back a pointer to it
  JpegErrors* errors = nullptr;
  const Input* input = nullptr;
  std::uint64_t offset = 0;   ///< of the byte after the buffer
  std::uint64_t limit = 0;    ///< of the bytes that a header may take
  bool ended = false;         ///< the input ended, and libjpeg was given an end marker in its place
  std::exception_ptr thrown;  ///< by Input::read
  std::array<std::byte, kBuffer> buffer;

  /// Where libjpeg has got to.
  std::uint64_t position() const { return offset - std::min<std::uint64_t>(offset, manager.bytes_in_buffer); }
  bool refill() noexcept {
    std::size_t count = 0;
    try {
      count = input->read(offset, buffer);
    } catch (...) {
      thrown = std::current_exception();
      return false;
    }
    offset += count;
    if (count == 0) {
      ended = true;
      buffer[0] = std::byte{0xFF};
      buffer[1] = std::byte{JPEG_EOI};
      count = 2;
    }
    manager.next_input_byte = reinterpret_cast<const JOCTET*>(buffer.data());
    manager.bytes_in_buffer = count;
    return true;
  }
};

JpegSource& source_of(j_decompress_ptr codec) { return *reinterpret_cast<JpegSource*>(codec->src); }

boolean fill_input_buffer(j_decompress_ptr codec) {
  JpegSource& source = source_of(codec);
  if (source.offset > source.limit) leave_jpeg(*source.errors, "a header of more bytes than the memory limit");
  if (!source.refill()) leave_jpeg(*source.errors, "can't read");
  return TRUE;
}

void skip_input_data(j_decompress_ptr codec, long count) {
  if (count <= 0) return;
  JpegSource& source = source_of(codec);
  const auto bytes = static_cast<std::size_t>(count);
  const std::size_t buffered = std::min(bytes, source.manager.bytes_in_buffer);
  source.manager.next_input_byte += buffered;
  source.manager.bytes_in_buffer -= buffered;
  source.offset += bytes - buffered;
}

void do_nothing(j_decompress_ptr) {}

/// Looks after the passes that libjpeg makes over a progressive file before it gives a pixel.
struct JpegProgress {
  jpeg_progress_mgr manager{};  ///< first: libjpeg hands back a pointer to it
  JpegErrors* errors = nullptr;
  const Run* run = nullptr;
};

void look_after_scans(j_common_ptr codec) {
  const JpegProgress& progress = *reinterpret_cast<JpegProgress*>(codec->progress);
  const auto* decompress = reinterpret_cast<j_decompress_ptr>(codec);
  if (decompress->input_scan_number > kMaxScans) leave_jpeg(*progress.errors, "more than 500 scans");
  if (progress.run->cancel != nullptr && progress.run->cancel->cancelled()) leave_jpeg(*progress.errors, "cancelled");
}

std::string_view sampling_name(const jpeg_decompress_struct& codec) {
  if (codec.num_components == 1) return "gray";
  const jpeg_component_info* each = codec.comp_info;
  const int across = each[0].h_samp_factor * 10 / each[1].h_samp_factor;
  const int down = each[0].v_samp_factor * 10 / each[1].v_samp_factor;
  if (across == 10 && down == 10) return "4:4:4";
  if (across == 20 && down == 10) return "4:2:2";
  if (across == 20 && down == 20) return "4:2:0";
  if (across == 10 && down == 20) return "4:4:0";
  if (across == 40 && down == 10) return "4:1:1";
  if (across == 40 && down == 20) return "4:1:0";
  return "uncommon sampling";
}

std::string encoding_name(jpeg_decompress_struct& codec) {
  const char* process = codec.progressive_mode            ? "progressive"
                        : jpeg_has_multiple_scans(&codec) ? "sequential, several scans"
                                                          : "sequential";
  std::string name = fmt::format("{}, {}", process, sampling_name(codec));
  if (codec.arith_code) name += ", arithmetic";
  if (codec.jpeg_color_space == JCS_CMYK) name += ", CMYK";
  if (codec.jpeg_color_space == JCS_YCCK) name += ", YCCK";
  return name;
}

/// The bytes of a saved marker after `mark`, if it begins so.
std::span<const std::uint8_t> after_mark(const jpeg_marker_struct& marker, std::string_view mark) {
  if (marker.data_length < mark.size() || std::memcmp(marker.data, mark.data(), mark.size()) != 0) return {};
  return {marker.data + mark.size(), marker.data_length - mark.size()};
}

template <std::size_t N>
constexpr std::string_view with_zero(const char (&text)[N]) {
  return {text, N};
}

/// Puts the chunks of a profile together: each says its number, from 1, and how many there are. Empty where a
/// chunk is missing, double or out of range.
/// Source: ICC.1:2010, annex B.4
std::vector<std::uint8_t> joined_profile(const jpeg_decompress_struct& codec, bool& damaged) {
  std::array<std::span<const std::uint8_t>, 256> chunks;
  std::size_t count = 0;
  for (const jpeg_marker_struct* each = codec.marker_list; each != nullptr; each = each->next) {
    if (each->marker != JPEG_APP0 + 2) continue;
    const auto chunk = after_mark(*each, with_zero(kIccMark));
    if (chunk.size() < 2) continue;
    if (count == 0) count = chunk[1];
    if (chunk[0] < 1 || chunk[0] > count || chunk[1] != count || !chunks[chunk[0]].empty() || chunk.size() < 3) {
      damaged = true;
      return {};
    }
    chunks[chunk[0]] = chunk.subspan(2);
  }
  std::vector<std::uint8_t> profile;
  for (std::size_t i = 1; i <= count; ++i) {
    if (chunks[i].empty()) damaged = true;
    profile.insert(profile.end(), chunks[i].begin(), chunks[i].end());
  }
  if (damaged) profile.clear();
  return profile;
}

class JpegDecoder final : public Decoder {
 public:
  JpegDecoder(std::shared_ptr<const Input> input, const Run& run) : input_(std::move(input)), run_(run) {
    codec_.err = set_up_jpeg_errors(errors_);
    if (!jpeg_guarded(errors_, [this] { jpeg_create_decompress(&codec_); })) throw_failure();
    try {
      read_header();
    } catch (...) {
      jpeg_destroy_decompress(&codec_);
      throw;
    }
  }
  ~JpegDecoder() override { jpeg_destroy_decompress(&codec_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  bool streams() const override { return streams_; }
  void read(const AnyView& rows) override;

 private:
  void read_header();
  void set_up_source();
  void describe_pixels();
  void collect_metadata();
  void check_memory() const;
  void finish();
  void report_warnings();
  [[noreturn]] void throw_failure() const;
  const std::string& name() const { return input_->name(); }

  std::shared_ptr<const Input> input_;
  Run run_;
  JpegErrors errors_;
  JpegSource source_;
  JpegProgress progress_;
  jpeg_decompress_struct codec_{};
  bool streams_ = true;
  bool started_ = false;
};

void JpegDecoder::set_up_source() {
  source_.errors = progress_.errors = &errors_;
  source_.input = input_.get();
  source_.limit = static_cast<std::uint64_t>(run_.limits.memory_bytes);
  source_.manager.init_source = do_nothing;
  source_.manager.fill_input_buffer = fill_input_buffer;
  source_.manager.skip_input_data = skip_input_data;
  source_.manager.resync_to_restart = jpeg_resync_to_restart;
  source_.manager.term_source = do_nothing;
  progress_.run = &run_;
  progress_.manager.progress_monitor = look_after_scans;
  codec_.src = &source_.manager;
  codec_.progress = &progress_.manager;
  codec_.mem->max_memory_to_use = static_cast<long>(run_.limits.memory_bytes);
}

void JpegDecoder::read_header() {
  set_up_source();
  const bool read = jpeg_guarded(errors_, [this] {
    jpeg_save_markers(&codec_, JPEG_APP0 + 1, 0xFFFF);
    jpeg_save_markers(&codec_, JPEG_APP0 + 2, 0xFFFF);
    jpeg_save_markers(&codec_, JPEG_COM, 0xFFFF);
    jpeg_read_header(&codec_, TRUE);
  });
  if (!read) throw_failure();
  source_.limit = UINT64_MAX;
  check_decoded_size(name(), codec_.image_width, codec_.image_height, run_);
  describe_pixels();
  streams_ = !jpeg_has_multiple_scans(&codec_);
  if (!streams_) check_memory();
  collect_metadata();
  report_warnings();
}

void JpegDecoder::describe_pixels() {
  ImageFile& file = header_.file;
  file.format = "jpeg";
  file.stored_width = static_cast<int>(codec_.image_width);
  file.stored_height = static_cast<int>(codec_.image_height);
  file.info = {.width = file.stored_width, .height = file.stored_height, .channels = 3};
  file.encoding = encoding_name(codec_);
  switch (codec_.jpeg_color_space) {
    case JCS_GRAYSCALE:
      codec_.out_color_space = JCS_GRAYSCALE;
      file.info.channels = 1;
      break;
    case JCS_RGB:
    case JCS_YCbCr: codec_.out_color_space = JCS_RGB; break;
    case JCS_CMYK:
    case JCS_YCCK:
      codec_.out_color_space = JCS_CMYK;
      file.info.channels = 4;
      header_.cmyk = true;
      break;
    default:
      throw Error(Error::Unsupported, fmt::format("{}: header: {} components of unknown colour, 1, 3 or 4 expected",
                                                  name(), codec_.num_components));
  }
}

/// Files of several scans are held as coefficients, 2 bytes each.
void JpegDecoder::check_memory() const {
  std::uint64_t bytes = 0;
  for (int i = 0; i < codec_.num_components; ++i) {
    const jpeg_component_info& each = codec_.comp_info[i];
    bytes += std::uint64_t{each.width_in_blocks} * each.height_in_blocks * DCTSIZE2 * sizeof(JCOEF);
  }
  check_decoder_memory(name(), "a JPEG of several scans", bytes, run_);
}

void JpegDecoder::collect_metadata() {
  Metadata& metadata = header_.file.metadata;
  if (codec_.saw_JFIF_marker && codec_.density_unit != 0) {
    const float scale = codec_.density_unit == 1 ? kInchesPerMetre : 100.0F;
    metadata.density_x = static_cast<float>(codec_.X_density) * scale;
    metadata.density_y = static_cast<float>(codec_.Y_density) * scale;
  }
  for (const jpeg_marker_struct* each = codec_.marker_list; each != nullptr; each = each->next) {
    if (each->marker == JPEG_COM) {
      metadata.text["comment"].assign(reinterpret_cast<const char*>(each->data), each->data_length);
    } else if (each->marker == JPEG_APP0 + 1) {
      const auto exif = after_mark(*each, with_zero(kExifMark));
      const auto xmp = after_mark(*each, with_zero(kXmpMark));
      if (!exif.empty() && metadata.exif.empty()) metadata.exif.assign(exif.begin(), exif.end());
      if (!xmp.empty() && metadata.xmp.empty()) metadata.xmp.assign(xmp.begin(), xmp.end());
    }
  }
  const ExifSummary exif = parse_exif(metadata.exif);
  header_.file.orientation = exif.orientation;
  if (metadata.density_x == 0) metadata.density_x = exif.density_x;
  if (metadata.density_y == 0) metadata.density_y = exif.density_y;

  bool damaged = false;
  header_.icc = joined_profile(codec_, damaged);
  if (damaged)
    warn(run_, fmt::format("{}: header: the parts of the colour profile don't fit together: ignored", name()));
}

void JpegDecoder::read(const AnyView& rows) {
  std::vector<JSAMPROW> pointers(static_cast<std::size_t>(rows.height()));
  for (int y = 0; y < rows.height(); ++y) {
    pointers[static_cast<std::size_t>(y)] = reinterpret_cast<JSAMPROW>(rows.row(y));
  }
  const auto count = static_cast<JDIMENSION>(rows.height());
  JSAMPARRAY lines = pointers.data();
  const bool read = jpeg_guarded(errors_, [this, lines, count] {
    if (!started_) {
      jpeg_start_decompress(&codec_);
      started_ = true;
    }
    for (JDIMENSION done = 0; done < count;) done += jpeg_read_scanlines(&codec_, lines + done, count - done);
  });
  if (!read) throw_failure();
  // Adobe's programs store 255 for no ink, and mark the file.
  if (header_.cmyk && codec_.saw_Adobe_marker) {
    for (JSAMPROW row : pointers) {
      std::transform(row, row + rows.info.row_bytes(), row, [](JSAMPLE v) { return static_cast<JSAMPLE>(255 - v); });
    }
  }
  if (codec_.output_scanline == codec_.output_height) finish();
  report_warnings();
}

/// Reads up to the end marker: damage may show only there.
void JpegDecoder::finish() {
  if (!jpeg_guarded(errors_, [this] { jpeg_finish_decompress(&codec_); })) throw_failure();
  if (source_.ended)
    warn(run_, fmt::format("{}: byte {}: the file ends without its end marker", name(), input_->size()));
}

void JpegDecoder::report_warnings() {
  if (errors_.warnings == 0) return;
  const std::string more = errors_.warnings > 1 ? fmt::format(" (and {} more)", errors_.warnings - 1) : "";
  warn(run_, fmt::format("{}: byte {}: {}{}", name(), source_.position(), errors_.first_warning, more));
  errors_.warnings = 0;
}

void JpegDecoder::throw_failure() const {
  if (source_.thrown) std::rethrow_exception(source_.thrown);
  check_cancelled(run_);
  Error::Kind kind = Error::Data;
  switch (errors_.code) {
    case JERR_OUT_OF_MEMORY:
    case JERR_NO_BACKING_STORE: kind = Error::Resource; break;
    case JERR_BAD_PRECISION: kind = errors_.manager.msg_parm.i[0] == 12 ? Error::Unsupported : Error::Data; break;
    case JERR_SOF_UNSUPPORTED:
    case JERR_CONVERSION_NOTIMPL:
    case JERR_CCIR601_NOTIMPL:
    case JERR_FRACT_SAMPLE_NOTIMPL:
    case JERR_NOTIMPL: kind = Error::Unsupported; break;
    default: break;
  }
  if (source_.ended) {
    throw Error(Error::Data,
                fmt::format("{}: byte {}: the file ends too early ({})", name(), input_->size(), errors_.message));
  }
  throw Error(kind, fmt::format("{}: byte {}: {}", name(), source_.position(), errors_.message));
}

}  // namespace

std::unique_ptr<Decoder> decode_jpeg(std::shared_ptr<const Input> input, const ReadOptions&, const Run& run) {
  return std::make_unique<JpegDecoder>(std::move(input), run);
}

}  // namespace azulejo
