#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "azulejo/io/decoded_size.h"
#include "azulejo/io/exr.h"
#include "azulejo/io/exr_channels.h"
#include "azulejo/io/exr_stream.h"

namespace azulejo {
namespace {

constexpr double kMetresPerInch = 0.0254;
constexpr float kExactIntegers = 16777216.0F;  // f32 holds all integers up to 2^24
constexpr int kLongestText = 1 << 16;

const char* compression_name(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION: return "uncompressed";
    case Imf::RLE_COMPRESSION: return "rle";
    case Imf::ZIPS_COMPRESSION: return "zips";
    case Imf::ZIP_COMPRESSION: return "zip";
    case Imf::PIZ_COMPRESSION: return "piz";
    case Imf::PXR24_COMPRESSION: return "pxr24";
    case Imf::B44_COMPRESSION: return "b44";
    case Imf::B44A_COMPRESSION: return "b44a";
    case Imf::DWAA_COMPRESSION: return "dwaa";
    case Imf::DWAB_COMPRESSION: return "dwab";
    default: return "unknown compression";
  }
}

const char* type_name(Imf::PixelType type) {
  return type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
}

Rect to_rect(const Imath::Box2i& box) { return rect_between(box.min.x, box.min.y, box.max.x + 1, box.max.y + 1); }

using Matrix = std::array<std::array<double, 3>, 3>;

/// Linear RGB of the file's primaries into Rec. 709's, as rows for red, green and blue; nothing where they are the
/// same. The white point is moved by Bradford's transform (Lindbloom, "Chromatic Adaptation").
std::optional<Matrix> rec709_from(const Imf::Chromaticities& from, const std::string& name) {
  const Imf::Chromaticities to;
  if (from == to) return std::nullopt;
  const auto white = [](const Imf::Chromaticities& c) {
    return Imath::V3d(c.white.x / c.white.y, 1, (1 - c.white.x - c.white.y) / c.white.y);
  };
  const Imath::M44d cone(0.8951, -0.7502, 0.0389, 0, 0.2664, 1.7135, -0.0685, 0, -0.1614, 0.0367, 1.0296, 0, 0, 0, 0,
                         1);
  const Imath::V3d from_white = white(from) * cone;
  const Imath::V3d to_white = white(to) * cone;
  Imath::M44d adapt;
  adapt.setScale(to_white / from_white);
  // Imath multiplies row vectors: the first step stands first.
  const Imath::M44d all =
      Imath::M44d(Imf::RGBtoXYZ(from, 1)) * cone * adapt * cone.inverse() * Imath::M44d(Imf::XYZtoRGB(to, 1));
  Matrix result{};
  for (std::size_t out = 0; out < 3; ++out) {
    for (std::size_t in = 0; in < 3; ++in) {
      result[out][in] = all[static_cast<int>(in)][static_cast<int>(out)];
      if (std::isfinite(result[out][in])) continue;
      throw Error(Error::Data, fmt::format("{}: chromaticities that span no triangle", name));
    }
  }
  return result;
}

class ExrDecoder : public Decoder {
 public:
  ExrDecoder(const std::shared_ptr<const Input>& input, const ReadOptions& options, const Run& run);
  int row_group() const override { return row_group_; }
  void read(const AnyView& rows) override;

 private:
  void open(const ReadOptions& options);
  void check_sizes(const Imf::Header& header) const;
  void describe(const Imf::Header& header);
  void prepare(const Imf::Header& header, const ReadOptions& options);
  void read_line(int y);
  void convert_line();
  void place_line(float* row) const;
  const std::string& name() const { return input_->name(); }

