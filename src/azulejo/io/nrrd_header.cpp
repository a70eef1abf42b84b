// Source: "Definition of NRRD File Format", teem.sourceforge.net/nrrd/format.html.

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"
#include "azulejo/io/nrrd.h"
#include "azulejo/io/volume_samples.h"

namespace azulejo {
namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kMostLines = 4096;
constexpr std::size_t kMostAxes = 16;  ///< NRRD's own limit

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Words between blanks; "…" and (…) are one word each, without their marks.
std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  while (!(text = trimmed(text)).empty()) {
    const char closing = text.front() == '"' ? '"' : text.front() == '(' ? ')' : '\0';
    if (closing != '\0') text.remove_prefix(1);
    const auto end =
        std::find_if(text.begin(), text.end(), [&](char c) { return closing != '\0' ? c == closing : is_blank(c); });
    result.emplace_back(text.begin(), end);
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
    if (closing != '\0' && !text.empty()) text.remove_prefix(1);
  }
  return result;
}

/// Reads the lines of one header.
class HeaderParser {
 public:
  explicit HeaderParser(const std::shared_ptr<const Input>& input) : reader_(input) {}

  NrrdHeader parse();

 private:
  [[noreturn]] void refuse(Error::Kind kind, const std::string& what) const {
    throw Error(kind, fmt::format("{}: line {}: {}", reader_.name(), line_, what));
  }
  /// False at the empty line that ends the header, and at the file's end.
  bool next_line(std::string& text);
  void field(const std::string& name, std::string_view value);
  bool samples_field(const std::string& name, std::string_view value);
  bool axes_field(const std::string& name, std::string_view value);
  bool space_field(const std::string& name, std::string_view value);
  void check();

  template <class T>
  T number(std::string_view text) const;
  template <class T>
  std::vector<T> numbers(std::string_view text) const;
  std::array<double, 3> vector(std::string_view text) const;
  SampleType type(const std::string& text) const;
  NrrdEncoding encoding(const std::string& text) const;

  ByteReader reader_;
  std::size_t line_ = 0;
  NrrdHeader header_;
  std::optional<std::size_t> dimension_;
  bool type_said_ = false;
  bool endian_said_ = false;
  bool encoding_said_ = false;
};

bool HeaderParser::next_line(std::string& text) {
  text.clear();
  if (reader_.at_end()) return false;
  ++line_;
  if (line_ > kMostLines) refuse(Error::Data, fmt::format("a header of at most {} lines expected", kMostLines));
  while (!reader_.at_end()) {
    const auto c = static_cast<char>(reader_.byte());
    if (c == '\n') break;
    if (text.size() == kLongestLine) refuse(Error::Data, fmt::format("longer than {} bytes", kLongestLine));
    text += c;
  }
  if (text.ends_with('\r')) text.pop_back();
  return !text.empty();
}

template <class T>
T HeaderParser::number(std::string_view text) const {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  T value = {};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || text.empty()) {
    refuse(Error::Data, fmt::format("'{}', a number expected", text));
  }
  return value;
}

template <class T>
std::vector<T> HeaderParser::numbers(std::string_view text) const {
  std::vector<T> result;
  for (const std::string& word : words(text)) result.push_back(number<T>(word));
  return result;
}

std::array<double, 3> HeaderParser::vector(std::string_view text) const {
  std::array<double, 3> result = {0, 0, 0};
  for (std::size_t i = 0;; ++i) {
    if (i == result.size()) refuse(Error::Unsupported, "a space of more than three dimensions");
    const std::size_t comma = text.find(',');
    result[i] = number<double>(text.substr(0, comma));
    if (comma == std::string_view::npos) return result;
    text.remove_prefix(comma + 1);
  }
}

SampleType HeaderParser::type(const std::string& text) const {
  static const std::map<std::string, SampleType, std::less<>> kTypes = {
      {"signed char", SampleType::I8},
      {"int8", SampleType::I8},
      {"uchar", SampleType::U8},
      {"unsigned char", SampleType::U8},
      {"uint8", SampleType::U8},
      {"short", SampleType::I16},
      {"signed short", SampleType::I16},
      {"int16", SampleType::I16},
      {"ushort", SampleType::U16},
      {"unsigned short", SampleType::U16},
      {"uint16", SampleType::U16},
      {"int", SampleType::I32},
      {"signed", SampleType::I32},
      {"int32", SampleType::I32},
      {"uint", SampleType::U32},
      {"unsigned", SampleType::U32},
      {"uint32", SampleType::U32},
      {"longlong", SampleType::I64},
      {"long long", SampleType::I64},
      {"signed long long", SampleType::I64},
      {"int64", SampleType::I64},
      {"ulonglong", SampleType::U64},
      {"unsigned long long", SampleType::U64},
      {"uint64", SampleType::U64},
      {"float", SampleType::F32},
      {"double", SampleType::F64},
  };
  // "unsigned short int" is "unsigned short", "int8_t" is "int8".
  std::string name = lower(text);
  if (name.ends_with(" int")) name.resize(name.size() - 4);
  if (name.ends_with("_t")) name.resize(name.size() - 2);
  const auto found = kTypes.find(name);
  if (found != kTypes.end()) return found->second;
  if (name == "block") refuse(Error::Unsupported, "samples of type block");
  refuse(Error::Data, fmt::format("type '{}', which NRRD doesn't know", text));
}

NrrdEncoding HeaderParser::encoding(const std::string& text) const {
  const std::string name = lower(text);
  if (name == "raw") return NrrdEncoding::Raw;
  if (name == "txt" || name == "text" || name == "ascii") return NrrdEncoding::Text;
  if (name == "hex") return NrrdEncoding::Hex;
  if (name == "gz" || name == "gzip") return NrrdEncoding::Gzip;
  refuse(Error::Unsupported, fmt::format("encoding '{}', expected raw, text, hex or gzip", text));
}

