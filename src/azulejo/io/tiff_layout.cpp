#include "azulejo/io/tiff_layout.h"

#include <span>
#include <utility>

#include <fmt/format.h>

#include "azulejo/io/decoded_size.h"
#include "azulejo/io/tiff.h"

namespace azulejo {
namespace {

template <class T>
T tag(TIFF* tiff, std::uint32_t number, T otherwise) {
  T value = otherwise;
  return TIFFGetFieldDefaulted(tiff, number, &value) == 1 ? value : otherwise;
}

/// What the samples mean: colours first, then what is called alpha or something else.
struct Meaning {
  unsigned photometric = PHOTOMETRIC_MINISBLACK;
  unsigned samples = 1;
  unsigned colors = 1;                  ///< samples that are colours
  AlphaState alpha = AlphaState::None;  ///< of the sample after them
};

class LayoutReader {
 public:
  LayoutReader(TiffFile& file, const std::string& name, DecodedHeader& header, const Run& run)
      : tiff_(file.handle()), name_(name), header_(header), run_(run) {}

  TiffLayout read() {
    read_size();
    layout_.compression = tag<std::uint16_t>(tiff_, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    if (TIFFIsCODECConfigured(static_cast<std::uint16_t>(layout_.compression)) == 0) {
      refuse(fmt::format("compression {} ({})", layout_.compression, tiff_compression_name(layout_.compression)));
    }
    read_meaning();
    read_alpha();
    read_samples();
    read_units();
    describe();
    return std::move(layout_);
  }

 private:
  void read_size();
  void read_meaning();
  void read_alpha();
  void read_samples();
  void read_palette();
  void read_units();
  void describe();
  bool needs_libtiff() const;
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(Error::Unsupported, fmt::format("{}: directory: {} can't be read", name_, what));
  }
  [[noreturn]] void damaged(const std::string& what) const {
    throw Error(Error::Data, fmt::format("{}: directory: {}", name_, what));
  }

