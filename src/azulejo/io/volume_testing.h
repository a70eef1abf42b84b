#pragma once

// What the tests of volume files share: files written by hand.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"

namespace azulejo {

/// A file that grows by numbers of one byte order.
struct BytesWriter {
  bool big_endian = false;
  std::vector<std::byte> bytes;

  template <class T>
  void put(std::size_t at, T value) {
    auto stored = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(stored.begin(), stored.end());
    if (bytes.size() < at + sizeof(T)) bytes.resize(at + sizeof(T));
    std::copy(stored.begin(), stored.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { put(bytes.size(), value); }
  void add(std::string_view text) {
    for (const char each : text) bytes.push_back(static_cast<std::byte>(each));
  }
};

inline std::vector<float> samples_of(const Volume& volume) { return {volume.samples.begin(), volume.samples.end()}; }

inline Volume read_volume(std::span<const std::byte> bytes, const std::string& name = "volume",
                          const ModelReadOptions& options = {}, const Run& run = {}) {
  return std::get<Volume>(read_model(bytes, name, options, run));
}

/// Every cut is an Error that names the file; the last `harmless` bytes carry nothing.
inline void expect_volume_cuts_refused(std::span<const std::byte> bytes, std::size_t harmless = 0) {
  for (std::size_t size = 0; size + harmless < bytes.size(); ++size) {
    try {
      read_model(bytes.first(size), "cut", {}, {});
      ADD_FAILURE() << "silent at byte " << size;
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("cut: ")) << error.what();
    }
  }
}

}  // namespace azulejo
