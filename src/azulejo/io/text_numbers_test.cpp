#include "azulejo/io/text_numbers.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace azulejo {
namespace {

/// The value of the whole text; a failure if anything is left over.
float number(const std::string& text) {
  float value = -77;
  const char* const end = parse_float(text.c_str(), value);
  EXPECT_EQ(end, text.c_str() + text.size()) << text;
  return value;
}

/// How much of the text is a number.
std::ptrdiff_t length(const std::string& text) {
  float value = 0;
  const char* const end = parse_float(text.c_str(), value);
  return end == nullptr ? -1 : end - text.c_str();
}

void expect_rounded(const std::string& text) {
  float wanted = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), wanted);
  if (status != std::errc()) return;  // out of range: looked at below
  ASSERT_EQ(end, text.data() + text.size()) << text;
  ASSERT_EQ(std::bit_cast<std::uint32_t>(number(text)), std::bit_cast<std::uint32_t>(wanted)) << text;
}

TEST(TextNumbers, AreWrittenInManyWays) {
  EXPECT_EQ(number("1"), 1);
  EXPECT_EQ(number("-12.5"), -12.5F);
  EXPECT_EQ(number("+.5"), 0.5F);
  EXPECT_EQ(number("1."), 1);
  EXPECT_EQ(number("-1.e2"), -100);
  EXPECT_EQ(number("1e-5"), 1e-5F);
  EXPECT_EQ(number("1E+05"), 1e5F);
  EXPECT_EQ(number("1.5D+03"), 1500);
  EXPECT_EQ(number("2.5d-1"), 0.25F);
  EXPECT_EQ(number("1.5d30"), 1.5e30F);
  EXPECT_EQ(number("000000000000000000000000000001.5"), 1.5F);
  EXPECT_TRUE(std::signbit(number("-0")));
  EXPECT_TRUE(std::signbit(number("-0.0e-90")));
}

TEST(TextNumbers, WordsForWhatIsNoNumber) {
  for (const char* text : {"inf", "INF", "+inf", "Infinity", "1.#INF", "1.#INF00"}) {
    EXPECT_EQ(number(text), std::numeric_limits<float>::infinity()) << text;
  }
  for (const char* text : {"-inf", "-Infinity", "-1.#INF"}) {
    EXPECT_EQ(number(text), -std::numeric_limits<float>::infinity()) << text;
  }
  for (const char* text : {"nan", "NaN", "-nan", "nan(ind)", "-nan(ind)", "1.#QNAN", "-1.#IND", "1.#SNAN0"}) {
    EXPECT_TRUE(std::isnan(number(text))) << text;
  }
}

TEST(TextNumbers, TooLargeIsInfiniteTooSmallIsZero) {
  EXPECT_EQ(number("1e39"), std::numeric_limits<float>::infinity());
  EXPECT_EQ(number("-1e400"), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(number("1e999999999999"), std::numeric_limits<float>::infinity());
  EXPECT_EQ(number("1e-60"), 0);
  EXPECT_EQ(number("1e-400"), 0);
  EXPECT_EQ(number("0.0001e-999999999999"), 0);
  EXPECT_EQ(number("0e99999"), 0);
  EXPECT_EQ(number(std::string(400, '9')), std::numeric_limits<float>::infinity());
  EXPECT_EQ(number("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(number("0." + std::string(400, '0') + "1e401"), 1);
}

TEST(TextNumbers, EndWhereTheNumberEnds) {
  EXPECT_EQ(length("1/2"), 1);
  EXPECT_EQ(length("0,5"), 1);
  EXPECT_EQ(length("0x10"), 1);
  EXPECT_EQ(length("1e"), 1);
  EXPECT_EQ(length("1e+"), 1);
  EXPECT_EQ(length("1.5 2"), 3);
  EXPECT_EQ(length("1.2.3"), 3);
  for (const char* text : {"", "-", "+", ".", "-.", "e5", "in", "na", "#", "--1", "1.#", "1.#X", ".#INF"}) {
    EXPECT_EQ(length(text), -1) << text;
  }
}

TEST(TextNumbers, AreRoundedAsByTheLibrary) {
  std::mt19937_64 random(7);
  char text[64];
  for (int i = 0; i < 300'000; ++i) {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(value)) continue;
    const int digits = static_cast<int>(random() % 18);
    std::snprintf(text, sizeof text, i % 2 == 0 ? "%.*e" : "%.*g", digits, static_cast<double>(value));
    ASSERT_NO_FATAL_FAILURE(expect_rounded(text));
    const double near_one = static_cast<double>(random() % 2'000'000'000) / 1e6 - 1000;
    std::snprintf(text, sizeof text, "%.*f", digits, near_one);
    ASSERT_NO_FATAL_FAILURE(expect_rounded(text));
  }
}

TEST(TextNumbers, MiddlesOfFloatsAreNotRoundedTwice) {
  // Of 2²⁴ + 1 and its like, with a digit far behind that decides.
  std::mt19937_64 random(8);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t middle = ((random() % (1U << 23)) | (1U << 23)) * 2 + 1;  // 25 bits, the last is half a step
    const std::string whole = std::to_string(middle);
    ASSERT_NO_FATAL_FAILURE(expect_rounded(whole));
    ASSERT_NO_FATAL_FAILURE(expect_rounded(whole + ".0000001"));
    ASSERT_NO_FATAL_FAILURE(expect_rounded(whole + ".00000000001"));
    ASSERT_NO_FATAL_FAILURE(expect_rounded(std::to_string(middle - 1) + ".9999999"));
    ASSERT_NO_FATAL_FAILURE(expect_rounded(std::to_string(middle - 1) + ".99999999999"));
  }
}

TEST(TextNumbers, Integers) {
  const auto integer = [](const std::string& text) {
    std::int64_t value = -77;
    const char* const end = parse_integer(text.c_str(), value);
    EXPECT_EQ(end, text.c_str() + text.size()) << text;
    return value;
  };
  EXPECT_EQ(integer("0"), 0);
  EXPECT_EQ(integer("-3"), -3);
  EXPECT_EQ(integer("+0012"), 12);
  EXPECT_EQ(integer("4294967295"), 4294967295);
  EXPECT_EQ(integer("99999999999999999999999999"), INT64_MAX);
  EXPECT_EQ(integer("-99999999999999999999999999"), -INT64_MAX);
  std::int64_t value = 0;
  EXPECT_EQ(parse_integer("x", value), nullptr);
  EXPECT_EQ(parse_integer("-", value), nullptr);
}

}  // namespace
}  // namespace azulejo
