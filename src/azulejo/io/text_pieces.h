#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// Bytes 0 behind a piece: numbers end there, and short words are compared at once.
inline constexpr std::size_t kTextPadding = 16;

/// A piece of a text file in memory: whole lines, each ended by \n, followed by kTextPadding bytes 0.
struct TextPiece {
  std::size_t index = 0;
  std::uint64_t offset = 0;  ///< of its first byte in the file
  const char* begin = nullptr;
  const char* end = nullptr;

  std::uint64_t offset_of(const char* place) const { return offset + static_cast<std::uint64_t>(place - begin); }
};

/// A text file, or its part from `begin`, cut at line ends into pieces of about `bytes`. Where it is cut depends on the
/// file only, so what is put together in the order of the pieces has the same bytes for any number of threads.
class TextPieces {
 public:
  /// Lines end with `line_end`: \n, with or without \r before it; or \r (as line_end_of tells), which pieces show as \n.
  /// `may_begin`, if given, is shown the first bytes (up to 64) of a line that a piece might begin with.
  /// Throws Error(Io), Error(Resource) where a single piece would be larger than run.limits.memory_bytes.
  TextPieces(std::shared_ptr<const Input> input, std::uint64_t begin, const Run& run, char line_end = '\n',
             const std::function<bool(std::string_view)>& may_begin = {}, std::size_t bytes = std::size_t{1} << 20);

  std::size_t size() const { return starts_.size() - 1; }
  const std::string& name() const { return input_->name(); }
  /// Reads the pieces, on all threads: body(piece, worker).
  void for_each(const Run& run, const std::function<void(const TextPiece& piece, int worker)>& body) const;
  /// Error(Data) at a place of a piece.
  Error error(const TextPiece& piece, const char* place, const std::string& what) const;

 private:
  std::shared_ptr<const Input> input_;
  char line_end_;
  std::vector<std::uint64_t> starts_;  ///< of the pieces, and the end of the file
};

/// \r if the text's first line ends with it alone, else \n.
char line_end_of(std::string_view text);

/// Behind blanks: space, tab, \r, \v, \f; not \n.
inline const char* behind_blanks(const char* text) {
  while (*text == ' ' || (*text >= '\t' && *text <= '\r' && *text != '\n')) ++text;
  return text;
}
/// Behind blanks and line ends.
inline const char* behind_space(const char* text) {
  while (*text == ' ' || (*text >= '\t' && *text <= '\r')) ++text;
  return text;
}
/// The line end (or `end`) that follows.
const char* end_of_line(const char* text, const char* end, char line_end = '\n');

/// What stands there, for messages: up to 20 bytes of one word, with ? for what can't be shown.
std::string shown_word(const char* text, const char* end);

}  // namespace azulejo
