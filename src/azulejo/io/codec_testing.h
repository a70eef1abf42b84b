#pragma once

// What the tests of single formats share: damage done to small files.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "azulejo/io/io_testing.h"

namespace azulejo {

/// Cuts a file at every byte: each piece must be an Error that begins with the name, or a value with a warning.
/// The last `harmless` bytes carry no pixels.
inline void expect_cuts_noticed(const std::vector<std::byte>& bytes, const ReadOptions& options = {},
                                std::size_t harmless = 0) {
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Warnings warnings;
    try {
      read_image(std::span(bytes).first(size), "cut", options, warnings.run());
      EXPECT_TRUE(!warnings.lines.empty() || size + harmless >= bytes.size()) << "silent at byte " << size;
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("cut: ")) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

/// Flips random bits: each result must be a value or an Error, within small limits.
inline void expect_flips_survived(const std::vector<std::byte>& bytes, int times, unsigned seed) {
  azulejo::Run run;
  run.limits.pixels = 1 << 20;
  run.limits.memory_bytes = 1 << 26;
  std::mt19937 random(seed);
  for (int i = 0; i < times; ++i) {
    std::vector<std::byte> damaged = bytes;
    for (unsigned flips = 1 + random() % 4; flips > 0; --flips) {
      damaged[random() % damaged.size()] ^= static_cast<std::byte>(1U << random() % 8);
    }
    try {
      read_image(damaged, "flipped", {}, run);
    } catch (const Error&) {
    }
  }
}

/// Reads every file of a folder of the shared samples and of those ending so; returns the ones that were refused.
/// Skip the test where it gives nothing.
inline std::vector<std::string> refused_samples(const std::string& folder, const std::string& ending, int& files) {
  std::vector<std::string> refused;
  if (!std::filesystem::exists(shared_images() / folder)) return refused;
  for (const auto& entry : std::filesystem::directory_iterator(shared_images() / folder)) {
    if (entry.path().extension() != ending) continue;
    ++files;
    try {
      read_image(entry.path().string());
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(entry.path().string() + ": ")) << error.what();
      refused.push_back(entry.path().filename().string());
    }
  }
  std::sort(refused.begin(), refused.end());
  return refused;
}

/// Bytes given as numbers, for files written by hand.
inline std::vector<std::byte> bytes_of(std::initializer_list<int> numbers) {
  std::vector<std::byte> result;
  for (const int each : numbers) result.push_back(static_cast<std::byte>(each));
  return result;
}

/// All pixels of a u8 image in order.
inline std::vector<int> u8_values(const Image& image) {
  std::vector<int> result;
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* row = image.view<std::uint8_t>().row(y);
    result.insert(result.end(), row, row + image.width() * image.channels());
  }
  return result;
}

}  // namespace azulejo
