#include "azulejo/io/text_pieces.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_testing.h"
#include "azulejo/io/text_rows.h"

namespace azulejo {
namespace {

using Lines = std::vector<std::string>;

Lines pieces_of(const std::string& text, std::size_t bytes, std::uint64_t begin = 0,
                const std::function<bool(std::string_view)>& may_begin = {}, char line_end = '\n') {
  azulejo::Run run;
  run.threads = 2;
  const TextPieces file(memory_input(bytes_of(text), "x.txt"), begin, run, line_end, may_begin, bytes);
  Lines pieces(file.size());
  file.for_each(run, [&](const TextPiece& piece, int) {
    pieces[piece.index] = std::string(piece.begin, piece.end);
    EXPECT_TRUE(std::all_of(piece.end, piece.end + kTextPadding, [](char c) { return c == '\0'; }));
    EXPECT_EQ(text.compare(piece.offset, 1, pieces[piece.index], 0, 1), 0);
  });
  return pieces;
}

TEST(TextPieces, AreWholeLines) {
  const std::string text = "one\ntwo\n\nthree\nfour";
  EXPECT_EQ(pieces_of(text, 1), (Lines{"one\n", "two\n", "\n", "three\n", "four"}));
  EXPECT_EQ(pieces_of(text, 5), (Lines{"one\ntwo\n", "\nthree\n", "four"}));
  EXPECT_EQ(pieces_of(text, 100), Lines{text});
  EXPECT_EQ(pieces_of(text, 1, 4), (Lines{"two\n", "\n", "three\n", "four"}));
  EXPECT_EQ(pieces_of("", 1), Lines{});
  EXPECT_EQ(pieces_of("a", 1, 1), Lines{});
  EXPECT_EQ(pieces_of("\n", 1), Lines{"\n"});
  EXPECT_EQ(pieces_of("a\rb\r", 1, 0, {}, '\r'), (Lines{"a\n", "b\n"}));
}

TEST(TextPieces, BeginWhereTheyMay) {
  const auto is_b = [](std::string_view line) { return line.starts_with("b"); };
  EXPECT_EQ(pieces_of("a\nb\nc\nb2\nb3\n", 1, 0, is_b), (Lines{"a\n", "b\nc\n", "b2\n", "b3\n"}));
  EXPECT_EQ(pieces_of("a\nc\nd", 1, 0, is_b), Lines{"a\nc\nd"});
}

TEST(TextPieces, LinesLongerThanWhatIsLookedAtAtOnce) {
  // Line ends at all places around the 16 KB that are searched at a time.
  for (std::size_t length = 16'384 - 70; length < 16'384 + 3; ++length) {
    const std::string text = std::string(length, 'a') + "\nb" + std::string(100, 'x') + "\nb" + std::string(200, 'y');
    const auto long_b = [](std::string_view line) { return line.starts_with("b") && line.size() == 64; };
    EXPECT_EQ(pieces_of(text, 1, 0, long_b).size(), 3U) << length;
  }
}

TEST(TextPieces, AreBounded) {
  azulejo::Run run;
  run.limits.memory_bytes = 100;
  const std::string text(101, 'x');
  EXPECT_EQ(kind_of_error([&] { TextPieces(memory_input(bytes_of(text), "x.txt"), 0, run); }), Error::Resource);
}

TEST(TextPieces, LineEnds) {
  EXPECT_EQ(line_end_of("a\nb"), '\n');
  EXPECT_EQ(line_end_of("a\r\nb"), '\n');
  EXPECT_EQ(line_end_of("a\rb\r"), '\r');
  EXPECT_EQ(line_end_of("a\rb\n"), '\n');
  EXPECT_EQ(line_end_of("a"), '\n');
}

TEST(TextPieces, RowsAreLinesThatHoldSomething) {
  const std::string text = "one\n\n  \r\n\ttwo\n# no row\nthree # x\n  # none\n\n";
  azulejo::Run run;
  const TextPieces file(memory_input(bytes_of(text), "x.txt"), 0, run, '\n', {}, 1);
  const auto rows = first_rows(file, '#', run);
  EXPECT_EQ(rows.size(), file.size() + 1);
  EXPECT_EQ(rows.front(), 0U);
  EXPECT_EQ(rows.back(), 3U);
  EXPECT_EQ(first_rows(file, '\0', run).back(), 5U);
}

TEST(TextPieces, WordsAreShownForMessages) {
  const std::string text = "a\x01" + std::string(30, 'b') + " c";
  EXPECT_EQ(shown_word(text.data(), text.data() + text.size()), "a?" + std::string(18, 'b'));
  EXPECT_EQ(shown_word(text.data() + text.size(), text.data() + text.size()), "");
}

}  // namespace
}  // namespace azulejo
