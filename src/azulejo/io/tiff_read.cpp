#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/data/pool.h"
#include "azulejo/io/decoded_size.h"
#include "azulejo/io/tiff.h"
#include "azulejo/io/tiff_layout.h"

namespace azulejo {
namespace {

/// Compressed strips above this are unpacked row by row, on one thread.
constexpr std::uint64_t kMaxStripBytes = std::uint64_t{32} << 20;
/// Less than this is read on one thread: each further one has to read the directory for itself.
constexpr std::uint64_t kParallelBytes = std::uint64_t{1} << 18;
/// Strips that are asked for together, so that several threads have work.
constexpr std::uint32_t kStripsTogether = 4;

constexpr std::size_t kMaxWarnings = 16;

/// Grows to what is needed; contents are undefined.
std::uint8_t* room(Buffer& buffer, std::uint64_t bytes) {
  if (buffer.size() < bytes) {
    buffer = Buffer();
    buffer = Buffer(static_cast<std::size_t>(bytes));
  }
  return reinterpret_cast<std::uint8_t*>(buffer.data());
}

class TiffDecoder final : public Decoder {
 public:
  TiffDecoder(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);
  int row_group() const override;
  void read(const AnyView& rows) override;

 private:
  /// What a thread needs for itself.
  struct Worker {
    std::unique_ptr<TiffFile> file;
    std::optional<TiffRows> rows;
    Buffer packed;
  };
  Worker& worker(std::size_t index);
  void read_units(const AnyView& rows);
  void read_groups(std::uint32_t y, const AnyView& rows);
  void decode_unit(Worker& worker, std::uint32_t x, std::uint32_t y, const AnyView& rows);
  void decode_plane(Worker& worker, std::uint32_t x, std::uint32_t y, int plane, const AnyView& part);
  void decode_by_libtiff(Worker& worker, std::uint32_t x, std::uint32_t y, const AnyView& part);
  void read_scanlines(const AnyView& rows);
  void check_place(Worker& worker, std::uint32_t unit) const;
  std::string place(Worker& worker, std::uint32_t unit) const;
  void report_warnings();
  const std::string& name() const { return input_->name(); }
  std::uint64_t unit_bytes() const { return layout_.unit_row_bytes * layout_.unit_height; }