  TIFF* tiff_;
  const std::string& name_;
  DecodedHeader& header_;
  const Run& run_;
  TiffLayout layout_;
  Meaning meaning_;
  bool separate_ = false;
};

void LayoutReader::read_size() {
  layout_.width = tag<std::uint32_t>(tiff_, TIFFTAG_IMAGEWIDTH, 0);
  layout_.height = tag<std::uint32_t>(tiff_, TIFFTAG_IMAGELENGTH, 0);
  check_decoded_size(name_, layout_.width, layout_.height, run_);
  if (tag<std::uint32_t>(tiff_, TIFFTAG_IMAGEDEPTH, 1) > 1) refuse("an image of several slices");
  header_.file.stored_width = static_cast<int>(layout_.width);
  header_.file.stored_height = static_cast<int>(layout_.height);
}

void LayoutReader::read_meaning() {
  meaning_.samples = tag<std::uint16_t>(tiff_, TIFFTAG_SAMPLESPERPIXEL, 1);
  if (meaning_.samples < 1) damaged("0 samples per pixel");
  separate_ = tag<std::uint16_t>(tiff_, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE &&
              meaning_.samples > 1;
  std::uint16_t photometric = 0;
  if (TIFFGetField(tiff_, TIFFTAG_PHOTOMETRIC, &photometric) != 1) {
    photometric = meaning_.samples >= 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK;
    warn(run_, fmt::format("{}: directory: no photometric interpretation: {} taken", name_,
                           meaning_.samples >= 3 ? "RGB" : "gray"));
  }
  meaning_.photometric = photometric;
  switch (photometric) {
    case PHOTOMETRIC_MINISWHITE:
    case PHOTOMETRIC_MINISBLACK:
    case PHOTOMETRIC_MASK:
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_PALETTE: meaning_.colors = 1; break;
    case PHOTOMETRIC_RGB:
    case PHOTOMETRIC_YCBCR:
    case PHOTOMETRIC_LOGLUV:
    case PHOTOMETRIC_CIELAB: meaning_.colors = 3; break;
    case PHOTOMETRIC_SEPARATED: meaning_.colors = 4; break;
    default: refuse(fmt::format("photometric interpretation {}", photometric));
  }
  if (meaning_.samples < meaning_.colors) {
    damaged(fmt::format("{} samples per pixel, {} or more expected", meaning_.samples, meaning_.colors));
  }
  if (photometric == PHOTOMETRIC_SEPARATED && tag<std::uint16_t>(tiff_, TIFFTAG_INKSET, INKSET_CMYK) != INKSET_CMYK) {
    refuse("inks that aren't CMYK");
  }
}

void LayoutReader::read_alpha() {
  const unsigned extra = meaning_.samples - meaning_.colors;
  if (extra == 0) return;
  std::uint16_t count = 0;
  std::uint16_t* kinds = nullptr;
  const bool said = TIFFGetField(tiff_, TIFFTAG_EXTRASAMPLES, &count, &kinds) == 1 && count > 0;
  const std::uint16_t kind = said ? kinds[0] : std::uint16_t{EXTRASAMPLE_UNSPECIFIED};
  const bool may_have_alpha = meaning_.photometric == PHOTOMETRIC_RGB || meaning_.photometric <= PHOTOMETRIC_MINISBLACK;
  unsigned left_out = extra;
  if (may_have_alpha && (kind != EXTRASAMPLE_UNSPECIFIED || extra == 1)) {
    meaning_.alpha = kind == EXTRASAMPLE_ASSOCALPHA ? AlphaState::Premultiplied : AlphaState::Straight;
    --left_out;
    if (kind == EXTRASAMPLE_UNSPECIFIED) {
      warn(run_, fmt::format("{}: directory: an extra sample of unspecified meaning is taken for alpha", name_));
    }
  }
  if (left_out > 0) {
    warn(run_, fmt::format("{}: directory: {} of {} samples per pixel left out", name_, left_out, meaning_.samples));
  }
}

/// libtiff makes RGB of what would need upsampling or a colour model that azulejo has no other use for.
bool LayoutReader::needs_libtiff() const {
  if (meaning_.photometric == PHOTOMETRIC_CIELAB || layout_.compression == COMPRESSION_OJPEG) return true;
  return meaning_.photometric == PHOTOMETRIC_YCBCR && (layout_.compression != COMPRESSION_JPEG || separate_);
}

void LayoutReader::read_samples() {
  TiffSamples& samples = layout_.samples;
  samples.bits = tag<std::uint16_t>(tiff_, TIFFTAG_BITSPERSAMPLE, 1);
  header_.file.bits = static_cast<int>(samples.bits);
  header_.file.info = {static_cast<int>(layout_.width), static_cast<int>(layout_.height)};
  ImageInfo& info = header_.file.info;
  layout_.by_libtiff = needs_libtiff();
  if (layout_.by_libtiff) {
    char reason[1024] = "";
    if (TIFFRGBAImageOK(tiff_, reason) == 0) refuse(std::string("this kind of image (") + reason + ")");
    info.channels = 3;
    meaning_.alpha = AlphaState::None;
    return;
  }
  const unsigned format = tag<std::uint16_t>(tiff_, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  samples.kind = format == SAMPLEFORMAT_IEEEFP ? TiffSamples::Kind::Float
                 : format == SAMPLEFORMAT_INT  ? TiffSamples::Kind::Signed
                                               : TiffSamples::Kind::Unsigned;
  samples.stored = separate_ ? 1 : meaning_.samples;
  samples.invert = meaning_.photometric == PHOTOMETRIC_MINISWHITE && samples.kind == TiffSamples::Kind::Unsigned;
  samples.xyz = meaning_.photometric == PHOTOMETRIC_LOGLUV;
  if (format > SAMPLEFORMAT_VOID || !tiff_samples_readable(samples)) {
    refuse(fmt::format("sample format {} of {} bits", format, samples.bits));
  }
  if (samples.invert && meaning_.alpha != AlphaState::None) refuse("alpha beside samples whose 0 is white");
  info.channels = static_cast<int>(meaning_.colors) + (meaning_.alpha == AlphaState::None ? 0 : 1);
  info.alpha = meaning_.alpha;
  if (meaning_.photometric == PHOTOMETRIC_PALETTE) {
    read_palette();
    info.channels = 3;
  }
  info.type = tiff_pixel_type(samples);
  const bool light = meaning_.photometric == PHOTOMETRIC_LOGL || meaning_.photometric == PHOTOMETRIC_LOGLUV;
  if (light) info.color = ColorState::Linear;
  if (samples.kind == TiffSamples::Kind::Signed) info.color = ColorState::Data;
  header_.cmyk = meaning_.photometric == PHOTOMETRIC_SEPARATED;
  if (header_.cmyk && info.type == PixelType::F32) refuse(fmt::format("CMYK of {} bits", samples.bits));
}

/// Colour maps have 16 bits a colour; many are 8 bits in the upper half (the lower half filled with zeros, ones or
/// the same again) or, wrongly, in the lower.
void LayoutReader::read_palette() {
  TiffSamples& samples = layout_.samples;
  std::uint16_t* maps[3] = {};
  if (samples.bits > 16 || samples.kind != TiffSamples::Kind::Unsigned) {
    refuse(fmt::format("a palette of {} bits", samples.bits));
  }
  if (TIFFGetField(tiff_, TIFFTAG_COLORMAP, &maps[0], &maps[1], &maps[2]) != 1) damaged("no colour map");
  const std::size_t count = std::size_t{1} << samples.bits;
  bool upper = true;
  bool lower = true;
  for (std::size_t i = 0; i < 3 * count; ++i) {
    const unsigned value = maps[i % 3][i / 3];
    const unsigned low = value & 0xFFU;
    samples.palette.push_back(static_cast<std::uint16_t>(value));
    upper = upper && (low == 0 || low == 0xFF || low == value >> 8U);
    lower = lower && value < 256;
  }
  if (lower || !upper) return;
  for (std::uint16_t& each : samples.palette) each = static_cast<std::uint16_t>(each >> 8U);
}

void LayoutReader::read_units() {
  layout_.tiled = TIFFIsTiled(tiff_) != 0;
  if (layout_.tiled) {
    layout_.unit_width = tag<std::uint32_t>(tiff_, TIFFTAG_TILEWIDTH, 0);
    layout_.unit_height = tag<std::uint32_t>(tiff_, TIFFTAG_TILELENGTH, 0);
  } else {
    layout_.unit_width = layout_.width;
    layout_.unit_height = std::min(tag<std::uint32_t>(tiff_, TIFFTAG_ROWSPERSTRIP, UINT32_MAX), layout_.height);
  }
  if (layout_.unit_width == 0 || layout_.unit_height == 0) damaged("tiles or strips without pixels");
  if (separate_ && !layout_.by_libtiff) {
    layout_.planes = static_cast<int>(meaning_.colors) + (meaning_.alpha == AlphaState::None ? 0 : 1);
  }
  const std::uint64_t pixel_bits =
      layout_.by_libtiff ? 32 : std::uint64_t{layout_.samples.bits} * layout_.samples.stored;
  layout_.unit_row_bytes = (pixel_bits * layout_.unit_width + 7) / 8;
  if (layout_.by_libtiff) return;
  const std::uint64_t said = layout_.tiled ? TIFFTileRowSize64(tiff_) : TIFFScanlineSize64(tiff_);
  if (said != layout_.unit_row_bytes) {
    refuse(fmt::format("a row of {} bytes, where {} are expected,", said, layout_.unit_row_bytes));
  }
}

void LayoutReader::describe() {
  std::string& words = header_.file.encoding;
  words = layout_.tiled ? fmt::format("tiles {}×{}", layout_.unit_width, layout_.unit_height)
                        : fmt::format("strips of {} rows", layout_.unit_height);
  words += fmt::format(", {}", tiff_compression_name(layout_.compression));
  if (separate_) words += ", planes";
  switch (meaning_.photometric) {
    case PHOTOMETRIC_MINISWHITE: words += ", 0 is white"; break;
    case PHOTOMETRIC_PALETTE: words += ", palette"; break;
    case PHOTOMETRIC_SEPARATED: words += ", CMYK"; break;
    case PHOTOMETRIC_YCBCR: words += ", YCbCr"; break;
    case PHOTOMETRIC_CIELAB: words += ", CIELAB"; break;
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV: words += ", LogLuv"; break;
    default: break;
  }
  if (layout_.samples.kind == TiffSamples::Kind::Float) words += ", float";
  if (layout_.samples.kind == TiffSamples::Kind::Signed) words += ", signed";
}

void read_metadata(TIFF* tiff, DecodedHeader& header) {
  Metadata& metadata = header.file.metadata;
  header.file.orientation = tag<std::uint16_t>(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  if (header.file.orientation < 1 || header.file.orientation > 8) header.file.orientation = 1;
  const auto unit = tag<std::uint16_t>(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
  const float scale = unit == RESUNIT_INCH ? 1.0F / 0.0254F : unit == RESUNIT_CENTIMETER ? 100.0F : 0.0F;
  const float x = tag<float>(tiff, TIFFTAG_XRESOLUTION, 0) * scale;
  const float y = tag<float>(tiff, TIFFTAG_YRESOLUTION, 0) * scale;
  if (x > 0 && y > 0 && x < 1e12F && y < 1e12F) {
    metadata.density_x = x;
    metadata.density_y = y;
  }
  std::uint32_t count = 0;
  const std::uint8_t* bytes = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_XMLPACKET, &count, &bytes) == 1) metadata.xmp.assign(bytes, bytes + count);
  if (TIFFGetField(tiff, TIFFTAG_ICCPROFILE, &count, &bytes) == 1) header.icc.assign(bytes, bytes + count);
  for (const TiffText& each : tiff_texts()) {
    const char* text = nullptr;
    if (TIFFGetField(tiff, each.tag, &text) == 1 && text != nullptr) metadata.text[each.name] = text;
  }
}

}  // namespace

void prepare_tiff(TIFF* tiff) {
  const unsigned compression = tag<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  const unsigned photometric = tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  const unsigned planar = tag<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  if (compression == COMPRESSION_JPEG && photometric == PHOTOMETRIC_YCBCR && planar == PLANARCONFIG_CONTIG) {
    TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  }
  if (photometric == PHOTOMETRIC_LOGL || photometric == PHOTOMETRIC_LOGLUV) {
    TIFFSetField(tiff, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
  }
}

TiffLayout read_tiff_layout(TiffFile& file, const std::string& name, DecodedHeader& header, const Run& run) {
  header.file.format = "tiff";
  prepare_tiff(file.handle());
  read_metadata(file.handle(), header);
  return LayoutReader(file, name, header, run).read();
}

}  // namespace azulejo
