#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"
#include "azulejo/io/decoded_size.h"
#include "azulejo/io/png.h"
#include "azulejo/io/png_chunks.h"
#include "azulejo/io/utf8.h"

namespace azulejo {
namespace {

/// What libpng's callbacks leave behind: libpng leaves them by longjmp, so nothing there may need a destructor.
struct Trouble {
  const Run* run = nullptr;
  std::string name;
  std::string message;
  std::exception_ptr thrown;

  /// Throws what happened; `where` says what was being done.
  [[noreturn]] void raise(const std::string& where) const {
    if (thrown) std::rethrow_exception(thrown);
    throw Error(Error::Data, fmt::format("{}: {}: {}", name, where, message));
  }
};

void on_error(png_structp png, png_const_charp message) {
  static_cast<Trouble*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp png, png_const_charp message) {
  const auto* const trouble = static_cast<Trouble*>(png_get_error_ptr(png));
  warn(*trouble->run, fmt::format("{}: PNG: {}", trouble->name, message));
}

/// Runs `calls`, which calls libpng and owns nothing; returns whether libpng finished them.
template <class Calls>
[[gnu::noinline]] bool guarded(png_structp png, const Calls& calls) {
  // NOLINTNEXTLINE(cert-err52-cpp): libpng knows no other way
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  calls();
  return true;
}

/// Runs `body` in a callback of libpng: exceptions can't pass through libpng's frames, so they wait in `trouble`.
template <class Body>
bool caught(Trouble& trouble, const Body& body) {
  try {
    body();
    return true;
  } catch (...) {
    trouble.thrown = std::current_exception();
    return false;
  }
}

class PngDecoder final : public Decoder {
 public:
  PngDecoder(std::shared_ptr<const Input> input, const Run& run);
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  ~PngDecoder() override { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool streams() const override { return !interlaced_; }
  void read(const AnyView& rows) override;

 private:
  static void on_read(png_structp png, png_bytep bytes, std::size_t count);
  void read_header();
  void describe_pixels();
  void check_size() const;
  void read_profile();
  void read_metadata();
  void read_text();
  void finish();

  Run run_;
  std::shared_ptr<const Input> input_;
  ByteReader reader_;
  Trouble trouble_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  bool interlaced_ = false;
  int next_row_ = 0;
};

PngDecoder::PngDecoder(std::shared_ptr<const Input> input, const Run& run)
    : run_(run), input_(std::move(input)), reader_(input_) {
  trouble_.run = &run_;
  trouble_.name = input_->name();
  png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &trouble_, on_error, on_warning);
  info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  if (info_ == nullptr) {
    png_destroy_read_struct(&png_, nullptr, nullptr);
    throw Error(Error::Resource, fmt::format("{}: no memory for libpng", trouble_.name));
  }
  try {
    read_header();
  } catch (...) {
    png_destroy_read_struct(&png_, &info_, nullptr);
    throw;
  }
}

void PngDecoder::on_read(png_structp png, png_bytep bytes, std::size_t count) {
  auto* const self = static_cast<PngDecoder*>(png_get_io_ptr(png));
  if (!caught(self->trouble_, [&] { self->reader_.read({reinterpret_cast<std::byte*>(bytes), count}); })) {
    png_error(png, "can't read");
  }
}

void PngDecoder::read_header() {
  scan_png_chunks(*input_, run_, header_.file.metadata);
  const bool done = guarded(png_, [this] {
    png_set_read_fn(png_, this, on_read);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // describe_pixels has ours
    png_set_chunk_malloc_max(png_, kLongestPngChunk);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
#ifdef PNG_SKIP_sRGB_CHECK_PROFILE
    png_set_option(png_, PNG_SKIP_sRGB_CHECK_PROFILE, PNG_OPTION_ON);
#endif
    png_read_info(png_, info_);
    if (png_get_bit_depth(png_, info_) == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
    if (png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (png_get_bit_depth(png_, info_) < 8) png_set_expand_gray_1_2_4_to_8(png_);
    if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(png_);
    png_set_interlace_handling(png_);
  });
  if (!done) trouble_.raise(fmt::format("byte {}", reader_.position()));
  describe_pixels();
  check_size();
  if (!guarded(png_, [this] { png_read_update_info(png_, info_); })) trouble_.raise("header");
  read_profile();
  read_metadata();
}

void PngDecoder::describe_pixels() {
  const int color_type = png_get_color_type(png_, info_);
  const int bits = png_get_bit_depth(png_, info_);
  const bool gray = (color_type & PNG_COLOR_MASK_COLOR) == 0;
  const bool alpha = (color_type & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
  interlaced_ = png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE;
  header_.file.format = "png";
  header_.file.info = {.width = static_cast<int>(png_get_image_width(png_, info_)),
                       .height = static_cast<int>(png_get_image_height(png_, info_)),
                       .channels = (gray ? 1 : 3) + (alpha ? 1 : 0),
                       .type = bits == 16 ? PixelType::U16 : PixelType::U8,
                       .color = ColorState::Srgb,
                       .alpha = alpha ? AlphaState::Straight : AlphaState::None};
  header_.file.stored_width = header_.file.info.width;
  header_.file.stored_height = header_.file.info.height;
  header_.file.bits = bits;
  header_.file.encoding = color_type == PNG_COLOR_TYPE_PALETTE ? "palette" : gray ? "gray" : "rgb";
  if (alpha) header_.file.encoding += " with alpha";
  if (interlaced_) header_.file.encoding += ", interlaced";
}

/// Refuses what can't be true before anybody makes room for it: deflate packs at most 1032 bytes into one.
void PngDecoder::check_size() const {
  const png_uint_32 width = png_get_image_width(png_, info_);
  const png_uint_32 height = png_get_image_height(png_, info_);
  check_decoded_size(trouble_.name, width, height, run_);
  const std::uint64_t packed = std::uint64_t{png_get_rowbytes(png_, info_)} * height;
  if (packed / 1032 > input_->size()) {
    throw Error(Error::Data, fmt::format("{}: {}×{} pixels can't be packed into a file of {} bytes", trouble_.name,
                                         width, height, input_->size()));
  }
}

void PngDecoder::read_profile() {
  png_charp name = nullptr;
  int method = 0;
  png_bytep profile = nullptr;
  png_uint_32 length = 0;
  if (png_get_iCCP(png_, info_, &name, &method, &profile, &length) == PNG_INFO_iCCP) {
    header_.icc.assign(profile, profile + length);
    return;
  }
  double gamma = 0;
  int intent = 0;
  if (png_get_sRGB(png_, info_, &intent) == PNG_INFO_sRGB) return;
  if (png_get_gAMA(png_, info_, &gamma) == PNG_INFO_gAMA) header_.gamma = static_cast<float>(gamma);
}

void PngDecoder::read_metadata() {
  Metadata& metadata = header_.file.metadata;
  png_uint_32 x = 0;
  png_uint_32 y = 0;
  int unit = PNG_RESOLUTION_UNKNOWN;
  if (png_get_pHYs(png_, info_, &x, &y, &unit) == PNG_INFO_pHYs && unit == PNG_RESOLUTION_METER) {
    metadata.density_x = static_cast<float>(x);
    metadata.density_y = static_cast<float>(y);
  }
  png_uint_32 length = 0;
  png_bytep exif = nullptr;
  if (png_get_eXIf_1(png_, info_, &length, &exif) == PNG_INFO_eXIf) set_exif({exif, length}, metadata);
  read_text();
}

void PngDecoder::read_text() {
  Metadata& metadata = header_.file.metadata;
  png_textp text = nullptr;
  int count = 0;
  png_get_text(png_, info_, &text, &count);
  for (int i = 0; i < count; ++i) {
    const bool international = text[i].compression > 0;
    const std::size_t length = international ? text[i].itxt_length : text[i].text_length;
    if (std::strcmp(text[i].key, kXmpKeyword) == 0) {
      metadata.xmp.assign(text[i].text, text[i].text + length);
    } else {
      const std::string_view value(text[i].text, length);
      metadata.text.emplace(text[i].key, international ? std::string(value) : utf8_from_latin1(value));
    }
  }
}

void PngDecoder::read(const AnyView& rows) {
  const int passes = interlaced_ ? 7 : 1;
  int y = 0;
  const bool done = guarded(png_, [&] {
    for (int pass = 0; pass < passes; ++pass) {
      for (y = 0; y < rows.height(); ++y) png_read_row(png_, reinterpret_cast<png_bytep>(rows.row(y)), nullptr);
    }
  });
  if (!done) trouble_.raise(fmt::format("row {}, byte {}", next_row_ + y, reader_.position()));
  next_row_ += rows.height();
  if (next_row_ == header_.file.info.height) finish();
}

/// The chunks behind the pixels and the end of the file: damage there is damage too.
void PngDecoder::finish() {
  if (!guarded(png_, [this] { png_read_end(png_, nullptr); })) {
    trouble_.raise(fmt::format("behind the pixels, byte {}", reader_.position()));
  }
}

}  // namespace

std::unique_ptr<Decoder> decode_png(std::shared_ptr<const Input> input, const ReadOptions& /*options*/,
                                    const Run& run) {
  return std::make_unique<PngDecoder>(std::move(input), run);
}

}  // namespace azulejo
