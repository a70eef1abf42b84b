#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// An OBJ file cut at line ends, but none that a \ takes back, into pieces of about a megabyte. Where depends on the
/// file only. Pieces are loaded one by one: the file as a whole isn't held, unless it is UTF-16.
class ObjText {
 public:
  /// Throws Error(Io), Error(Resource).
  ObjText(std::shared_ptr<const Input> input, const Run& run);

  std::size_t pieces() const { return starts_.size() - 1; }
  std::uint64_t offset(std::size_t piece) const { return starts_[piece]; }
  const std::string& name() const { return input_->name(); }
  /// Whole lines, with two line feeds more at their end. Lies in `buffer`.
  std::string_view load(std::size_t piece, Array<char>& buffer) const;
  /// The line of a byte, from 1; lines end with \n, \r\n or \r.
  std::size_t line_of(std::uint64_t byte) const;
  /// Error(Data) naming the line of a byte.
  Error error(std::uint64_t byte, const std::string& what) const;

 private:
  std::uint64_t next_line(std::uint64_t from) const;

  Array<char> converted_;
  std::shared_ptr<const Input> input_;
  std::vector<std::uint64_t> starts_;  ///< of the pieces, and the end
};

}  // namespace azulejo
