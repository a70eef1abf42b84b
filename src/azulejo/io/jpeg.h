#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <type_traits>

// jpeglib.h needs <cstdio> before it.
#include <jpeglib.h>

#include "azulejo/io/codec.h"

namespace azulejo {

/// libjpeg's errors without its exit() and its printing. libjpeg must be left by longjmp: no exception may cross
/// its C frames, and no object with a destructor may live between `jpeg_guarded` and the call into libjpeg.
struct JpegErrors {
  jpeg_error_mgr manager;  ///< first: libjpeg hands back a pointer to it
  std::jmp_buf jump;
  char message[JMSG_LENGTH_MAX];        ///< of the error that ended a guarded call
  int code;                             ///< of that error
  char first_warning[JMSG_LENGTH_MAX];  ///< of damage that decoding goes on after
  int warnings;                         ///< how many there were
};

/// Prepares `errors`; its manager goes into the `err` of a libjpeg structure.
jpeg_error_mgr* set_up_jpeg_errors(JpegErrors& errors);

/// Ends a guarded call from one of our own callbacks.
[[noreturn]] void leave_jpeg(JpegErrors& errors, const char* message);

/// Calls f(), which calls libjpeg; false where libjpeg gave up: `errors` says why.
template <class F>
[[nodiscard]] bool jpeg_guarded(JpegErrors& errors, const F& f) {
  static_assert(std::is_trivially_destructible_v<F>);
  if (setjmp(errors.jump) != 0) return false;
  f();
  return true;
}

inline constexpr char kExifMark[] = "Exif\0";                       ///< 6 bytes with the closing zero
inline constexpr char kXmpMark[] = "http://ns.adobe.com/xap/1.0/";  ///< 29 bytes with the closing zero
inline constexpr char kIccMark[] = "ICC_PROFILE";                   ///< 12 bytes with the closing zero

extern const Codec kJpegCodec;

std::unique_ptr<Decoder> decode_jpeg(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);
ImageInfo storable_in_jpeg(const ImageInfo& info, const WriteOptions& options);
std::unique_ptr<Encoder> encode_jpeg(Output& output, const ImageInfo& info, const Metadata& metadata,
                                     const WriteOptions& options, const Run& run);

}  // namespace azulejo
