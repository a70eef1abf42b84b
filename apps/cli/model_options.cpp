#include "model_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo::cli {
namespace {

[[noreturn]] void refuse(const char* option, std::string_view text, const char* expected) {
  throw Error(Error::Argument, fmt::format("{}: \"{}\", expected {}", option, text, expected));
}

constexpr const char* kRawForm = "WxHxD:type[:be][:skip=N][:spacing=x,y,z], such as 64x64x93:i16:spacing=1,1,2";

/// What comes before `separator`, taken from the front of `text`.
std::string_view next_part(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

template <class T>
std::optional<T> number(std::string_view text) {
  T value = {};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Three numbers; nothing else may follow.
template <class T>
std::optional<std::array<T, 3>> three(std::string_view text, char separator) {
  std::array<T, 3> result = {};
  for (T& each : result) {
    const std::optional<T> value = number<T>(next_part(text, separator));
    if (!value) return std::nullopt;
    each = *value;
  }
  return text.empty() ? std::optional(result) : std::nullopt;
}

std::optional<SampleType> sample_type(std::string_view name) {
  static constexpr std::pair<std::string_view, SampleType> kTypes[] = {
      {"u8", SampleType::U8},   {"i8", SampleType::I8},   {"u16", SampleType::U16}, {"i16", SampleType::I16},
      {"u32", SampleType::U32}, {"i32", SampleType::I32}, {"u64", SampleType::U64}, {"i64", SampleType::I64},
      {"f32", SampleType::F32}, {"f64", SampleType::F64}};
  for (const auto& [each, type] : kTypes) {
    if (name == each) return type;
  }
  return std::nullopt;
}

/// One of the parts behind size and type; false if it isn't one.
bool set_raw_part(RawVolume& raw, std::string_view part) {
  constexpr std::string_view kSkip = "skip=";
  constexpr std::string_view kSpacing = "spacing=";
  if (part == "be" || part == "le") {
    raw.big_endian = part == "be";
  } else if (part.starts_with(kSkip)) {
    const auto skip = number<std::int64_t>(part.substr(kSkip.size()));
    if (!skip || *skip < 0) return false;
    raw.skip_bytes = *skip;
  } else if (part.starts_with(kSpacing)) {
    const auto spacing = three<float>(part.substr(kSpacing.size()), ',');
    const bool usable =
        spacing && std::all_of(spacing->begin(), spacing->end(), [](float s) { return s > 0 && s < 1e30F; });
    if (!usable) return false;
    raw.spacing = {(*spacing)[0], (*spacing)[1], (*spacing)[2]};
  } else {
    return false;
  }
  return true;
}

float metres(const std::string& unit) {
  static constexpr std::pair<std::string_view, float> kUnits[] = {
      {"mm", 1e-3F}, {"cm", 1e-2F}, {"m", 1.0F}, {"in", 0.0254F}, {"ft", 0.3048F}};
  for (const auto& [each, value] : kUnits) {
    if (unit == each) return value;
  }
  refuse("--unit", unit, "mm, cm, m, in or ft");
}

}  // namespace

RawVolume parse_raw_volume(const std::string& text) {
  std::string_view rest = text;
  const auto size = three<int>(next_part(rest, ':'), 'x');
  const auto type = sample_type(next_part(rest, ':'));
  if (!size || !type || (*size)[0] < 1 || (*size)[1] < 1 || (*size)[2] < 1) refuse("--raw", text, kRawForm);
  RawVolume raw;
  raw.width = (*size)[0];
  raw.height = (*size)[1];
  raw.depth = (*size)[2];
  raw.type = *type;
  while (!rest.empty()) {
    if (!set_raw_part(raw, next_part(rest, ':'))) refuse("--raw", text, kRawForm);
  }
  return raw;
}

std::vector<CommonOption> model_options(CommandLine& line) {
  return {
      {"--up-axis",
       "",
       "AXIS",
       "what is up in a model's file, instead of what its format says",
       {"y", "z"},
       [&](const std::string& text) {
         if (text != "y" && text != "z") refuse("--up-axis", text, "y or z");
         line.read_model.up = text == "z" ? UpAxis::Z : UpAxis::Y;
       }},
      {"--unit",
       "",
       "UNIT",
       "of lengths in a model's file, instead of what its format says",
       {"mm", "cm", "m", "in", "ft"},
       [&](const std::string& text) { line.read_model.metres_per_unit = metres(text); }},
      {"--no-weld",
       "",
       "",
       "STL: keep three vertices for each triangle",
       {},
       [&](const std::string&) { line.read_model.weld = false; }},
      {"--outside-files",
       "",
       "",
       "files that a model names may lie outside its folder",
       {},
       [&](const std::string&) { line.read_model.outside = true; }},
      {"--raw",
       "",
       "LAYOUT",
       "the input is samples alone: WxHxD:type[:be][:skip=N][:spacing=x,y,z], such as 64x64x93:i16",
       {},
       [&](const std::string& text) { line.read_model.raw = parse_raw_volume(text); }},
      {"--ascii", "", "", "write STL and PLY as text", {}, [&](const std::string&) { line.write_model.ascii = true; }},
      {"--svg-text",
       "",
       "",
       "write texts into an SVG as text instead of outlines",
       {},
       [&](const std::string&) { line.write_model.svg_text = true; }},
      {"--tree",
       "",
       "",
       "info: the nodes of a scene, one below the other",
       {},
       [&](const std::string&) { line.tree = true; }},
  };
}

}  // namespace azulejo::cli