  std::shared_ptr<const Input> input_;
  Run run_;
  std::unique_ptr<ExrInputStream> stream_;
  std::unique_ptr<Imf::MultiPartInputFile> file_;
  std::unique_ptr<Imf::InputPart> part_;
  std::unique_ptr<Imf::RgbaInputFile> chroma_;  ///< instead of part_ for luminance and chroma
  ExrChoice choice_;
  Rect display_;
  Rect data_;
  int row_group_ = 1;
  int next_row_ = 0;
  std::vector<float> line_;  ///< one row of the data window, interleaved
  std::vector<Imf::Rgba> chroma_line_;
  std::vector<std::size_t> integers_;  ///< channels that are 32-bit integers in the file
  bool warned_inexact_ = false;
  std::optional<Matrix> matrix_;
};

ExrDecoder::ExrDecoder(const std::shared_ptr<const Input>& input, const ReadOptions& options, const Run& run)
    : input_(input), run_(run) {
  check_exr_attributes(input);
  stream_ = std::make_unique<ExrInputStream>(input);
  try {
    open(options);
  } catch (...) {
    rethrow_exr_error(name(), stream_->failure());
  }
}

void ExrDecoder::open(const ReadOptions& options) {
  file_ = std::make_unique<Imf::MultiPartInputFile>(*stream_, 0);
  choice_ = choose_exr_channels(*file_, options.layer, name(), run_);
  const Imf::Header& header = file_->header(choice_.part);
  if (header.hasType() && Imf::isDeepData(header.type())) {
    throw Error(Error::Unsupported, fmt::format("{}: deep data", name()));
  }
  header_.file.layers = exr_layers(*file_);
  header_.file.pages = 1;
  display_ = to_rect(header.displayWindow());
  data_ = to_rect(header.dataWindow());
  check_sizes(header);
  describe(header);
  prepare(header, options);
}

/// What OpenEXR would allocate for a row of tiles or a block of lines, before it does.
void ExrDecoder::check_sizes(const Imf::Header& header) const {
  if (display_.empty() || data_.empty()) throw Error(Error::Data, fmt::format("{}: an empty window", name()));
  for (const Rect& window : {display_, data_}) {
    check_decoded_size(name(), static_cast<std::uint64_t>(window.width), static_cast<std::uint64_t>(window.height),
                       run_);
  }
  std::int64_t channels = 0;
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at) ++channels;
  const std::int64_t rows = header.hasTileDescription() ? header.tileDescription().ySize : 32;
  const std::int64_t columns =
      std::max<std::int64_t>(data_.width, header.hasTileDescription() ? header.tileDescription().xSize : 0);
  const std::int64_t limit = run_.limits.memory_bytes / static_cast<std::int64_t>(sizeof(float));
  if (columns > limit / rows / channels) {
    throw Error(Error::Resource, fmt::format("{}: blocks of {}×{} pixels of {} channels pass the limit of {} bytes",
                                             name(), columns, rows, channels, run_.limits.memory_bytes));
  }
}

void ExrDecoder::describe(const Imf::Header& header) {
  ImageFile& file = header_.file;
  file.format = "exr";
  file.info = {display_.width, display_.height, static_cast<int>(choice_.channels.size()),
               PixelType::F32, choice_.color,   choice_.alpha};
  file.stored_width = display_.width;
  file.stored_height = display_.height;
  const Imf::PixelType type = header.channels()[choice_.channels.front()].type;
  file.bits = type == Imf::HALF ? 16 : 32;
  const bool tiled = header.hasTileDescription();
  const std::string layout =
      tiled ? fmt::format("tiles {}×{}", header.tileDescription().xSize, header.tileDescription().ySize) : "scan lines";
  file.encoding = fmt::format("{}, {}, {}{}", type_name(type), layout, compression_name(header.compression()),
                              choice_.chroma ? ", luminance and chroma" : "");
  if (tiled) row_group_ = static_cast<int>(std::min<std::int64_t>(header.tileDescription().ySize, display_.height));
  if (Imf::hasXDensity(header) && Imf::xDensity(header) > 0) {
    file.metadata.density_x = static_cast<float>(Imf::xDensity(header) / kMetresPerInch);
    file.metadata.density_y = file.metadata.density_x * header.pixelAspectRatio();
  }
  for (auto at = header.begin(); at != header.end(); ++at) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&at.attribute());
    const std::string key = at.name();
    if (text == nullptr || text->value().size() > kLongestText || key == "name" || key == "type" || key == "view") {
      continue;
    }
    file.metadata.text[key] = text->value();
  }
}

