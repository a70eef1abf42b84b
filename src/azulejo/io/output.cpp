#include "azulejo/io/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 18;

Error system_error(const std::string& name, const char* what) {
  return Error(Error::Io, fmt::format("{}: {}: {}", name, what, std::strerror(errno)));
}

void write_fully(int file, std::span<const std::byte> bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(name, "can't write");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

/// Writing, seeking and reading back in a vector.
class Bytes {
 public:
  explicit Bytes(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  void write(std::span<const std::byte> source) {
    const std::size_t end = position_ + source.size();
    if (end > bytes_.size()) bytes_.resize(end);
    if (!source.empty()) std::memcpy(bytes_.data() + position_, source.data(), source.size());
    position_ = end;
  }
  std::size_t read(std::span<std::byte> result) {
    const std::size_t count = position_ < bytes_.size() ? std::min(result.size(), bytes_.size() - position_) : 0;
    if (count > 0) std::memcpy(result.data(), bytes_.data() + position_, count);
    position_ += count;
    return count;
  }
  void seek(std::uint64_t offset) { position_ = static_cast<std::size_t>(offset); }
  std::uint64_t position() const { return position_; }
  std::uint64_t size() const { return bytes_.size(); }

 private:
  std::vector<std::byte>& bytes_;
  std::size_t position_ = 0;
};

class MemoryOutput final : public Output {
 public:
  MemoryOutput(std::vector<std::byte>& bytes, std::string name) : Output(std::move(name)), bytes_(bytes) {}
  void write(std::span<const std::byte> bytes) override { bytes_.write(bytes); }
  void seek(std::uint64_t offset) override { bytes_.seek(offset); }
  std::uint64_t position() const override { return bytes_.position(); }
  std::uint64_t size() const override { return bytes_.size(); }
  std::size_t read(std::span<std::byte> bytes) override { return bytes_.read(bytes); }
  void commit() override {}

 private:
  Bytes bytes_;
};

/// Standard output, a pipe or a device: nothing can be renamed onto it, so it gets everything at the end.
class StreamOutput final : public Output {
 public:
  StreamOutput(std::string name, std::string path) : Output(std::move(name)), path_(std::move(path)), bytes_(held_) {}
  void write(std::span<const std::byte> bytes) override { bytes_.write(bytes); }
  void seek(std::uint64_t offset) override { bytes_.seek(offset); }
  std::uint64_t position() const override { return bytes_.position(); }
  std::uint64_t size() const override { return bytes_.size(); }
  std::size_t read(std::span<std::byte> bytes) override { return bytes_.read(bytes); }
  void commit() override {
    if (path_.empty()) return write_fully(STDOUT_FILENO, held_, name());
    const int file = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) throw system_error(name(), "can't open");
    try {
      write_fully(file, held_, name());
    } catch (...) {
      close(file);
      throw;
    }
    if (close(file) != 0) throw system_error(name(), "can't write");
  }

 private:
  std::string path_;  ///< empty: standard output
  std::vector<std::byte> held_;
  Bytes bytes_;
};

/// A file beside the final one, with a leading dot, until it is renamed.
class FileOutput final : public Output {
 public:
  FileOutput(std::string name, std::string final_path, mode_t mode)
      : Output(std::move(name)), final_path_(std::move(final_path)) {
    buffer_.reserve(kBuffer);
    open_beside(mode);
  }
  FileOutput(const FileOutput&) = delete;
  FileOutput& operator=(const FileOutput&) = delete;
  ~FileOutput() override {
    if (file_ >= 0) close(file_);
    if (!committed_) unlink(temporary_.c_str());
  }

  void write(std::span<const std::byte> bytes) override {
    if (buffer_.size() + bytes.size() > kBuffer) flush();
    if (bytes.size() >= kBuffer) {
      put(bytes);
    } else {
      buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    }
  }
  void seek(std::uint64_t offset) override {
    flush();
    flushed_ = offset;
  }
  std::uint64_t position() const override { return flushed_ + buffer_.size(); }
  std::uint64_t size() const override { return std::max(size_, position()); }

  std::size_t read(std::span<std::byte> bytes) override {
    flush();
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t count = pread(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(flushed_));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw system_error(name(), "can't read back");
      if (count == 0) break;
      done += static_cast<std::size_t>(count);
      flushed_ += static_cast<std::uint64_t>(count);
    }
    return done;
  }

  void commit() override {
    flush();
    if (close(std::exchange(file_, -1)) != 0) throw system_error(name(), "can't write");
    if (rename(temporary_.c_str(), final_path_.c_str()) != 0) throw system_error(name(), "can't rename into place");
    committed_ = true;
  }

 private:
  void open_beside(mode_t mode) {
    const std::size_t slash = final_path_.find_last_of('/');
    const std::size_t start = slash == std::string::npos ? 0 : slash + 1;
    // What is left of a long name still fits a file system's limit with what is added here.
    const std::string stem = final_path_.substr(start, NAME_MAX - 40);
    for (int attempt = 0; file_ < 0; ++attempt) {
      temporary_ = fmt::format("{}.{}.{}-{}.part", final_path_.substr(0, start), stem, getpid(), attempt);
      file_ = open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      if (file_ < 0 && errno != EEXIST) throw system_error(name(), "can't write");
    }
  }

  void flush() {
    put(buffer_);
    buffer_.clear();
  }

  void put(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t count = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(flushed_));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw system_error(name(), "can't write");
      bytes = bytes.subspan(static_cast<std::size_t>(count));
      flushed_ += static_cast<std::uint64_t>(count);
      size_ = std::max(size_, flushed_);
    }
  }

  std::string final_path_;
  std::string temporary_;
  int file_ = -1;
  bool committed_ = false;
  std::vector<std::byte> buffer_;  ///< follows what is flushed
  std::uint64_t flushed_ = 0;      ///< place in the file where the buffer begins
  std::uint64_t size_ = 0;
};

/// The file that a link leads to, so that writing replaces the file and not the link.
std::string resolved(const std::string& path) {
  char* const real = realpath(path.c_str(), nullptr);
  if (real == nullptr) return path;
  std::string result = real;
  std::free(real);
  return result;
}

}  // namespace

std::unique_ptr<Output> create_output(const std::string& path) {
  if (path == "-") return std::make_unique<StreamOutput>("standard output", "");
  struct stat status = {};
  constexpr mode_t kNewFile = 0666;  // what the process's mask leaves of it
  if (stat(path.c_str(), &status) != 0) return std::make_unique<FileOutput>(path, path, kNewFile);
  if (S_ISDIR(status.st_mode)) throw Error(Error::Io, fmt::format("{}: can't write: it is a folder", path));
  if (!S_ISREG(status.st_mode)) return std::make_unique<StreamOutput>(path, path);
  return std::make_unique<FileOutput>(path, resolved(path), status.st_mode & 0777U);
}

std::unique_ptr<Output> memory_output(std::vector<std::byte>& bytes, std::string name) {
  return std::make_unique<MemoryOutput>(bytes, std::move(name));
}

}  // namespace azulejo
