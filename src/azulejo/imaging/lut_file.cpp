#include "azulejo/imaging/lut_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "azulejo/core/error.h"
#include "azulejo/io/input.h"
#include "azulejo/io/read_text.h"
#include "azulejo/io/text_numbers.h"

namespace azulejo {
namespace {

constexpr std::size_t kLeast = 2;
constexpr std::size_t kMost = 65536;

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Reads the lines of one file.
class LutReader {
 public:
  explicit LutReader(const std::string& path) : path_(path) {}

  std::vector<LutTable> read(std::string_view text, std::optional<float> scale) {
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      ++line_number_;
      line(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    const std::size_t columns = cube_ ? 3 : 1;
    const std::size_t count = values_.size() / columns;
    if (cube_ && count != size_) fail(fmt::format("{} values, expected LUT_1D_SIZE: {}", count, size_));
    if (count < kLeast) fail(fmt::format("{} values, expected {} to {}", count, kLeast, kMost));
    return tables(columns, scale);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Error::Data, fmt::format("file: {}: {}", path_, what));
  }
  [[noreturn]] void fail_here(const std::string& what) const { fail(fmt::format("line {}: {}", line_number_, what)); }

  void line(std::string_view text) {
    text = text.substr(0, text.find('#'));
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    if (text.empty()) return;
    const auto is_name = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
    if (text.front() >= 'A' && text.front() <= 'Z') {
      const auto name = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_name) - text.begin());
      return keyword(text.substr(0, name), text.substr(name));
    }
    const std::size_t columns = cube_ ? 3 : 1;
    if (values_.size() >= kMost * columns) fail_here(fmt::format("more than {} values", kMost));
    std::array<float, 3> row{};
    numbers(text, {row.data(), columns});
    values_.insert(values_.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(columns));
  }

  void keyword(std::string_view name, std::string_view rest) {
    if (name == "TITLE") return;
    if (name == "LUT_3D_SIZE") {
      throw Error(Error::Unsupported, fmt::format("file: {}: LUT_3D_SIZE, expected a table of one dimension", path_));
    }
    if (name == "LUT_1D_SIZE") {
      float size = 0;
      numbers(rest, {&size, 1});
      if (size != std::floor(size) || size < kLeast || size > kMost) {
        fail_here(fmt::format("LUT_1D_SIZE {}, expected {} to {}", size, kLeast, kMost));
      }
      if (!values_.empty()) fail_here("LUT_1D_SIZE after the values, expected before them");
      size_ = static_cast<std::size_t>(size);
      cube_ = true;
    } else if (name == "DOMAIN_MIN") {
      numbers(rest, first_);
    } else if (name == "DOMAIN_MAX") {
      numbers(rest, last_);
    } else if (name == "LUT_1D_INPUT_RANGE") {
      std::array<float, 2> range{};
      numbers(rest, range);
      first_.fill(range[0]);
      last_.fill(range[1]);
    } else {
      fail_here(fmt::format("\"{}\", expected a number or a keyword of .cube files", quoted_word(name)));
    }
  }

  /// As many numbers as there is room for, with blanks between. Behind `text` is a line's end.
  void numbers(std::string_view text, std::span<float> values) const {
    const char* next = text.data();
    const char* const end = text.data() + text.size();
    for (float& value : values) {
      while (next != end && blank(*next)) ++next;
      const char* const behind = next == end ? nullptr : parse_float(next, value);
      if (behind == nullptr || (behind != end && !blank(*behind)) || !std::isfinite(value)) {
        fail_here(fmt::format("\"{}\", expected {} number{}", quoted_word(text), values.size(),
                              values.size() == 1 ? "" : "s"));
      }
      next = behind;
    }
    if (next != end) {
      fail_here(
          fmt::format("\"{}\", expected {} number{}", quoted_word(text), values.size(), values.size() == 1 ? "" : "s"));
    }
  }

  std::vector<LutTable> tables(std::size_t columns, std::optional<float> scale) const {
    const float largest = *std::max_element(values_.begin(), values_.end());
    const float by_largest = largest <= 1.0F ? 1.0F : largest <= 255.0F ? 255.0F : 65535.0F;
    const float one = scale.value_or(cube_ ? 1.0F : by_largest);
    std::vector<LutTable> result(columns);
    for (std::size_t c = 0; c < columns; ++c) {
      if (!(first_[c] < last_[c])) fail(fmt::format("domain {} to {}, expected a growing one", first_[c], last_[c]));
      result[c].first = first_[c];
      result[c].last = last_[c];
      for (std::size_t i = c; i < values_.size(); i += columns) result[c].values.push_back(values_[i] / one);
    }
    const auto same = [&](const LutTable& each) {
      return each.first == result[0].first && each.last == result[0].last && each.values == result[0].values;
    };
    if (std::all_of(result.begin(), result.end(), same)) result.resize(1);
    return result;
  }

  const std::string& path_;
  int line_number_ = 0;
  bool cube_ = false;
  std::size_t size_ = 0;
  std::array<float, 3> first_{0, 0, 0};
  std::array<float, 3> last_{1, 1, 1};
  std::vector<float> values_;
};

}  // namespace

std::vector<LutTable> read_lut(const std::string& path, std::optional<float> scale) {
  Run run;
  run.limits.memory_bytes = std::int64_t{64} << 20;  // 65536 long lines are less
  const Text text = read_text(*open_input(path, run.limits.memory_bytes), run);
  return LutReader(path).read(text.view(), scale);
}

}  // namespace azulejo
