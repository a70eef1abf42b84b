#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

/// Bytes of a file, a pipe or memory, with a name for messages. Reading is thread-safe, and may begin anew: what comes
/// through a pipe is kept.
class Input {
 public:
  virtual ~Input() = default;
  virtual std::uint64_t size() const = 0;
  /// Reads up to bytes.size() bytes from `offset`; returns how many there were. Throws Error(Io).
  virtual std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const = 0;
  const std::string& name() const { return name_; }
  /// Where the file lies, and those that it names; empty: nowhere (memory, standard input).
  const std::string& folder() const { return folder_; }

  /// All of it, for codecs that want it so. Throws Error(Resource) above `limit` bytes.
  std::vector<std::byte> read_all(std::int64_t limit) const;

 protected:
  explicit Input(std::string name, std::string folder = {}) : name_(std::move(name)), folder_(std::move(folder)) {}

 private:
  std::string name_;
  std::string folder_;
};

/// Opens a file for reading; "-" reads standard input to its end, up to `memory_limit` bytes, and so does a pipe.
/// Throws Error(Io) with the system's reason, Error(Resource).
AZULEJO_EXPORT std::shared_ptr<const Input> open_input(const std::string& path, std::int64_t memory_limit);

/// Bytes in memory, which stay the caller's.
std::shared_ptr<const Input> memory_input(std::span<const std::byte> bytes, std::string name);

}  // namespace azulejo
