#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/data/pool.h"
#include "azulejo/io/tiff.h"
#include "azulejo/io/tiff_file.h"

namespace azulejo {
namespace {

/// Strips are about this large, enough for compression and little enough for caches, but not below a few rows:
/// what repeats, repeats from row to row.
constexpr std::size_t kStripBytes = std::size_t{1} << 18;
constexpr int kMinStripRows = 8;
/// Strips that are best given together, so that several threads have work.
constexpr int kStripsTogether = 8;
/// Files of more pixel bytes become BigTIFF: classic TIFF ends at 4 GiB, and compression may make noise larger.
constexpr std::uint64_t kMaxClassicBytes = std::uint64_t{3} << 30;

std::uint16_t compression_of(const std::string& name, const Output& output) {
  struct Choice {
    const char* name;
    std::uint16_t compression;
  };
  static constexpr Choice kChoices[] = {{"none", COMPRESSION_NONE},
                                        {"lzw", COMPRESSION_LZW},
                                        {"deflate", COMPRESSION_ADOBE_DEFLATE},
                                        {"packbits", COMPRESSION_PACKBITS},
                                        {"zstd", COMPRESSION_ZSTD}};
  if (name.empty()) return COMPRESSION_ADOBE_DEFLATE;
  for (const Choice& each : kChoices) {
    if (name != each.name) continue;
    if (TIFFIsCODECConfigured(each.compression) != 0) return each.compression;
    throw Error(Error::Unsupported, fmt::format("{}: this libtiff was built without {}", output.name(), name));
  }
  throw Error(Error::Argument, fmt::format("{}: TIFF compression \"{}\": none, lzw, deflate, packbits or zstd expected",
                                           output.name(), name));
}

bool has_predictor(unsigned compression) {
  return compression == COMPRESSION_LZW || compression == COMPRESSION_ADOBE_DEFLATE || compression == COMPRESSION_ZSTD;
}

/// How pixels become bytes: the same for the file and for each piece of it that is compressed by itself.
struct TiffCoding {
  ImageInfo info;
  std::uint16_t compression = COMPRESSION_NONE;
  int level = 6;

  void apply(TIFF* tiff) const {
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<unsigned>(8 * size_of(info.type)));
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, static_cast<unsigned>(info.channels));
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT,
                 static_cast<unsigned>(info.type == PixelType::F32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT));
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, static_cast<unsigned>(PLANARCONFIG_CONTIG));
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                 static_cast<unsigned>(info.channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB));
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, static_cast<unsigned>(compression));
    if (has_predictor(compression)) {
      TIFFSetField(tiff, TIFFTAG_PREDICTOR,
                   static_cast<unsigned>(info.type == PixelType::F32 ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL));
    }
    if (compression == COMPRESSION_ADOBE_DEFLATE) TIFFSetField(tiff, TIFFTAG_ZIPQUALITY, level);
    if (compression == COMPRESSION_ZSTD) TIFFSetField(tiff, TIFFTAG_ZSTD_LEVEL, std::max(level, 1));
  }
};

/// Packs and compresses one strip or tile. One a thread.
class UnitEncoder {
 public:
  /// Fills `result` with the bytes as they go into the file, for `part` at the top left of a unit of width×height
  /// pixels. Pixels of the unit beyond `part` are 0.
  void encode(const TiffCoding& coding, const ConstAnyView& part, int width, int height,
              std::vector<std::byte>& result) {
    const bool compressed = coding.compression != COMPRESSION_NONE;
    std::vector<std::byte>& packed = compressed ? packed_ : result;
    const std::size_t row_bytes = static_cast<std::size_t>(width) * coding.info.pixel_bytes();
    packed.resize(row_bytes * static_cast<std::size_t>(height));
    if (part.width() < width || part.height() < height) std::fill(packed.begin(), packed.end(), std::byte{0});
    for (int y = 0; y < part.height(); ++y) {
      std::memcpy(packed.data() + static_cast<std::size_t>(y) * row_bytes, part.row(y), part.info.row_bytes());
    }
    if (compressed) compress(coding, width, height, result);
  }

