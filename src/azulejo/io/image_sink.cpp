#include "azulejo/io/image_sink.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/convert_rows.h"
#include "azulejo/io/decode_pass.h"

namespace azulejo {
namespace {

/// Rows that go to the encoder together where its format doesn't care.
constexpr int kStripRows = 16;

ImageInfo storable(const Codec& codec, const ImageInfo& info, const WriteOptions& options, const std::string& name) {
  try {
    ImageInfo result = codec.storable(info, options);
    result.width = info.width;
    result.height = info.height;
    return result;
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", name, error.what()));
  }
}

class FileSink final : public ImageSink {
 public:
  FileSink(std::unique_ptr<Output> output, const Codec& codec, const ImageInfo& info, const Metadata& metadata,
           const WriteOptions& options, std::optional<ValueRange> range, const Run& run)
      : run_(run),
        output_(std::move(output)),
        info_(info),
        stored_(storable(codec, info, options, output_->name())),
        converter_(info, stored_, {options.background[0], options.background[1], options.background[2]}),
        encoder_(codec.encode(*output_, stored_, metadata, options, run_)) {
    ImageInfo strip = stored_;
    const int group = std::max(1, encoder_->row_group());
    strip.height = std::min(info.height, group == 1 ? kStripRows : group);
    strip_ = allocate_image(output_->name(), strip, run.limits.memory_bytes, run);
    if (!options.normalize || info.type != PixelType::F32 || stored_.type == PixelType::F32) return;
    stretched_ = true;
    if (range) {
      converter_.stretch(range->low, range->high);
    } else {
      kept_ = allocate_image(output_->name(), info, run.limits.memory_bytes, run);
    }
  }

  int row_group() const override { return encoder_->row_group(); }

  void write(const ConstAnyView& rows) override {
    if (given_ + rows.height() > info_.height) {
      throw Error(Error::Argument, fmt::format("{}: more than {} rows were written", output_->name(), info_.height));
    }
    if (kept_.empty()) {
      encode(rows);
    } else {
      copy_pixels(rows, kept_.any().crop({0, given_, info_.width, rows.height()}));
    }
    given_ += rows.height();
  }

  void finish() override {
    if (given_ != info_.height) {
      throw Error(Error::Argument,
                  fmt::format("{}: {} rows were written, {} expected", output_->name(), given_, info_.height));
    }
    if (!kept_.empty()) {
      const ValueRange range = value_range(std::as_const(kept_).any());
      converter_.stretch(range.low, range.high);
      encode(std::as_const(kept_).any());
    }
    encoder_->finish();
    // What is clipped in spite of stretching isn't finite: a depth where nothing is, say.
    if (converter_.clipped() > 0 && !stretched_) {
      warn(run_, fmt::format("{}: {} values outside 0–1 were clipped; normalize would stretch them", output_->name(),
                             converter_.clipped()));
    }
    output_->commit();
  }

 private:
  /// Converts into the strip, which goes to the encoder when it is full.
  void encode(const ConstAnyView& rows) {
    for (int y = 0; y < rows.height();) {
      const int count = std::min(strip_.height() - filled_, rows.height() - y);
      converter_.convert(rows.crop({0, y, info_.width, count}), strip_.any().crop({0, filled_, info_.width, count}));
      y += count;
      filled_ += count;
      encoded_ += count;
      if (filled_ < strip_.height() && encoded_ < info_.height) continue;
      encoder_->write(std::as_const(strip_).any().crop({0, 0, info_.width, filled_}));
      filled_ = 0;
    }
  }

  Run run_;
  std::unique_ptr<Output> output_;
  ImageInfo info_;
  ImageInfo stored_;
  RowConverter converter_;
  std::unique_ptr<Encoder> encoder_;
  Image strip_;  ///< of what the format holds
  bool stretched_ = false;
  Image kept_;       ///< everything, while the range isn't known; else empty
  int given_ = 0;    ///< rows written by the caller
  int filled_ = 0;   ///< rows in the strip
  int encoded_ = 0;  ///< rows converted
};

}  // namespace

ValueRange value_range(const ConstAnyView& pixels) {
  ValueRange range = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  const auto channels = static_cast<std::size_t>(pixels.info.channels);
  const auto colors = static_cast<std::size_t>(pixels.info.color_channels());
  visit(pixels, [&](auto view) {
    for (int y = 0; y < view.height; ++y) {
      const auto* const row = view.row(y);
      for (std::size_t i = 0; i < static_cast<std::size_t>(view.width) * channels; ++i) {
        const auto value = static_cast<float>(row[i]);
        if (i % channels >= colors || !std::isfinite(value)) continue;
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
      }
    }
  });
  return range.low <= range.high ? range : ValueRange{};
}

std::unique_ptr<ImageSink> make_file_sink(std::unique_ptr<Output> output, const Codec& codec, const ImageInfo& info,
                                          const Metadata& metadata, const WriteOptions& options,
                                          std::optional<ValueRange> range, const Run& run) {
  return std::make_unique<FileSink>(std::move(output), codec, info, metadata, options, range, run);
}

}  // namespace azulejo
