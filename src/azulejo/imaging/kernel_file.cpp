#include "azulejo/imaging/kernel_file.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/field.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/input.h"

namespace azulejo {
namespace {

constexpr std::int64_t kMostBytes = std::int64_t{64} << 20;

bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    return (c >= '0' && c <= '9') || std::string_view("+-.eE, \t\r\n").find(c) != std::string_view::npos;
  });
}

/// A line of numbers with single commas between; empty: there are none.
std::string tidied(std::string_view line) {
  std::string row;
  bool between = false;
  for (const char c : line) {
    if (c == ' ' || c == '\t' || c == ',' || c == '\r') {
      between = true;
    } else {
      if (between && !row.empty()) row += ',';
      row += c;
      between = false;
    }
  }
  return row;
}

NumberGrid from_text(std::string_view text, const std::string& name) {
  std::string rows;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string row = tidied(text.substr(0, end));
    if (!rows.empty() && !row.empty()) rows += '/';
    rows += row;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (rows.empty()) throw Error(Error::Data, name + ": no numbers, expected the rows of a kernel");
  Field field;
  field.name = name;
  field.type = FieldType::Grid;
  return fields::parse_grid(field, rows);
}

}  // namespace

KernelFile read_kernel(const std::string& path) {
  const std::vector<std::byte> bytes = open_input(path, kMostBytes)->read_all(kMostBytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (is_text(text)) return {from_text(text, path), 1};
  const Image image = read_image(bytes, path);
  if (image.channels() != 1) {
    throw Error(Error::Unsupported, fmt::format("{}: {} channels, expected a kernel of 1", path, image.channels()));
  }
  KernelFile file{{image.height(), image.width(), {}}, full_range(image.type())};
  visit(image.any(), [&](auto view) {
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) file.kernel.values.push_back(static_cast<float>(view(x, y)));
    }
  });
  return file;
}

void check_kernel_size(const NumberGrid& kernel) {
  if (!kernel.empty() && kernel.rows <= kLargestKernelSide && kernel.columns <= kLargestKernelSide) return;
  throw Error(Error::Argument, fmt::format("kernel: {} × {} weights, expected 1 × 1 to {} × {}", kernel.columns,
                                           kernel.rows, kLargestKernelSide, kLargestKernelSide));
}

}  // namespace azulejo
