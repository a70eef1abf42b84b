#pragma once

#include <cstdint>
#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace azulejo {

// What is written in the attributes of an SVG: numbers, lengths, transformations, references. All `take_` read from the
// front of a text and remove what they read; where there is nothing of the kind the text stays as it is.

inline bool is_svg_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f'; }

/// Behind the number that begins at `next`: "1", "-.5", "+1.", "1e-5"; what follows is no part of it ("1.5.5-3" is
/// 1.5, .5, -3). Null where there is none, or where it is too large for a float. Rounded to the nearest double.
const char* parse_svg_number(const char* next, const char* end, double& value);

void skip_blanks(std::string_view& text);
std::string_view without_blanks(std::string_view text);
/// Blanks, a comma at most, blanks. False: there was no comma.
bool skip_comma(std::string_view& text);
std::optional<double> take_number(std::string_view& text);
/// Letters, digits and '-'.
std::string_view take_word(std::string_view& text);
/// Numbers with blanks or commas between them; up to what is none.
std::vector<double> parse_numbers(std::string_view text);
/// ASCII only.
bool same_word(std::string_view text, std::string_view lower_case);

enum class SvgUnit : std::uint8_t { Pixel, Point, Pica, Millimetre, Centimetre, Quarter, Inch, Em, Ex, Percent };

struct SvgLength {
  double value = 0;
  SvgUnit unit = SvgUnit::Pixel;
};
/// Nothing for other text: "auto", "3 px".
std::optional<SvgLength> parse_length(std::string_view text);
/// Pixels: 96 an inch. hundred  what 100% is
double pixels_of(const SvgLength& length, double hundred, double font_size);

/// "translate(1 2) rotate(30)": the last comes first. Nothing where it can't be read.
std::optional<glm::dmat3x2> parse_transform(std::string_view text);

glm::dmat3x2 combined(const glm::dmat3x2& outer, const glm::dmat3x2& inner);
/// Values beyond the range of floats become its ends.
float to_float(double value);
glm::mat3x2 to_floats(const glm::dmat3x2& matrix);

/// "id" of "#id"; empty for anything else.
std::string_view fragment_of(std::string_view reference);
/// "id" of "url(#id)", quoted or not; of an address elsewhere all of it: no id is like that. Empty: not a url.
std::string_view take_url(std::string_view& text);

}  // namespace azulejo