 private:
  /// libtiff compresses a file of this one strip, in memory: a tile's bytes are those of a strip of its size.
  void compress(const TiffCoding& coding, int width, int height, std::vector<std::byte>& result) {
    memory_.clear();
    const std::unique_ptr<Output> output = memory_output(memory_, "memory");
    TiffFile file(*output, false);
    TIFF* tiff = file.handle();
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(width));
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(height));
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(height));
    coding.apply(tiff);
    const auto bytes = static_cast<tmsize_t>(packed_.size());
    if (TIFFWriteEncodedStrip(tiff, 0, packed_.data(), bytes) != bytes) file.fail(Error::Resource, "compression");
    const auto begin = memory_.begin() + static_cast<std::ptrdiff_t>(TIFFGetStrileOffset(tiff, 0));
    result.assign(begin, begin + static_cast<std::ptrdiff_t>(TIFFGetStrileByteCount(tiff, 0)));
  }

  std::vector<std::byte> packed_;
  std::vector<std::byte> memory_;
};

class TiffEncoder final : public Encoder {
 public:
  TiffEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions& options,
              const Run& run);
  int row_group() const override;
  void write(const ConstAnyView& rows) override;
  void finish() override;

 private:
  void set_up(const Metadata& metadata);
  void write_groups(const ConstAnyView& rows);
  int across() const { return (coding_.info.width - 1) / unit_width_ + 1; }
  AnyView band() const {
    ImageInfo info = coding_.info;
    info.height = unit_height_;
    return {band_.data(), static_cast<std::ptrdiff_t>(info.row_bytes()), info};
  }

  Run run_;
  TiffCoding coding_;
  bool tiled_ = false;
  int unit_width_ = 0;
  int unit_height_ = 0;
  TiffFile file_;
  std::vector<UnitEncoder> encoders_;  ///< one a thread
  std::uint32_t next_unit_ = 0;
  int written_ = 0;  ///< rows that are in the file
  Buffer band_;      ///< rows that don't fill a row group yet
  int band_rows_ = 0;
};

int strip_rows(const ImageInfo& info) {
  const auto rows = static_cast<int>(std::min<std::size_t>(kStripBytes / info.row_bytes(), 1 << 20));
  return std::min(std::max(rows, kMinStripRows), info.height);
}

bool needs_big_tiff(const ImageInfo& info, int tile) {
  const std::uint64_t step = tile > 0 ? static_cast<std::uint64_t>(tile) : 1;
  const std::uint64_t width = (static_cast<std::uint64_t>(info.width) + step - 1) / step * step;
  const std::uint64_t height = (static_cast<std::uint64_t>(info.height) + step - 1) / step * step;
  return width * height * info.pixel_bytes() > kMaxClassicBytes;
}

TiffEncoder::TiffEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions& options,
                         const Run& run)
    : run_(run),
      coding_{info, compression_of(options.compression, output), options.compression_level},
      tiled_(options.tile > 0),
      unit_width_(tiled_ ? options.tile : info.width),
      unit_height_(tiled_ ? options.tile : strip_rows(info)),
      file_(output, needs_big_tiff(info, options.tile)),
      encoders_(static_cast<std::size_t>(std::max(thread_count(run), 1))) {
  set_up(metadata);
}

void TiffEncoder::set_up(const Metadata& metadata) {
  TIFF* tiff = file_.handle();
  const ImageInfo& info = coding_.info;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(info.width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(info.height));
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, static_cast<unsigned>(ORIENTATION_TOPLEFT));
  coding_.apply(tiff);
  if (tiled_) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, static_cast<std::uint32_t>(unit_width_));
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, static_cast<std::uint32_t>(unit_height_));
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(unit_height_));
  }
  if (info.channels % 2 == 0) {
    std::uint16_t kind = info.alpha == AlphaState::None       ? EXTRASAMPLE_UNSPECIFIED
                         : info.alpha == AlphaState::Straight ? EXTRASAMPLE_UNASSALPHA
                                                              : EXTRASAMPLE_ASSOCALPHA;
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1U, &kind);
  }
  if (metadata.density_x > 0 && metadata.density_y > 0) {
    TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, static_cast<unsigned>(RESUNIT_INCH));
    TIFFSetField(tiff, TIFFTAG_XRESOLUTION, static_cast<double>(metadata.density_x) * 0.0254);
    TIFFSetField(tiff, TIFFTAG_YRESOLUTION, static_cast<double>(metadata.density_y) * 0.0254);
  }
  if (!metadata.xmp.empty()) {
    TIFFSetField(tiff, TIFFTAG_XMLPACKET, static_cast<std::uint32_t>(metadata.xmp.size()), metadata.xmp.data());
  }
  for (const TiffText& each : tiff_texts()) {
    const auto text = metadata.text.find(each.name);
    if (text != metadata.text.end()) TIFFSetField(tiff, each.tag, text->second.c_str());
  }
}

