#include "azulejo/io/tiff_file.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <span>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

namespace azulejo {
namespace {

constexpr std::size_t kMaxPages = 65535;
constexpr std::size_t kMaxWarnings = 8;

/// The message on one line: it may quote bytes of the file.
std::string formatted(const char* format, va_list arguments) {
  std::array<char, 512> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  std::string message(text.data());
  for (char& each : message) {
    if (static_cast<unsigned char>(each) < ' ' || each == '\x7F') each = '?';
  }
  while (!message.empty() && message.back() == '.') message.pop_back();
  return message;
}

/// Numbers of the byte order that the file begins with.
class TiffNumbers {
 public:
  explicit TiffNumbers(const Input& input) : input_(input) {
    std::array<std::byte, 2> mark{};
    known_ = input.read(0, mark) == 2 && mark[0] == mark[1] && (mark[0] == std::byte{'I'} || mark[0] == std::byte{'M'});
    big_endian_ = mark[0] == std::byte{'M'};
  }
  bool known() const { return known_; }
  /// False where the file ends before.
  bool get(std::uint64_t offset, std::size_t size, std::uint64_t& value) const {
    std::array<std::byte, 8> bytes{};
    if (input_.read(offset, std::span(bytes).first(size)) != size) return false;
    value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      value = value << 8U | std::to_integer<std::uint64_t>(bytes[big_endian_ ? i : size - 1 - i]);
    }
    return true;
  }

 private:
  const Input& input_;
  bool known_ = false;
  bool big_endian_ = false;
};

}  // namespace

TiffFile::TiffFile(std::shared_ptr<const Input> input, std::uint64_t directory, const Limits& limits)
    : name_(input->name()), input_(std::move(input)) {
  open("rm", limits);  // m: no memory mapping
  if (TIFFCurrentDirOffset(handle_) == directory || TIFFSetSubDirectory(handle_, directory) != 0) return;
  TIFFClose(std::exchange(handle_, nullptr));
  fail(Error::Data, fmt::format("directory at byte {}", directory));
}

TiffFile::TiffFile(Output& output, bool big) : name_(output.name()), output_(&output) { open(big ? "w8" : "w", {}); }

TiffFile::~TiffFile() {
  if (handle_ != nullptr) TIFFClose(handle_);
}

void TiffFile::open(const char* mode, const Limits& limits) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (options == nullptr) throw Error(Error::Resource, fmt::format("{}: no memory left", name_));
  TIFFOpenOptionsSetErrorHandlerExtR(options, note_error, this);
  TIFFOpenOptionsSetWarningHandlerExtR(options, note_warning, this);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(limits.memory_bytes));
  const auto close = [](thandle_t) { return 0; };
  handle_ = TIFFClientOpenExt(name_.c_str(), mode, this, read, write, seek, close, size_of, nullptr, nullptr, options);
  TIFFOpenOptionsFree(options);
  if (handle_ == nullptr) fail(input_ ? Error::Data : Error::Io, "header");
}

void TiffFile::close() {
  const bool flushed = TIFFFlush(handle_) != 0;
  TIFFClose(std::exchange(handle_, nullptr));
  if (!flushed || thrown_) fail(Error::Io, "directory");
}

void TiffFile::fail(Error::Kind kind, const std::string& place) {
  if (thrown_) std::rethrow_exception(thrown_);
  throw Error(kind, fmt::format("{}: {}: {}", name_, place, error_.empty() ? "damaged" : error_));
}

std::vector<std::string> TiffFile::take_warnings() {
  if (!error_.empty()) keep_warning(std::exchange(error_, {}));
  return std::exchange(warnings_, {});
}

std::uint64_t TiffFile::size() const { return input_ ? input_->size() : output_->size(); }

tmsize_t TiffFile::read(thandle_t client, void* bytes, tmsize_t count) {
  TiffFile& file = *static_cast<TiffFile*>(client);
  const std::span target(static_cast<std::byte*>(bytes), static_cast<std::size_t>(count));
  try {
    const std::size_t got = file.input_ ? file.input_->read(file.position_, target) : file.output_->read(target);
    file.position_ += got;
    return static_cast<tmsize_t>(got);
  } catch (...) {
    file.thrown_ = std::current_exception();
    return -1;
  }
}

tmsize_t TiffFile::write(thandle_t client, void* bytes, tmsize_t count) {
  TiffFile& file = *static_cast<TiffFile*>(client);
  if (file.output_ == nullptr) return -1;
  try {
    file.output_->write({static_cast<const std::byte*>(bytes), static_cast<std::size_t>(count)});
    return count;
  } catch (...) {
    file.thrown_ = std::current_exception();
    return -1;
  }
}

toff_t TiffFile::seek(thandle_t client, toff_t offset, int whence) {
  TiffFile& file = *static_cast<TiffFile*>(client);
  try {
    const std::uint64_t here = file.input_ ? file.position_ : file.output_->position();
    const std::uint64_t start = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? here : file.size();
    if (file.output_ != nullptr) file.output_->seek(start + offset);
    return file.position_ = start + offset;
  } catch (...) {
    file.thrown_ = std::current_exception();
    return static_cast<toff_t>(-1);
  }
}

toff_t TiffFile::size_of(thandle_t client) { return static_cast<TiffFile*>(client)->size(); }

int TiffFile::note_error(TIFF*, void* self, const char*, const char* format, va_list arguments) {
  TiffFile& file = *static_cast<TiffFile*>(self);
  // Of several complaints the last is the one that libtiff gave up for.
  file.error_ = file.without_name(formatted(format, arguments));
  return 1;  // handled: libtiff's own handler, which prints, is not called
}

int TiffFile::note_warning(TIFF*, void* self, const char*, const char* format, va_list arguments) {
  TiffFile& file = *static_cast<TiffFile*>(self);
  std::string message = file.without_name(formatted(format, arguments));
  // Private tags are no damage.
  if (!message.starts_with("Unknown field with tag")) file.keep_warning(std::move(message));
  return 1;
}

std::string TiffFile::without_name(std::string message) const {
  const std::string start = name_ + ": ";
  return message.starts_with(start) ? message.substr(start.size()) : message;
}

void TiffFile::keep_warning(std::string message) {
  const bool known = std::find(warnings_.begin(), warnings_.end(), message) != warnings_.end();
  if (!known && warnings_.size() < kMaxWarnings) warnings_.push_back(std::move(message));
}

std::vector<std::uint64_t> tiff_pages(const Input& input) {
  std::vector<std::uint64_t> pages;
  const TiffNumbers numbers(input);
  std::uint64_t version = 0;
  if (!numbers.known() || !numbers.get(2, 2, version) || (version != 42 && version != 43)) return pages;
  const bool big = version == 43;
  const std::size_t offset_size = big ? 8 : 4;
  std::uint64_t directory = 0;
  if (!numbers.get(big ? 8 : 4, offset_size, directory)) return pages;
  std::unordered_set<std::uint64_t> seen;
  while (directory != 0 && directory < input.size() && pages.size() < kMaxPages && seen.insert(directory).second) {
    pages.push_back(directory);
    std::uint64_t entries = 0;
    if (!numbers.get(directory, big ? 8 : 2, entries) || entries > input.size()) break;
    const std::uint64_t next = directory + (big ? 8 : 2) + entries * (big ? 20 : 12);
    if (!numbers.get(next, offset_size, directory)) break;
  }
  return pages;
}

}  // namespace azulejo
