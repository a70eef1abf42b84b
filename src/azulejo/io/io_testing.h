#pragma once

// What the tests of image files share.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/io/image_io.h"

namespace azulejo {

/// The folder of sample images that may lie beside the source; tests that need it are skipped where it is absent.
inline std::filesystem::path shared_images() {
  return std::filesystem::path(AZULEJO_SOURCE_FOLDER).parent_path() / "shared" / "data" / "images";
}

/// Random pixels; f32 in 0–1. Equal seeds give equal images.
inline Image random_image(const ImageInfo& info, unsigned seed) {
  std::mt19937 random(seed);
  Image image(info);
  visit(image.any(), [&](auto view) {
    using T = std::remove_reference_t<decltype(*view.data)>;
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        view.row(y)[i] = static_cast<T>(static_cast<float>(random() % 65536) / 65535.0F * full_range(info.type));
      }
    }
  });
  return image;
}

/// Size, channels, type and every pixel; the states are the caller's to compare.
inline ::testing::AssertionResult same_pixels(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels() || a.type() != b.type()) {
    return ::testing::AssertionFailure() << describe(a.info()) << " and " << describe(b.info());
  }
  for (int y = 0; y < a.height(); ++y) {
    if (std::memcmp(a.any().row(y), b.any().row(y), a.info().row_bytes()) != 0) {
      return ::testing::AssertionFailure() << "row " << y << " differs";
    }
  }
  return ::testing::AssertionSuccess();
}

/// The largest difference of two images of the same shape, in units of full range.
inline float largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.width(), b.width());
  EXPECT_EQ(a.height(), b.height());
  EXPECT_EQ(a.channels(), b.channels());
  const auto value = [](const ConstAnyView& view, int y, int i) {
    return visit(view, [&](auto pixels) { return static_cast<float>(pixels.row(y)[i]); }) / full_range(view.info.type);
  };
  float largest = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int i = 0; i < a.width() * a.channels(); ++i) {
      largest = std::max(largest, std::abs(value(a.any(), y, i) - value(b.any(), y, i)));
    }
  }
  return largest;
}

inline std::span<const std::byte> as_bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

/// Collects warnings.
struct Warnings {
  std::vector<std::string> lines;
  azulejo::Run run() {
    azulejo::Run result;
    result.warn = [this](const std::string& line) { lines.push_back(line); };
    return result;
  }
};

/// The kind of error that `f` throws; fails the test where it throws none.
template <class F>
Error::Kind kind_of_error(const F& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "no error was thrown";
  return Error::Cancelled;
}

}  // namespace azulejo
