#include "azulejo/io/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"

namespace azulejo {
namespace {

struct TypeName {
  std::string_view name;
  std::string_view other;
  PlyType type;
  std::size_t bytes;
};

constexpr std::array<TypeName, 8> kTypes = {{{"char", "int8", PlyType::I8, 1},
                                             {"uchar", "uint8", PlyType::U8, 1},
                                             {"short", "int16", PlyType::I16, 2},
                                             {"ushort", "uint16", PlyType::U16, 2},
                                             {"int", "int32", PlyType::I32, 4},
                                             {"uint", "uint32", PlyType::U32, 4},
                                             {"float", "float32", PlyType::F32, 4},
                                             {"double", "float64", PlyType::F64, 8}}};

constexpr std::size_t kLongestLine = std::size_t{1} << 16;
constexpr std::size_t kMostProperties = 4096;

std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> result;
  std::size_t next = 0;
  for (;;) {
    next = line.find_first_not_of(" \t\v\f\r", next);
    if (next == std::string::npos) return result;
    const std::size_t end = std::min(line.find_first_of(" \t\v\f\r", next), line.size());
    result.push_back(line.substr(next, end - next));
    next = end;
  }
}

class HeaderReader {
 public:
  explicit HeaderReader(const std::shared_ptr<const Input>& input) : reader_(input) {}

  PlyHeader read() {
    skip_to_signature();
    if (words(line()) != std::vector<std::string>{"ply"}) throw error("doesn't begin with \"ply\"");
    bool has_format = false;
    for (;;) {
      const std::vector<std::string> words_of_line = words(line());
      if (words_of_line.empty() || words_of_line[0] == "comment" || words_of_line[0] == "obj_info") continue;
      if (words_of_line[0] == "end_header") break;
      if (words_of_line[0] == "format") {
        format(words_of_line);
        has_format = true;
      } else if (words_of_line[0] == "element") {
        element(words_of_line);
      } else if (words_of_line[0] == "property") {
        property(words_of_line);
      } else {
        throw error(fmt::format("'{}', expected format, element, property, comment or end_header",
                                words_of_line[0].substr(0, 20)));
      }
    }
    if (!has_format) throw error("the header has no line \"format\"");
    header_.body = reader_.position();
    return std::move(header_);
  }

  void check_counts(const PlyHeader& header) const {
    const std::uint64_t rest = reader_.size() - header.body;
    for (const PlyElement& element : header.elements) {
      // In text a value takes a digit and a byte that ends it; the last may lack that.
      const std::uint64_t row =
          header.format == PlyFormat::Text ? 2 * element.properties.size() : std::uint64_t{element.least_row_bytes()};
      const std::uint64_t room = header.format == PlyFormat::Text ? rest + 1 : rest;
      if (row > 0 && element.count > room / row) {
        throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early: {} rows of element {} don't fit {} "
                                             "bytes",
                                             reader_.name(), reader_.size(), element.count, element.name, rest));
      }
    }
  }

 private:
  Error error(const std::string& what) const {
    return Error(Error::Data, fmt::format("{}: byte {}: {}", reader_.name(), line_start_, what));
  }

  /// Line ends, blanks and a byte order mark may stand before "ply".
  void skip_to_signature() {
    std::uint64_t start = 0;
    for (;; ++start) {
      const std::uint8_t byte = reader_.byte();
      if (byte != ' ' && (byte < '\t' || byte > '\r') && byte != 0xEF && byte != 0xBB && byte != 0xBF) break;
    }
    reader_.seek(start);
  }

  /// The next line. It ends with \n, \r\n, or \r where the first one did so.
  std::string line() {
    line_start_ = reader_.position();
    std::string text;
    for (;;) {
      const char c = static_cast<char>(reader_.byte());
      if (c == '\n') break;
      if (c == '\r') {
        if (header_.line_end == '\r') break;
        const bool more = !reader_.at_end();
        const char next = more ? static_cast<char>(reader_.byte()) : '\n';
        if (next == '\n') break;
        reader_.seek(reader_.position() - 1);
        if (!std::exchange(seen_line_, true)) {
          header_.line_end = '\r';
          break;
        }
      }
      text += c;
      if (text.size() > kLongestLine) throw error("a line of the header has no end");
    }
    seen_line_ = true;
    return text;
  }

  void format(const std::vector<std::string>& line) {
    const std::string name = line.size() > 1 ? line[1] : "";
    if (name == "ascii") {
      header_.format = PlyFormat::Text;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::LittleEndian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::BigEndian;
    } else {
      throw error(fmt::format("format '{}', expected ascii, binary_little_endian or binary_big_endian", name));
    }
  }

  void element(const std::vector<std::string>& line) {
    PlyElement element;
    if (line.size() < 3) throw error("an element needs a name and a count");
    element.name = line[1];
    const std::string& count = line[2];
    const auto [end, status] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (status != std::errc() || end != count.data() + count.size()) {
      throw error(fmt::format("element {} has the count '{}', expected a number", element.name, count.substr(0, 20)));
    }
    header_.elements.push_back(std::move(element));
    count_properties();
  }

  void property(const std::vector<std::string>& line) {
    if (header_.elements.empty()) throw error("a property stands before the first element");
    PlyProperty property;
    const bool is_list = line.size() > 1 && line[1] == "list";
    if (line.size() < (is_list ? 5U : 3U)) throw error("a property needs a type and a name");
    property.is_list = is_list;
    property.type = type(line[is_list ? 3 : 1]);
    property.name = line[is_list ? 4 : 2];
    if (is_list) property.count_type = type(line[2]);
    if (property.count_type == PlyType::F32 || property.count_type == PlyType::F64) {
      throw error(fmt::format("list {} is counted in {}, expected an integer", property.name, line[2]));
    }
    header_.elements.back().properties.push_back(std::move(property));
    count_properties();
  }

  void count_properties() {
    if (++properties_ > kMostProperties) throw error(fmt::format("more than {} properties", kMostProperties));
  }

  PlyType type(const std::string& name) const {
    for (const TypeName& each : kTypes) {
      if (name == each.name || name == each.other) return each.type;
    }
    throw error(fmt::format("unknown type '{}'", name.substr(0, 20)));
  }

  ByteReader reader_;
  PlyHeader header_;
  std::uint64_t line_start_ = 0;
  std::size_t properties_ = 0;
  bool seen_line_ = false;
};

}  // namespace

std::size_t ply_type_bytes(PlyType type) { return kTypes[static_cast<std::size_t>(type)].bytes; }
const char* ply_type_name(PlyType type) { return kTypes[static_cast<std::size_t>(type)].name.data(); }

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& each) { return each.is_list; });
}

std::size_t PlyElement::least_row_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& each : properties) bytes += ply_type_bytes(each.is_list ? each.count_type : each.type);
  return bytes;
}

std::size_t PlyElement::find(std::string_view property) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const PlyProperty& each) { return each.name == property; });
  return static_cast<std::size_t>(found - properties.begin());
}

PlyHeader read_ply_header(const std::shared_ptr<const Input>& input) {
  HeaderReader reader(input);
  PlyHeader header = reader.read();
  reader.check_counts(header);
  return header;
}

}  // namespace azulejo
