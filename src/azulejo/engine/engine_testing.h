#pragma once

// For tests only: images that are given and taken by rows, as files are.

#include <memory>

#include <gtest/gtest.h>

#include "azulejo/engine/source.h"

namespace azulejo {

/// Gives an image, which the caller keeps alive, by rows, each pass from the top.
class RowsOf final : public ImageSource {
 public:
  explicit RowsOf(const Image& image) : image_(image) {}
  const ImageInfo& info() const override { return image_.info(); }
  const Metadata& metadata() const override { return image_.metadata(); }
  std::unique_ptr<RowReader> rows(const Run&) override {
    struct Reader final : RowReader {
      explicit Reader(const Image& whole) : image(whole) {}
      void read(int y, const AnyView& rows) override {
        ASSERT_GE(y, next) << "rows are asked for out of order";
        next = y + rows.height();
        ASSERT_LE(next, image.height());
        copy_pixels(image.any().crop({0, y, image.width(), rows.height()}), rows);
      }
      const Image& image;
      int next = 0;
    };
    return std::make_unique<Reader>(image_);
  }

 private:
  const Image& image_;
};

/// Collects rows into an image.
class RowsInto final : public ImageSink {
 public:
  explicit RowsInto(const ImageInfo& info) : image(info) {}
  void write(const ConstAnyView& rows) override {
    ASSERT_LE(next + rows.height(), image.height());
    copy_pixels(rows, image.any().crop({0, next, image.width(), rows.height()}));
    next += rows.height();
  }
  void finish() override { finished = next == image.height(); }

  Image image;
  int next = 0;
  bool finished = false;
};

}  // namespace azulejo
