#include "azulejo/io/utf8.h"

#include <gtest/gtest.h>

namespace azulejo {
namespace {

TEST(Utf8, IsToldFromOtherBytes) {
  for (const char* const text : {"", "abc", "á", "€", "𝄞", "\x7F", "\xF4\x8F\xBF\xBF", "\xED\x9F\xBF"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
  }
  for (const char* const text : {"\x80", "a\xE1", "\xC3", "\xC3(", "\xC0\x80", "\xE0\x80\x80", "\xF0\x80\x80\x80",
                                 "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xFF", "\xE2\x82"}) {
    EXPECT_FALSE(is_utf8(text)) << text;
  }
}

TEST(Utf8, IsMadeOfLatin1) { EXPECT_EQ(utf8_from_latin1("p\xE9 \xFF\x80"), "pé ÿ\xC2\x80"); }

}  // namespace
}  // namespace azulejo