int TiffEncoder::row_group() const {
  return tiled_ ? unit_height_ : std::min(unit_height_ * kStripsTogether, coding_.info.height);
}

void TiffEncoder::write(const ConstAnyView& rows) {
  const auto piece = [&](int from, int height) { return rows.crop({0, from, rows.width(), height}); };
  for (int done = 0; done < rows.height();) {
    const int left = rows.height() - done;
    const bool last = written_ + left == coding_.info.height;
    const int whole = last ? left : left - left % unit_height_;
    if (band_rows_ == 0 && whole > 0) {
      write_groups(piece(done, whole));
      done += whole;
      continue;
    }
    if (band_.size() == 0) band_ = Buffer(coding_.info.row_bytes() * static_cast<std::size_t>(unit_height_));
    const int height = std::min(unit_height_ - band_rows_, left);
    copy_pixels(piece(done, height), band().crop({0, band_rows_, rows.width(), height}));
    band_rows_ += height;
    done += height;
    if (band_rows_ == unit_height_ || written_ + band_rows_ == coding_.info.height) {
      write_groups(band().crop({0, 0, rows.width(), std::exchange(band_rows_, 0)}));
    }
  }
}

/// Compresses a batch of strips or tiles on all threads, then puts them into the file in their order.
void TiffEncoder::write_groups(const ConstAnyView& rows) {
  const int columns = across();
  const auto groups = static_cast<std::size_t>((rows.height() - 1) / unit_height_ + 1);
  const std::size_t units = groups * static_cast<std::size_t>(columns);
  const std::size_t batch = 16 * encoders_.size();
  std::vector<std::vector<std::byte>> encoded(std::min(batch, units));
  for (std::size_t first = 0; first < units; first += batch) {
    const std::size_t count = std::min(batch, units - first);
    parallel_tasks(count, run_, [&](std::size_t task, int worker) {
      const std::size_t unit = first + task;
      const int x = static_cast<int>(unit % static_cast<std::size_t>(columns)) * unit_width_;
      const int y = static_cast<int>(unit / static_cast<std::size_t>(columns)) * unit_height_;
      const Rect part{x, y, std::min(unit_width_, rows.width() - x), std::min(unit_height_, rows.height() - y)};
      UnitEncoder& encoder = encoders_[static_cast<std::size_t>(worker)];
      encoder.encode(coding_, rows.crop(part), unit_width_, tiled_ ? unit_height_ : part.height, encoded[task]);
    });
    for (std::size_t task = 0; task < count; ++task) {
      std::vector<std::byte>& bytes = encoded[task];
      const auto size = static_cast<tmsize_t>(bytes.size());
      const tmsize_t written = tiled_ ? TIFFWriteRawTile(file_.handle(), next_unit_, bytes.data(), size)
                                      : TIFFWriteRawStrip(file_.handle(), next_unit_, bytes.data(), size);
      if (written != size) file_.fail(Error::Io, fmt::format("{} {}", tiled_ ? "tile" : "strip", next_unit_));
      ++next_unit_;
    }
  }
  written_ += rows.height();
}

void TiffEncoder::finish() { file_.close(); }

}  // namespace

ImageInfo storable_in_tiff(const ImageInfo& info, const WriteOptions& options) {
  ImageInfo result = info;
  result.type = options.type.value_or(info.type);
  if (info.color == ColorState::Linear) result.color = ColorState::Srgb;
  return result;
}

std::unique_ptr<Encoder> encode_tiff(Output& output, const ImageInfo& info, const Metadata& metadata,
                                     const WriteOptions& options, const Run& run) {
  if (options.tile < 0 || options.tile % 16 != 0 || options.tile > 16384) {
    throw Error(Error::Argument, fmt::format("{}: tile {}: a multiple of 16 up to 16384 expected, or 0 for strips",
                                             output.name(), options.tile));
  }
  if (options.compression_level < 0 || options.compression_level > 9) {
    throw Error(Error::Argument,
                fmt::format("{}: compression level {}, 0 to 9 expected", output.name(), options.compression_level));
  }
  return std::make_unique<TiffEncoder>(output, info, metadata, options, run);
}

}  // namespace azulejo