  std::shared_ptr<const Input> input_;
  Run run_;
  Run serial_;  ///< the same on one thread
  std::uint64_t directory_ = 0;
  TiffLayout layout_;
  bool by_scanlines_ = false;
  std::vector<Worker> workers_;
  std::uint32_t next_ = 0;  ///< the row that comes next
  Buffer band_;             ///< a row group that was asked for in parts
  std::uint32_t band_y_ = 0;
  std::uint32_t band_rows_ = 0;  ///< 0: none is held
  bool said_inexact_ = false;
  std::set<std::string> said_;  ///< libtiff's warnings that were passed on
};

TiffDecoder::TiffDecoder(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run)
    : input_(std::move(input)), run_(run), serial_(run) {
  serial_.threads = 1;
  const std::vector<std::uint64_t> pages = tiff_pages(*input_);
  if (pages.empty()) throw Error(Error::Data, fmt::format("{}: header: the first directory is missing", name()));
  if (options.page < 0 || static_cast<std::size_t>(options.page) >= pages.size()) {
    throw Error(Error::Argument,
                fmt::format("{}: page {}: the file has pages 0 to {}", name(), options.page, pages.size() - 1));
  }
  directory_ = pages[static_cast<std::size_t>(options.page)];
  header_.file.pages = static_cast<int>(pages.size());
  workers_.resize(static_cast<std::size_t>(std::max(thread_count(run_), 1)));
  workers_[0].file = std::make_unique<TiffFile>(input_, directory_, run_.limits);
  layout_ = read_tiff_layout(*workers_[0].file, name(), header_, run_);
  by_scanlines_ =
      !layout_.tiled && !layout_.by_libtiff && layout_.compression != COMPRESSION_NONE && unit_bytes() > kMaxStripBytes;
  const std::uint64_t memory = by_scanlines_ ? layout_.unit_row_bytes : unit_bytes();
  check_decoder_memory(name(), layout_.tiled ? "a tile" : "a strip", memory, run_);
  report_warnings();
}

int TiffDecoder::row_group() const {
  if (by_scanlines_) return 1;
  const std::uint64_t together =
      layout_.tiled
          ? 1
          : std::clamp<std::uint64_t>(kMaxStripBytes / std::max<std::uint64_t>(unit_bytes(), 1), 1, kStripsTogether);
  return static_cast<int>(std::min<std::uint64_t>(together * layout_.unit_height, layout_.height));
}

TiffDecoder::Worker& TiffDecoder::worker(std::size_t index) {
  Worker& worker = workers_[index];
  if (!worker.file) {
    worker.file = std::make_unique<TiffFile>(input_, directory_, run_.limits);
    prepare_tiff(worker.file->handle());
    worker.file->take_warnings();  // the first handle gave the same
  }
  if (!worker.rows) worker.rows.emplace(layout_.samples, header_.file.info);
  return worker;
}

void TiffDecoder::read(const AnyView& rows) {
  if (by_scanlines_) {
    read_scanlines(rows);
  } else {
    read_units(rows);
  }
  next_ += static_cast<std::uint32_t>(rows.height());
  report_warnings();
}

/// Whole row groups go straight into `rows`; others into a band that is kept until it is used up.
void TiffDecoder::read_units(const AnyView& rows) {
  const auto count = static_cast<std::uint32_t>(rows.height());
  const auto piece = [&](std::uint32_t from, std::uint32_t height) {
    return rows.crop({0, static_cast<int>(from), rows.width(), static_cast<int>(height)});
  };
  for (std::uint32_t done = 0; done < count;) {
    const std::uint32_t y = next_ + done;
    const std::uint32_t inside = y % layout_.unit_height;
    const std::uint32_t end = next_ + count;
    const std::uint32_t whole_end = end == layout_.height ? end : end - end % layout_.unit_height;
    if (inside == 0 && whole_end > y) {
      read_groups(y, piece(done, whole_end - y));
      done += whole_end - y;
      continue;
    }
    const std::uint32_t group = y - inside;
    ImageInfo info = header_.file.info;
    info.height = static_cast<int>(std::min(layout_.unit_height, layout_.height - group));
    const AnyView band(reinterpret_cast<std::byte*>(room(band_, info.row_bytes() * layout_.unit_height)),
                       static_cast<std::ptrdiff_t>(info.row_bytes()), info);
    if (band_rows_ == 0 || band_y_ != group) {
      band_rows_ = 0;
      read_groups(group, band);
      band_y_ = group;
      band_rows_ = static_cast<std::uint32_t>(info.height);
    }
    const std::uint32_t height = std::min(band_rows_ - inside, count - done);
    copy_pixels(band.crop({0, static_cast<int>(inside), rows.width(), static_cast<int>(height)}), piece(done, height));
    done += height;
  }
}

void TiffDecoder::read_groups(std::uint32_t y, const AnyView& rows) {
  const std::uint32_t across = layout_.across();
  const std::size_t groups = (static_cast<std::size_t>(rows.height()) - 1) / layout_.unit_height + 1;
  const std::size_t units = groups * across;
  parallel_tasks(units, units * unit_bytes() < kParallelBytes ? serial_ : run_, [&](std::size_t task, int index) {
    const auto group = static_cast<std::uint32_t>(task / across);
    const auto column = static_cast<std::uint32_t>(task % across);
    const std::uint32_t top = group * layout_.unit_height;
    const std::uint32_t left = column * layout_.unit_width;
    const Rect part{static_cast<int>(left), static_cast<int>(top),
                    static_cast<int>(std::min(layout_.unit_width, layout_.width - left)),
                    std::min(static_cast<int>(layout_.unit_height), rows.height() - static_cast<int>(top))};
    decode_unit(worker(static_cast<std::size_t>(index)), left, y + top, rows.crop(part));
  });
}

void TiffDecoder::decode_unit(Worker& worker, std::uint32_t x, std::uint32_t y, const AnyView& part) {
  if (layout_.by_libtiff) return decode_by_libtiff(worker, x, y, part);
  for (int plane = 0; plane < layout_.planes; ++plane) decode_plane(worker, x, y, plane, part);
}

void TiffDecoder::decode_plane(Worker& worker, std::uint32_t x, std::uint32_t y, int plane, const AnyView& part) {
  TIFF* tiff = worker.file->handle();
  const auto sample = static_cast<std::uint16_t>(plane);
  const std::uint32_t unit = layout_.tiled ? TIFFComputeTile(tiff, x, y, 0, sample) : TIFFComputeStrip(tiff, y, sample);
  check_place(worker, unit);
  const auto bytes = static_cast<tmsize_t>(layout_.unit_row_bytes * layout_.unit_rows(y));
  std::uint8_t* packed = room(worker.packed, unit_bytes());
  const tmsize_t got =
      layout_.tiled ? TIFFReadEncodedTile(tiff, unit, packed, bytes) : TIFFReadEncodedStrip(tiff, unit, packed, bytes);
  if (got != bytes) worker.file->fail(Error::Data, place(worker, unit));
  const int count = layout_.planes > 1 ? 1 : header_.file.info.channels;
  for (int row = 0; row < part.height(); ++row) {
    worker.rows->convert(packed + static_cast<std::uint64_t>(row) * layout_.unit_row_bytes,
                         static_cast<std::size_t>(part.width()), plane, count, part.row(row));
  }
}

void TiffDecoder::decode_by_libtiff(Worker& worker, std::uint32_t x, std::uint32_t y, const AnyView& part) {
  TIFF* tiff = worker.file->handle();
  auto* raster = reinterpret_cast<std::uint32_t*>(room(worker.packed, unit_bytes()));
  // The caller turns the image.
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  const int read =
      layout_.tiled ? TIFFReadRGBATileExt(tiff, x, y, raster, 1) : TIFFReadRGBAStripExt(tiff, y, raster, 1);
  if (read == 0) worker.file->fail(Error::Data, fmt::format("row {}", y));
  const std::uint32_t rows = layout_.unit_rows(y);
  for (int row = 0; row < part.height(); ++row) {
    // libtiff's rasters begin with the lowest row.
    const std::uint32_t* from =
        raster + static_cast<std::size_t>(rows - 1 - static_cast<std::uint32_t>(row)) * layout_.unit_width;
    auto* to = reinterpret_cast<std::uint8_t*>(part.row(row));
    for (int i = 0; i < part.width(); ++i) {
      to[3 * i] = static_cast<std::uint8_t>(TIFFGetR(from[i]));
      to[3 * i + 1] = static_cast<std::uint8_t>(TIFFGetG(from[i]));
      to[3 * i + 2] = static_cast<std::uint8_t>(TIFFGetB(from[i]));
    }
  }
}

/// Each plane has a handle of its own, which goes from strip to strip as the rows do.
void TiffDecoder::read_scanlines(const AnyView& rows) {
  const auto planes = static_cast<std::size_t>(layout_.planes);
  if (workers_.size() < planes) workers_.resize(planes);
  const int count = layout_.planes > 1 ? 1 : header_.file.info.channels;
  parallel_tasks(planes, run_, [&](std::size_t plane, int) {
    Worker& own = worker(plane);
    TIFF* tiff = own.file->handle();
    std::uint8_t* packed = room(own.packed, layout_.unit_row_bytes);
    for (int row = 0; row < rows.height(); ++row) {
      const std::uint32_t y = next_ + static_cast<std::uint32_t>(row);
      const std::uint32_t strip = TIFFComputeStrip(tiff, y, static_cast<std::uint16_t>(plane));
      if (y % layout_.unit_height == 0) check_place(own, strip);
      if (TIFFReadScanline(tiff, packed, y, static_cast<std::uint16_t>(plane)) != 1) {
        own.file->fail(Error::Data, fmt::format("row {}, {}", y, place(own, strip)));
      }
      own.rows->convert(packed, static_cast<std::size_t>(rows.width()), static_cast<int>(plane), count, rows.row(row));
    }
  });
}

void TiffDecoder::check_place(Worker& worker, std::uint32_t unit) const {
  TIFF* tiff = worker.file->handle();
  const std::uint64_t offset = TIFFGetStrileOffset(tiff, unit);
  const std::uint64_t bytes = TIFFGetStrileByteCount(tiff, unit);
  if (bytes == 0 || offset > input_->size() || bytes > input_->size() - offset) {
    throw Error(Error::Data,
                fmt::format("{}: {}: {} bytes in a file of {}", name(), place(worker, unit), bytes, input_->size()));
  }
  check_decoder_memory(name(), layout_.tiled ? "a compressed tile" : "a compressed strip", bytes, run_);
}

std::string TiffDecoder::place(Worker& worker, std::uint32_t unit) const {
  return fmt::format("byte {}: {} {}", TIFFGetStrileOffset(worker.file->handle(), unit),
                     layout_.tiled ? "tile" : "strip", unit);
}

/// Passes on what the handles of all threads have gathered, each message once a pass.
void TiffDecoder::report_warnings() {
  std::set<std::string> fresh;
  bool inexact = false;
  for (Worker& each : workers_) {
    if (each.file) {
      for (std::string& message : each.file->take_warnings()) fresh.insert(std::move(message));
    }
    inexact = inexact || (each.rows && each.rows->inexact());
  }
  for (const std::string& message : fresh) {
    if (said_.size() > kMaxWarnings || !said_.insert(message).second) continue;
    const bool last = said_.size() > kMaxWarnings;
    warn(run_, fmt::format("{}: {}", name(), last ? "more warnings of this kind" : message));
  }
  if (inexact && !std::exchange(said_inexact_, true)) {
    warn(run_, fmt::format("{}: values of {} bits were rounded to f32", name(), header_.file.bits));
  }
}

}  // namespace

std::unique_ptr<Decoder> decode_tiff(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run) {
  return std::make_unique<TiffDecoder>(std::move(input), options, run);
}

}  // namespace azulejo