bool HeaderParser::samples_field(const std::string& name, std::string_view value) {
  if (name == "type") {
    header_.type = type(std::string(value));
    type_said_ = true;
  } else if (name == "encoding") {
    header_.encoding = encoding(std::string(value));
    encoding_said_ = true;
  } else if (name == "endian") {
    const std::string order = lower(value);
    if (order != "big" && order != "little") refuse(Error::Data, fmt::format("'{}', big or little expected", value));
    header_.order = order == "big" ? std::endian::big : std::endian::little;
    endian_said_ = true;
  } else if (name == "data file" || name == "datafile") {
    if (value.starts_with("LIST") || value.find('%') != std::string_view::npos) {
      refuse(Error::Unsupported, "samples in several files");
    }
    if (value.empty()) refuse(Error::Data, "the name of a file expected");
    header_.data_file = value;
  } else if (name == "line skip" || name == "lineskip") {
    header_.line_skip = number<std::int64_t>(value);
    if (header_.line_skip < 0) refuse(Error::Data, fmt::format("'{}', 0 or more expected", value));
  } else if (name == "byte skip" || name == "byteskip") {
    header_.byte_skip = number<std::int64_t>(value);
    if (header_.byte_skip < -1) refuse(Error::Data, fmt::format("'{}', -1 or more expected", value));
  } else if (name == "content") {
    header_.content = value;
  } else {
    return false;
  }
  return true;
}

bool HeaderParser::axes_field(const std::string& name, std::string_view value) {
  if (name == "dimension") {
    const auto dimension = number<std::int64_t>(value);
    if (dimension < 1 || dimension > std::int64_t{kMostAxes}) {
      refuse(Error::Data, fmt::format("{} dimensions, 1–{} expected", dimension, kMostAxes));
    }
    dimension_ = static_cast<std::size_t>(dimension);
  } else if (name == "sizes") {
    header_.sizes = numbers<std::int64_t>(value);
  } else if (name == "spacings") {
    header_.spacings = numbers<double>(value);
  } else if (name == "axis mins" || name == "axismins") {
    header_.mins = numbers<double>(value);
  } else if (name == "kinds") {
    header_.kinds = words(lower(value));
  } else if (name == "units") {
    header_.units = words(value);
  } else {
    return false;
  }
  return true;
}

bool HeaderParser::space_field(const std::string& name, std::string_view value) {
  if (name == "space directions") {
    header_.directions.clear();
    for (const std::string& word : words(value)) {
      if (lower(word) == "none") {
        header_.directions.emplace_back();
        continue;
      }
      const std::array<double, 3> direction = vector(word);
      const bool none = std::any_of(direction.begin(), direction.end(), [](double each) { return std::isnan(each); });
      header_.directions.push_back(none ? std::nullopt : std::optional(direction));
    }
  } else if (name == "space origin") {
    const std::vector<std::string> list = words(value);
    if (list.size() != 1) refuse(Error::Data, fmt::format("'{}', one vector expected", value));
    header_.origin = vector(list[0]);
  } else if (name == "space units") {
    header_.space_units = words(value);
  } else {
    return false;
  }
  return true;
}

/// Fields that are not known say nothing that is needed here.
void HeaderParser::field(const std::string& name, std::string_view value) {
  if (!samples_field(name, value) && !axes_field(name, value)) space_field(name, value);
}

void HeaderParser::check() {
  const auto missing = [&](const char* what) {
    throw Error(Error::Data, fmt::format("{}: the header has no field \"{}\"", reader_.name(), what));
  };
  if (!dimension_) missing("dimension");
  if (!type_said_) missing("type");
  if (!encoding_said_) missing("encoding");
  if (header_.sizes.empty()) missing("sizes");
  const bool bytes = header_.encoding != NrrdEncoding::Text && size_of(header_.type) > 1;
  if (bytes && !endian_said_) missing("endian");
  const auto counted = [&](const char* what, std::size_t count) {
    if (count != 0 && count != *dimension_) {
      throw Error(Error::Data, fmt::format("{}: \"{}\" has {} elements, expected one for each of {} dimensions",
                                           reader_.name(), what, count, *dimension_));
    }
  };
  counted("sizes", header_.sizes.size());
  counted("spacings", header_.spacings.size());
  counted("axis mins", header_.mins.size());
  counted("kinds", header_.kinds.size());
  counted("units", header_.units.size());
  counted("space directions", header_.directions.size());
}

NrrdHeader HeaderParser::parse() {
  std::string text;
  if (!next_line(text) || !text.starts_with("NRRD")) refuse(Error::Data, "NRRD expected");
  if (text.size() != 8 || text.compare(0, 7, "NRRD000") != 0 || text[7] < '1' || text[7] > '5') {
    refuse(Error::Unsupported, fmt::format("version '{}', expected NRRD0001 to NRRD0005", text));
  }
  while (next_line(text)) {
    if (text.starts_with('#')) continue;
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) refuse(Error::Data, fmt::format("'{:.40}', a field and a colon expected", text));
    if (colon + 1 < text.size() && text[colon + 1] == '=') continue;  // a key and its value: for others to know
    field(lower(trimmed(std::string_view(text).substr(0, colon))), trimmed(std::string_view(text).substr(colon + 1)));
  }
  header_.data_begin = reader_.position();
  check();
  return std::move(header_);
}

}  // namespace

NrrdHeader read_nrrd_header(const std::shared_ptr<const Input>& input) { return HeaderParser(input).parse(); }

}  // namespace azulejo
