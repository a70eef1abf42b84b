#pragma once

#include <cstdint>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/io/text_pieces.h"

namespace azulejo {

/// Of lines that hold something: the number of the first one in each piece, and how many there are. Blank lines don't
/// count, nor do those that begin with `comment` (0: there are no comments).
std::vector<std::uint64_t> first_rows(const TextPieces& file, char comment, const Run& run);

/// Whether a value ends before this byte: a blank, a line end, the end of the text, or a comment.
inline bool ends_value(char c) { return c == '\0' || c == ' ' || (c >= '\t' && c <= '\r') || c == '#'; }

}  // namespace azulejo
