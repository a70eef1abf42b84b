#pragma once

#include <tiffio.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/core/run.h"
#include "azulejo/io/input.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// A libtiff handle over an Input or an Output. libtiff's messages stay in it and are never printed. Used by one
/// thread at a time; several handles may share an Input.
class TiffFile {
 public:
  /// Reads the directory (page) at byte `directory`. Throws Error(Data) with libtiff's reason.
  TiffFile(std::shared_ptr<const Input> input, std::uint64_t directory, const Limits& limits);
  /// Starts a file; `big` makes it a BigTIFF, for more than 4 GiB.
  TiffFile(Output& output, bool big);
  ~TiffFile();
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;

  TIFF* handle() const { return handle_; }
  /// Writes what is left; after this the handle is gone. Throws what writing threw.
  void close();
  /// Throws Error(kind) with the place and libtiff's complaint, or what the Input or Output threw.
  [[noreturn]] void fail(Error::Kind kind, const std::string& place);
  /// What libtiff grumbled about since the last call and went on all the same, each message once.
  std::vector<std::string> take_warnings();

 private:
  void open(const char* mode, const Limits& limits);
  std::uint64_t size() const;
  std::string without_name(std::string message) const;
  void keep_warning(std::string message);
  static tmsize_t read(thandle_t client, void* bytes, tmsize_t count);
  static tmsize_t write(thandle_t client, void* bytes, tmsize_t count);
  static toff_t seek(thandle_t client, toff_t offset, int whence);
  static toff_t size_of(thandle_t client);
  static int note_error(TIFF*, void* self, const char* module, const char* format, va_list arguments);
  static int note_warning(TIFF*, void* self, const char* module, const char* format, va_list arguments);

  std::string name_;
  std::shared_ptr<const Input> input_;
  Output* output_ = nullptr;
  TIFF* handle_ = nullptr;
  std::uint64_t position_ = 0;  ///< in input_
  std::exception_ptr thrown_;   ///< by input_ or output_: no exception may cross libtiff's C frames
  std::string error_;
  std::vector<std::string> warnings_;
};

/// Where the pages' directories begin. Ends where the chain leaves the file, comes back to a page or reaches 65535
/// pages. Empty if `input` isn't a TIFF or BigTIFF.
std::vector<std::uint64_t> tiff_pages(const Input& input);

}  // namespace azulejo
