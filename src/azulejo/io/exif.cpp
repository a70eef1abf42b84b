#include "azulejo/io/exif.h"

#include <cstddef>
#include <optional>

namespace azulejo {
namespace {

constexpr std::uint32_t kXResolution = 0x011A;
constexpr std::uint32_t kYResolution = 0x011B;
constexpr std::uint32_t kOrientation = 0x0112;
constexpr std::uint32_t kResolutionUnit = 0x0128;
constexpr std::uint32_t kShort = 3;
constexpr std::uint32_t kRational = 5;
constexpr std::size_t kEntryBytes = 12;

/// Bounds-checked access to the first directory.
class Directory {
 public:
  explicit Directory(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    if (bytes.size() < 8 || bytes[0] != bytes[1] || (bytes[0] != 'I' && bytes[0] != 'M')) return;
    big_endian_ = bytes[0] == 'M';
    if (number(2, 2) != 42) return;
    offset_ = *number(4, 4);
    entries_ = number(offset_, 2).value_or(0);
  }

  /// Where the entry of `tag` begins, if it is there in the type wanted.
  std::optional<std::size_t> find(std::uint32_t tag, std::uint32_t type) const {
    for (std::size_t i = 0; i < entries_; ++i) {
      const std::size_t at = offset_ + 2 + i * kEntryBytes;
      const auto id = number(at, 2);
      if (!id || !number(at + 8, 4)) return std::nullopt;
      if (*id == tag) return number(at + 2, 2) == type ? std::optional(at) : std::nullopt;
    }
    return std::nullopt;
  }

  /// The unsigned number of `size` bytes at `at`.
  std::optional<std::uint32_t> number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes_[big_endian_ ? at + i : at + size - 1 - i];
    return value;
  }

  /// Where in the block the value of an orientation lies.
  std::optional<std::size_t> orientation_place() const {
    const auto entry = find(kOrientation, kShort);
    return entry ? std::optional(*entry + 8) : std::nullopt;
  }

  float rational(std::uint32_t tag) const {
    const auto entry = find(tag, kRational);
    if (!entry) return 0;
    const std::size_t at = *number(*entry + 8, 4);
    const auto over = number(at, 4);
    const auto under = number(at + 4, 4);
    if (!over || !under || *under == 0) return 0;
    return static_cast<float>(static_cast<double>(*over) / static_cast<double>(*under));
  }

  bool big_endian() const { return big_endian_; }

 private:
  std::span<const std::uint8_t> bytes_;
  bool big_endian_ = false;
  std::size_t offset_ = 0;
  std::size_t entries_ = 0;
};

}  // namespace

ExifSummary parse_exif(std::span<const std::uint8_t> exif) {
  const Directory directory(exif);
  ExifSummary summary;
  if (const auto place = directory.orientation_place()) {
    const std::uint32_t stored = directory.number(*place, 2).value_or(1);
    if (stored >= 1 && stored <= 8) summary.orientation = static_cast<int>(stored);
  }
  const auto unit_entry = directory.find(kResolutionUnit, kShort);
  const std::uint32_t unit = unit_entry ? directory.number(*unit_entry + 8, 2).value_or(2) : 2;
  const float per_metre = unit == 2 ? 1 / 0.0254F : unit == 3 ? 100.0F : 0.0F;
  summary.density_x = directory.rational(kXResolution) * per_metre;
  summary.density_y = directory.rational(kYResolution) * per_metre;
  return summary;
}

void reset_exif_orientation(std::span<std::uint8_t> exif) {
  const Directory directory(exif);
  const auto place = directory.orientation_place();
  if (!place) return;
  exif[*place] = directory.big_endian() ? 0 : 1;
  exif[*place + 1] = directory.big_endian() ? 1 : 0;
}

}  // namespace azulejo
