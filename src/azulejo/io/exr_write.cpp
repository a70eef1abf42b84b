#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "azulejo/io/exr.h"
#include "azulejo/io/exr_stream.h"

namespace azulejo {
namespace {

constexpr int kRowGroup = 32;  // lines in OpenEXR's largest blocks of the compressions offered
constexpr float kMetresPerInch = 0.0254F;
constexpr std::size_t kLongestName = 255;

std::vector<std::string> channel_names(const ImageInfo& info) {
  const int colors = info.color_channels();
  std::vector<std::string> names;
  if (info.color != ColorState::Data && colors == 3) {
    names = {"R", "G", "B"};
  } else if (info.color != ColorState::Data && colors == 1) {
    names = {"Y"};
  } else if (colors == 1) {
    names = {"V"};
  } else {
    names = {"X", "Y", "Z", "W"};
    names.resize(static_cast<std::size_t>(colors));
  }
  if (info.alpha != AlphaState::None) names.emplace_back("A");
  return names;
}

class ExrEncoder : public Encoder {
 public:
  ExrEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions& options,
             const Run& run);
  int row_group() const override { return group_rows_; }
  void write(const ConstAnyView& rows) override;
  void finish() override;

 private:
  Imf::Header make_header(const Metadata& metadata, const WriteOptions& options) const;
  void store_row(const float* source);
  void flush();

  ImageInfo info_;
  Run run_;
  std::string name_;
  std::vector<std::string> channels_;
  Imf::PixelType type_;
  std::size_t sample_bytes_;
  int group_rows_;
  int group_start_ = 0;
  int stored_rows_ = 0;           ///< of the group
  std::vector<std::byte> group_;  ///< the group's rows, interleaved, of type_
  bool overflow_ = false;         ///< a finite value became infinite as half
  ExrOutputStream stream_;
  std::unique_ptr<Imf::OutputFile> lines_;
  std::unique_ptr<Imf::TiledOutputFile> tiles_;
};

ExrEncoder::ExrEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions& options,
                       const Run& run)
    : info_(info),
      run_(run),
      name_(output.name()),
      channels_(channel_names(info)),
      type_(options.type.value_or(PixelType::F32) == PixelType::F32 ? Imf::FLOAT : Imf::HALF),
      sample_bytes_(type_ == Imf::FLOAT ? sizeof(float) : sizeof(Imath::half)),
      group_rows_(options.tile > 0 ? options.tile : kRowGroup),
      stream_(output) {
  try {
    const Imf::Header header = make_header(metadata, options);
    if (options.tile > 0) {
      tiles_ = std::make_unique<Imf::TiledOutputFile>(stream_, header, 0);
    } else {
      lines_ = std::make_unique<Imf::OutputFile>(stream_, header, 0);
    }
    const auto rows = static_cast<std::size_t>(std::min(group_rows_, info.height));
    group_.resize(rows * static_cast<std::size_t>(info.width * info.channels) * sample_bytes_);
  } catch (...) {
    rethrow_exr_error(name_, stream_.failure());
  }
}

Imf::Header ExrEncoder::make_header(const Metadata& metadata, const WriteOptions& options) const {
  Imf::Header header(info_.width, info_.height);
  header.compression() = exr_compression(options.compression);
  for (const std::string& each : channels_) header.channels().insert(each, Imf::Channel(type_));
  if (options.tile > 0) {
    const auto size = static_cast<unsigned>(options.tile);
    header.setTileDescription(Imf::TileDescription(size, size, Imf::ONE_LEVEL));
  }
  if (metadata.density_x > 0) {
    Imf::addXDensity(header, metadata.density_x * kMetresPerInch);
    if (metadata.density_y > 0) header.pixelAspectRatio() = metadata.density_y / metadata.density_x;
  }
  for (const auto& [key, text] : metadata.text) {
    const bool usable = !key.empty() && key.size() <= kLongestName && header.find(key) == header.end();
    if (usable && key != "name" && key != "type" && key != "view") header.insert(key, Imf::StringAttribute(text));
  }
  return header;
}

/// One row into the group, as float or half.
void ExrEncoder::store_row(const float* source) {
  const auto count = static_cast<std::size_t>(info_.width) * static_cast<std::size_t>(info_.channels);
  std::byte* result = group_.data() + static_cast<std::size_t>(stored_rows_) * count * sample_bytes_;
  if (type_ == Imf::FLOAT) {
    std::copy_n(source, count, reinterpret_cast<float*>(result));
  } else {
    auto* halves = reinterpret_cast<Imath::half*>(result);
    for (std::size_t i = 0; i < count; ++i) {
      halves[i] = Imath::half(source[i]);
      overflow_ |= halves[i].isInfinity() && std::isfinite(source[i]);
    }
  }
  ++stored_rows_;
}

void ExrEncoder::write(const ConstAnyView& rows) {
  for (int y = 0; y < rows.height(); ++y) {
    store_row(rows.as<float>().row(y));
    if (stored_rows_ == group_rows_ || group_start_ + stored_rows_ == info_.height) flush();
  }
}

void ExrEncoder::flush() {
  const std::size_t pixel = channels_.size() * sample_bytes_;
  const std::size_t row = pixel * static_cast<std::size_t>(info_.width);
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    // OpenEXR counts rows from the top of the image; the group begins at group_start_.
    char* base =
        reinterpret_cast<char*>(group_.data() + i * sample_bytes_) - static_cast<std::ptrdiff_t>(row) * group_start_;
    buffer.insert(channels_[i], Imf::Slice(type_, base, pixel, row));
  }
  try {
    if (tiles_) {
      tiles_->setFrameBuffer(buffer);
      tiles_->writeTiles(0, tiles_->numXTiles() - 1, group_start_ / group_rows_, group_start_ / group_rows_);
    } else {
      lines_->setFrameBuffer(buffer);
      lines_->writePixels(stored_rows_);
    }
  } catch (...) {
    rethrow_exr_error(name_, stream_.failure());
  }
  group_start_ += stored_rows_;
  stored_rows_ = 0;
}

void ExrEncoder::finish() {
  // The destructors write the table of offsets, and keep exceptions to themselves.
  tiles_.reset();
  lines_.reset();
  if (stream_.failure()) std::rethrow_exception(stream_.failure());
  if (overflow_) warn(run_, fmt::format("{}: values beyond 65504 became infinite as half", name_));
}

}  // namespace

Imf::Compression exr_compression(const std::string& name) {
  if (name.empty() || name == "zip") return Imf::ZIP_COMPRESSION;
  if (name == "piz") return Imf::PIZ_COMPRESSION;
  if (name == "rle") return Imf::RLE_COMPRESSION;
  if (name == "none") return Imf::NO_COMPRESSION;
  throw Error(Error::Argument, fmt::format("compression: \"{}\"; EXR has none, rle, zip, piz", name));
}

std::unique_ptr<Encoder> encode_exr(Output& output, const ImageInfo& info, const Metadata& metadata,
                                    const WriteOptions& options, const Run& run) {
  return std::make_unique<ExrEncoder>(output, info, metadata, options, run);
}

}  // namespace azulejo