void ExrDecoder::prepare(const Imf::Header& header, const ReadOptions& options) {
  if (options.convert_profile && choice_.channels.size() >= 3 && choice_.color == ColorState::Linear &&
      Imf::hasChromaticities(header)) {
    matrix_ = rec709_from(Imf::chromaticities(header), name());
    if (matrix_) warn(run_, fmt::format("{}: primaries other than Rec. 709's: colours are converted", name()));
  }
  const std::size_t channels = choice_.channels.size();
  line_.resize(static_cast<std::size_t>(data_.width) * channels);
  if (choice_.chroma) {
    if (choice_.part != 0) throw Error(Error::Unsupported, fmt::format("{}: chroma in a later part", name()));
    stream_->seekg(0);
    const std::string layer = choice_.prefix.substr(0, choice_.prefix.size() - (choice_.prefix.empty() ? 0 : 1));
    file_.reset();
    chroma_ = std::make_unique<Imf::RgbaInputFile>(*stream_, layer, 0);
    chroma_line_.resize(static_cast<std::size_t>(data_.width));
    // All rows go to the one line: a row stride of 0.
    chroma_->setFrameBuffer(chroma_line_.data() - data_.x, 1, 0);
    return;
  }
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < channels; ++i) {
    const Imf::Channel& channel = header.channels()[choice_.channels[i]];
    if (channel.xSampling != 1 || channel.ySampling != 1) {
      throw Error(Error::Unsupported, fmt::format("{}: channel {} is subsampled", name(), choice_.channels[i]));
    }
    if (channel.type == Imf::UINT) integers_.push_back(i);
    const auto step = static_cast<std::ptrdiff_t>(channels);
    char* base = reinterpret_cast<char*>(line_.data() + (static_cast<std::ptrdiff_t>(i) - data_.x * step));
    buffer.insert(choice_.channels[i], Imf::Slice(Imf::FLOAT, base, channels * sizeof(float), 0));
  }
  part_ = std::make_unique<Imf::InputPart>(*file_, choice_.part);
  part_->setFrameBuffer(buffer);
}

/// Fills line_ with row y of the data window.
void ExrDecoder::read_line(int y) {
  if (!chroma_) {
    part_->readPixels(y);
    return;
  }
  chroma_->readPixels(y);
  const bool alpha = choice_.alpha != AlphaState::None;
  float* result = line_.data();
  for (const Imf::Rgba& pixel : chroma_line_) {
    *result++ = pixel.r;
    *result++ = pixel.g;
    *result++ = pixel.b;
    if (alpha) *result++ = pixel.a;
  }
}

void ExrDecoder::convert_line() {
  const std::size_t channels = choice_.channels.size();
  for (const std::size_t channel : integers_) {
    for (std::size_t at = channel; at < line_.size() && !warned_inexact_; at += channels) {
      if (line_[at] < kExactIntegers) continue;
      warn(run_, fmt::format("{}: 32-bit integers above 2^24 are rounded", name()));
      warned_inexact_ = true;
    }
  }
  if (!matrix_) return;
  for (std::size_t at = 0; at < line_.size(); at += channels) {
    const std::array<double, 3> rgb{line_[at], line_[at + 1], line_[at + 2]};
    for (std::size_t out = 0; out < 3; ++out) {
      const auto& weights = (*matrix_)[out];
      line_[at + out] = static_cast<float>(weights[0] * rgb[0] + weights[1] * rgb[1] + weights[2] * rgb[2]);
    }
  }
}

/// Copies what the data window has of the display window into one row of the image.
void ExrDecoder::place_line(float* row) const {
  const std::size_t channels = choice_.channels.size();
  const std::int64_t left = std::max(data_.x, display_.x);
  const std::int64_t right = std::min(data_.right(), display_.right());
  if (left >= right) return;
  std::memcpy(row + static_cast<std::size_t>(left - display_.x) * channels,
              line_.data() + static_cast<std::size_t>(left - data_.x) * channels,
              static_cast<std::size_t>(right - left) * channels * sizeof(float));
}

void ExrDecoder::read(const AnyView& rows) {
  for (int i = 0; i < rows.height(); ++i, ++next_row_) {
    float* row = rows.as<float>().row(i);
    std::memset(row, 0, rows.info.row_bytes());
    const int y = display_.y + next_row_;
    if (y < data_.y || y >= data_.bottom()) continue;
    try {
      read_line(y);
    } catch (...) {
      rethrow_exr_error(fmt::format("{}: row {}", name(), next_row_), stream_->failure());
    }
    convert_line();
    place_line(row);
  }
}

}  // namespace

std::unique_ptr<Decoder> decode_exr(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run) {
  return std::make_unique<ExrDecoder>(input, options, run);
}

}  // namespace azulejo
