#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/png.h"
#include "azulejo/io/png_chunks.h"

namespace azulejo {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kBlockBytes = std::size_t{1} << 18;  ///< of rows deflated together
constexpr std::size_t kBlocks = 16;                        ///< deflated at the same time at most
constexpr std::size_t kLongestRow = std::size_t{1} << 30;  ///< zlib counts bytes in 32 bits
constexpr std::size_t kWindow = std::size_t{1} << 15;      ///< how far deflate looks back

void put_number(Bytes& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void put_text(Bytes& bytes, std::string_view text) { bytes.insert(bytes.end(), text.begin(), text.end()); }

// ---- filters: PNG 1.2, chapter 6 ----

enum Filter : std::uint8_t { None, Sub, Up, Average, Paeth };

std::uint8_t paeth(int left, int above, int corner) {
  const int across = std::abs(above - corner);
  const int down = std::abs(left - corner);
  const int both = std::abs(left + above - 2 * corner);
  return static_cast<std::uint8_t>(across <= down && across <= both ? left : down <= both ? above : corner);
}

/// Writes the row as differences to what the filter predicts. `above` is the row before, zeros for the first.
void filter_row(Filter filter, std::span<const std::uint8_t> row, const std::uint8_t* above, std::size_t pixel,
                std::uint8_t* result) {
  const auto predict = [&](std::size_t from, std::size_t to, auto prediction) {
    for (std::size_t i = from; i < to; ++i) result[i] = static_cast<std::uint8_t>(row[i] - prediction(i));
  };
  const std::size_t size = row.size();
  switch (filter) {
    case None: std::copy(row.begin(), row.end(), result); break;
    case Sub:
      std::copy_n(row.begin(), pixel, result);
      predict(pixel, size, [&](std::size_t i) { return row[i - pixel]; });
      break;
    case Up: predict(0, size, [&](std::size_t i) { return above[i]; }); break;
    case Average:
      predict(0, pixel, [&](std::size_t i) { return above[i] / 2; });
      predict(pixel, size, [&](std::size_t i) { return (row[i - pixel] + above[i]) / 2; });
      break;
    case Paeth:
      predict(0, pixel, [&](std::size_t i) { return above[i]; });
      predict(pixel, size, [&](std::size_t i) { return paeth(row[i - pixel], above[i], above[i - pixel]); });
      break;
  }
}

/// Sub and up alone give photographs fewer bytes than the choice among all five, in less time (measured on the
/// Kodak set); at the slow levels flat pictures gain from all.
std::span<const Filter> filters_for(int level) {
  static constexpr Filter kStored[] = {None};
  static constexpr Filter kFast[] = {Sub, Up};
  static constexpr Filter kAll[] = {None, Sub, Up, Average, Paeth};
  if (level == 0) return kStored;
  return level < 7 ? std::span<const Filter>(kFast) : std::span<const Filter>(kAll);
}

/// How far the differences are from 0, taken as signed: what deflates best is usually the smallest.
std::uint64_t weight(std::span<const std::uint8_t> differences) {
  std::uint64_t sum = 0;
  for (const std::uint8_t each : differences) sum += each < 128 ? each : 256U - each;
  return sum;
}

// ---- deflate ----

struct Deflated {
  Bytes bytes;
  std::uint32_t sum = 1;  ///< Adler-32 of what was packed
};

/// Packs `bytes` to whole bytes, so that blocks can follow each other. `before` ends where they begin.
Deflated deflated(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> before, int level, bool last) {
  z_stream stream = {};
  if (deflateInit2(&stream, level, Z_DEFLATED, -MAX_WBITS, 9, level == 0 ? Z_DEFAULT_STRATEGY : Z_FILTERED) != Z_OK) {
    throw Error(Error::Resource, "no memory to deflate");
  }
  if (!before.empty()) deflateSetDictionary(&stream, before.data(), static_cast<uInt>(before.size()));
  Deflated result;
  result.bytes.resize(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 16);
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = result.bytes.data();
  stream.avail_out = static_cast<uInt>(result.bytes.size());
  deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
  result.bytes.resize(result.bytes.size() - stream.avail_out);
  deflateEnd(&stream);
  result.sum = static_cast<std::uint32_t>(adler32(1, bytes.data(), static_cast<uInt>(bytes.size())));
  return result;
}

// ---- the file ----

class PngEncoder final : public Encoder {
 public:
  PngEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions& options,
             const Run& run);
  void write(const ConstAnyView& rows) override;
  void finish() override;

 private:
  void chunk(const char* type, std::span<const std::uint8_t> body);
  void write_metadata(const Metadata& metadata);
  void write_text(std::string_view key, std::string_view value);
  std::size_t filtered_row_bytes() const { return row_bytes_ + 1; }
  void filter_block(std::size_t block);
  void pack(bool last);

  Run run_;
  Output& output_;
  int level_;
  std::size_t row_bytes_;
  std::size_t pixel_bytes_;
  bool swap_;  ///< 16 bits: the high byte comes first
  std::size_t rows_in_block_;
  Bytes rows_;              ///< the row before the batch, then the batch's
  std::size_t count_ = 0;   ///< rows in the batch
  Bytes filtered_;          ///< the last of what was packed before, then the batch's filtered rows
  std::size_t window_ = 0;  ///< bytes of filtered_ that were packed before
  std::uint32_t sum_ = 1;   ///< Adler-32 of all that was packed
};

PngEncoder::PngEncoder(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions& options,
                       const Run& run)
    : run_(run),
      output_(output),
      level_(std::clamp(options.compression_level, 0, 9)),
      row_bytes_(info.row_bytes()),
      pixel_bytes_(info.pixel_bytes()),
      swap_(info.type == PixelType::U16 && std::endian::native == std::endian::little),
      rows_in_block_(std::max<std::size_t>(1, kBlockBytes / filtered_row_bytes())),
      rows_(row_bytes_, 0) {
  constexpr std::uint8_t kColorTypes[] = {0, 0, 4, 2, 6};  // by channels
  if (row_bytes_ > kLongestRow) {
    throw Error(Error::Unsupported,
                fmt::format("{}: rows of {} bytes; PNG gets at most {}", output.name(), row_bytes_, kLongestRow));
  }
  output_.write(std::as_bytes(std::span(kPngSignature)));
  Bytes header;
  put_number(header, static_cast<std::uint32_t>(info.width));
  put_number(header, static_cast<std::uint32_t>(info.height));
  header.push_back(info.type == PixelType::U16 ? 16 : 8);
  header.push_back(kColorTypes[info.channels]);
  header.insert(header.end(), {0, 0, 0});  // deflate, adaptive filters, not interlaced
  chunk("IHDR", header);
  if (info.color == ColorState::Srgb) chunk("sRGB", Bytes{0});
  write_metadata(metadata);
  constexpr std::uint8_t kZlib[] = {0x78, 0x5E};  // a window of 32 KiB; 0x785E is a multiple of 31
  chunk("IDAT", kZlib);
}

void PngEncoder::chunk(const char* type, std::span<const std::uint8_t> body) {
  Bytes ends;
  put_number(ends, static_cast<std::uint32_t>(body.size()));
  put_text(ends, std::string_view(type, 4));
  output_.write(std::as_bytes(std::span(ends)));
  output_.write(std::as_bytes(body));
  auto sum = crc32(0, ends.data() + 4, 4);
  if (!body.empty()) sum = crc32(sum, body.data(), static_cast<uInt>(body.size()));
  ends.clear();
  put_number(ends, static_cast<std::uint32_t>(sum));
  output_.write(std::as_bytes(std::span(ends)));
}

/// Whether PNG takes `key` as the name of a text; of Latin-1 only what is ASCII is used.
bool is_keyword(const std::string& key) {
  constexpr std::size_t kLongest = 79;
  return !key.empty() && key.size() <= kLongest && key.front() != ' ' && key.back() != ' ' &&
         std::all_of(key.begin(), key.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

void PngEncoder::write_metadata(const Metadata& metadata) {
  if (metadata.density_x > 0 && metadata.density_y > 0) {
    Bytes density;
    put_number(density, static_cast<std::uint32_t>(std::lround(metadata.density_x)));
    put_number(density, static_cast<std::uint32_t>(std::lround(metadata.density_y)));
    density.push_back(1);  // a metre
    chunk("pHYs", density);
  }
  if (!metadata.exif.empty()) chunk("eXIf", metadata.exif);
  if (!metadata.xmp.empty()) {
    write_text(kXmpKeyword, {reinterpret_cast<const char*>(metadata.xmp.data()), metadata.xmp.size()});
  }
  for (const auto& [key, value] : metadata.text) {
    if (is_keyword(key)) write_text(key, std::string_view(value).substr(0, value.find('\0')));
  }
}

void PngEncoder::write_text(std::string_view key, std::string_view value) {
  Bytes body;
  put_text(body, key);
  body.insert(body.end(), {0, 0, 0, 0, 0});  // not compressed, no method, no language, no translated keyword
  put_text(body, value);
  chunk("iTXt", body);
}

void PngEncoder::write(const ConstAnyView& rows) {
  for (int y = 0; y < rows.height(); ++y) {
    if (count_ == rows_in_block_ * kBlocks) pack(false);
    const std::size_t at = rows_.size();
    rows_.resize(at + row_bytes_);
    std::memcpy(rows_.data() + at, rows.row(y), row_bytes_);
    if (swap_) {
      for (std::size_t i = at; i < rows_.size(); i += 2) std::swap(rows_[i], rows_[i + 1]);
    }
    ++count_;
  }
}

void PngEncoder::filter_block(std::size_t block) {
  const std::size_t begin = block * rows_in_block_;
  const std::size_t end = std::min(begin + rows_in_block_, count_);
  const auto filters = filters_for(level_);
  Bytes trial(row_bytes_);
  for (std::size_t y = begin; y < end; ++y) {
    const std::uint8_t* const above = rows_.data() + y * row_bytes_;
    const std::span<const std::uint8_t> row(above + row_bytes_, row_bytes_);
    std::uint8_t* const result = filtered_.data() + window_ + y * filtered_row_bytes();
    std::uint64_t best = ~std::uint64_t{0};
    for (const Filter filter : filters) {
      filter_row(filter, row, above, pixel_bytes_, trial.data());
      const std::uint64_t each = filters.size() > 1 ? weight(trial) : 0;
      if (each >= best) continue;
      best = each;
      result[0] = filter;
      std::copy(trial.begin(), trial.end(), result + 1);
    }
  }
}

/// Filters and deflates the batch. What a block may refer to is the filtered bytes before it, whoever packs them.
void PngEncoder::pack(bool last) {
  const std::size_t blocks = (count_ + rows_in_block_ - 1) / rows_in_block_;
  filtered_.resize(window_ + count_ * filtered_row_bytes());
  parallel_tasks(blocks, run_, [&](std::size_t block, int) { filter_block(block); });
  std::vector<Deflated> packed(blocks);
  const std::span<const std::uint8_t> all(filtered_);
  const std::size_t block_bytes = rows_in_block_ * filtered_row_bytes();
  const auto begin_of = [&](std::size_t block) { return std::min(window_ + block * block_bytes, all.size()); };
  parallel_tasks(blocks, run_, [&](std::size_t block, int) {
    const std::size_t begin = begin_of(block);
    const std::size_t before = std::min(begin, kWindow);
    packed[block] = deflated(all.subspan(begin, begin_of(block + 1) - begin), all.subspan(begin - before, before),
                             level_, last && block + 1 == blocks);
  });
  for (std::size_t block = 0; block < blocks; ++block) {
    const auto size = static_cast<z_off_t>(begin_of(block + 1) - begin_of(block));
    sum_ = static_cast<std::uint32_t>(adler32_combine(sum_, packed[block].sum, size));
    if (last && block + 1 == blocks) put_number(packed[block].bytes, sum_);
    chunk("IDAT", packed[block].bytes);
  }
  const std::size_t kept = std::min(filtered_.size(), kWindow);
  filtered_.erase(filtered_.begin(), filtered_.end() - static_cast<std::ptrdiff_t>(kept));
  window_ = kept;
  rows_.erase(rows_.begin(), rows_.end() - static_cast<std::ptrdiff_t>(row_bytes_));
  count_ = 0;
}

void PngEncoder::finish() {
  pack(true);
  chunk("IEND", {});
}

}  // namespace

std::unique_ptr<Encoder> encode_png(Output& output, const ImageInfo& info, const Metadata& metadata,
                                    const WriteOptions& options, const Run& run) {
  return std::make_unique<PngEncoder>(output, info, metadata, options, run);
}

}  // namespace azulejo
