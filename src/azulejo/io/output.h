#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace azulejo {

/// A file that is being written: bytes go beside the final name and are renamed by `commit`.
/// Destroyed before that it leaves nothing.
class Output {
 public:
  virtual ~Output() = default;
  /// Appends at the current position. Throws Error(Io).
  virtual void write(std::span<const std::byte> bytes) = 0;
  /// Moves the position (TIFF needs it). Standard output is kept in memory until commit, so it can too.
  virtual void seek(std::uint64_t offset) = 0;
  virtual std::uint64_t position() const = 0;
  virtual std::uint64_t size() const = 0;
  /// Reads back what was written (TIFF needs it).
  virtual std::size_t read(std::span<std::byte> bytes) = 0;
  virtual void commit() = 0;
  const std::string& name() const { return name_; }

 protected:
  explicit Output(std::string name) : name_(std::move(name)) {}

 private:
  std::string name_;
};

/// "-" is standard output. Throws Error(Io) with the system's reason.
std::unique_ptr<Output> create_output(const std::string& path);

/// Collects into `bytes`, which must outlive it; `commit` does nothing.
std::unique_ptr<Output> memory_output(std::vector<std::byte>& bytes, std::string name);

}  // namespace azulejo
