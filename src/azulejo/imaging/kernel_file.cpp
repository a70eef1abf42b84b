#include "azulejo/imaging/kernel_file.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/field.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/input.h"

namespace azulejo {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::int64_t kMostBytes = std::int64_t{64} << 20;

/// What begins with P is an image: of PNM and PFM a kind is text.
bool is_text(std::string_view bytes) {
  if (bytes.starts_with('P')) return false;
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    return (c >= ' ' && c <= '~') || std::string_view("\t\r\n").find(c) != std::string_view::npos;
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
    const std::size_t end = std::min(text.find_first_of("\n/#"), text.size());
    const std::string row = tidied(text.substr(0, end));
    if (!rows.empty() && !row.empty()) rows += '/';
    rows += row;
    const bool comment = end < text.size() && text[end] == '#';
    text.remove_prefix(std::min(comment ? text.find('\n', end) : end + 1, text.size()));
  }
  if (rows.empty()) throw Error(Error::Data, name + ": no numbers, expected the rows of a kernel");
  Field field;
  field.name = name;
  field.type = FieldType::Grid;
  return fields::parse_grid(field, rows);
}

/// Text or an image.
KernelFile weights_of(const std::string& path) {
  const std::vector<std::byte> bytes = open_input(path, kMostBytes)->read_all(kMostBytes);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
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

}  // namespace

KernelFile read_kernel(const std::string& path) {
  KernelFile file = weights_of(path);
  for (const float weight : file.kernel.values) {
    if (std::fabs(weight) <= kLargestWeight) continue;  // not if it is NaN
    throw Error(Error::Data,
                fmt::format("{}: {}, expected weights from -{} to {}", path, weight, kLargestWeight, kLargestWeight));
  }
  return file;
}

KernelFile chosen_kernel(const NumberGrid& kernel, const NumberGrid& normal, const std::string& file) {
  if (!file.empty() && kernel != normal) {
    throw Error(Error::Argument, fmt::format("file: {}, given beside kernel, expected one of them", file));
  }
  KernelFile chosen = file.empty() ? KernelFile{kernel, 1} : read_kernel(file);
  check_kernel_size(chosen.kernel);
  return chosen;
}

}  // namespace azulejo
