#include "azulejo/io/jpeg.h"

#include <jerror.h>

#include <cstring>

namespace azulejo {
namespace {

JpegErrors& errors_of(j_common_ptr codec) { return *reinterpret_cast<JpegErrors*>(codec->err); }

void fail(j_common_ptr codec) {
  JpegErrors& errors = errors_of(codec);
  errors.code = codec->err->msg_code;
  codec->err->format_message(codec, errors.message);
  std::longjmp(errors.jump, 1);
}

/// Damage after which libjpeg's pixels are guesses ends the decoding; the rest is counted.
bool spoils_pixels(int code) {
  return code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE || code == JWRN_ARITH_BAD_CODE ||
         code == JWRN_MUST_RESYNC || code == JWRN_BOGUS_PROGRESSION;
}

void note(j_common_ptr codec, int level) {
  if (level >= 0) return;  // traces
  if (spoils_pixels(codec->err->msg_code)) fail(codec);
  JpegErrors& errors = errors_of(codec);
  if (errors.warnings++ == 0) codec->err->format_message(codec, errors.first_warning);
}

void print_nothing(j_common_ptr) {}

bool matches_jpeg(std::span<const std::byte> head, std::string_view) {
  constexpr std::byte kStart[] = {std::byte{0xFF}, std::byte{0xD8}, std::byte{0xFF}};
  return head.size() >= sizeof kStart && std::memcmp(head.data(), kStart, sizeof kStart) == 0;
}

}  // namespace

jpeg_error_mgr* set_up_jpeg_errors(JpegErrors& errors) {
  jpeg_std_error(&errors.manager);
  errors.manager.error_exit = fail;
  errors.manager.emit_message = note;
  errors.manager.output_message = print_nothing;
  errors.message[0] = errors.first_warning[0] = '\0';
  errors.code = errors.warnings = 0;
  return &errors.manager;
}

void leave_jpeg(JpegErrors& errors, const char* message) {
  std::strncpy(errors.message, message, sizeof errors.message - 1);
  errors.message[sizeof errors.message - 1] = '\0';
  errors.code = 0;
  std::longjmp(errors.jump, 1);
}

const Codec kJpegCodec = {"jpeg",     {"jpg", "jpeg", "jpe", "jfif"}, matches_jpeg, decode_jpeg, storable_in_jpeg,
                          encode_jpeg};

}  // namespace azulejo
