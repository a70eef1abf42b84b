// NIfTI-1 and NIfTI-2, as one file or as header and samples in two.
// Source: nifti1.h and nifti2.h of the NIfTI Data Format Working Group.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/gzip.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/volume_grid.h"
#include "azulejo/io/volume_samples.h"

namespace azulejo {
namespace {

constexpr std::size_t kBytes1 = 348;  ///< of a NIfTI-1 header
constexpr std::size_t kBytes2 = 540;

/// The fields that count, of both versions.
struct Header {
  std::array<std::int64_t, 8> dim = {};
  std::array<double, 8> pixdim = {};
  int datatype = 0;
  std::size_t bytes = kBytes1;
  double offset = 0;  ///< of the first sample; 0: right behind the header
  double slope = 0;
  double intercept = 0;
  int units = 0;
  int qform = 0;
  int sform = 0;
  std::array<double, 3> quaternion = {};
  std::array<double, 3> quaternion_origin = {};
  std::array<std::array<double, 4>, 3> rows = {};  ///< of the affine matrix
  std::string description;
  std::endian order = std::endian::little;
  bool pair = false;  ///< the samples are in another file
};

std::optional<std::endian> order_of(std::span<const std::byte> head, std::size_t bytes) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    if (load_number<std::uint32_t>(head.data(), order) == bytes) return order;
  }
  return std::nullopt;
}

bool has(std::span<const std::byte> head, std::size_t at, std::string_view text) {
  return head.size() >= at + text.size() && std::memcmp(head.data() + at, text.data(), text.size()) == 0;
}

bool is_version_1(std::span<const std::byte> head) {
  constexpr std::size_t kMagic = 344;
  return head.size() >= kBytes1 && order_of(head, kBytes1) && (has(head, kMagic, "n+1") || has(head, kMagic, "ni1"));
}

bool is_version_2(std::span<const std::byte> head) {
  constexpr std::size_t kMagic = 4;
  return head.size() >= 8 && order_of(head, kBytes2) && (has(head, kMagic, "n+2") || has(head, kMagic, "ni2"));
}

/// Takes numbers of a header, which are stored as T, one after another.
class Fields {
 public:
  Fields(std::span<const std::byte> bytes, std::endian order) : bytes_(bytes), order_(order) {}
  template <class T>
  T at(std::size_t offset) const {
    return load_number<T>(bytes_.data() + offset, order_);
  }
  template <class T, class Numbers>
  void fill(Numbers& numbers, std::size_t offset) const {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = static_cast<typename Numbers::value_type>(at<T>(offset + i * sizeof(T)));
    }
  }
  std::string text(std::size_t offset, std::size_t longest) const {
    const auto* const begin = reinterpret_cast<const char*>(bytes_.data() + offset);
    return {begin, std::find(begin, begin + longest, '\0')};
  }

 private:
  std::span<const std::byte> bytes_;
  std::endian order_;
};

Header header_1(std::span<const std::byte> bytes) {
  Header header;
  header.order = *order_of(bytes, kBytes1);
  const Fields fields(bytes, header.order);
  fields.fill<std::int16_t>(header.dim, 40);
  header.datatype = fields.at<std::int16_t>(70);
  fields.fill<float>(header.pixdim, 76);
  header.offset = fields.at<float>(108);
  header.slope = fields.at<float>(112);
  header.intercept = fields.at<float>(116);
  header.units = fields.at<std::uint8_t>(123);
  header.description = fields.text(148, 80);
  header.qform = fields.at<std::int16_t>(252);
  header.sform = fields.at<std::int16_t>(254);
  fields.fill<float>(header.quaternion, 256);
  fields.fill<float>(header.quaternion_origin, 268);
  for (std::size_t i = 0; i < 3; ++i) fields.fill<float>(header.rows[i], 280 + 16 * i);
  header.pair = has(bytes, 344, "ni1");
  return header;
}

Header header_2(std::span<const std::byte> bytes) {
  Header header;
  header.bytes = kBytes2;
  header.order = *order_of(bytes, kBytes2);
  const Fields fields(bytes, header.order);
  header.datatype = fields.at<std::int16_t>(12);
  fields.fill<std::int64_t>(header.dim, 16);
  fields.fill<double>(header.pixdim, 104);
  header.offset = static_cast<double>(fields.at<std::int64_t>(168));
  header.slope = fields.at<double>(176);
  header.intercept = fields.at<double>(184);
  header.description = fields.text(240, 80);
  header.qform = fields.at<std::int32_t>(344);
  header.sform = fields.at<std::int32_t>(348);
  fields.fill<double>(header.quaternion, 352);
  fields.fill<double>(header.quaternion_origin, 376);
  for (std::size_t i = 0; i < 3; ++i) fields.fill<double>(header.rows[i], 400 + 32 * i);
  header.units = fields.at<std::int32_t>(500);
  header.pair = has(bytes, 4, "ni2");
  return header;
}

Header read_header(const Input& input) {
  std::array<std::byte, kBytes2> bytes = {};
  const auto head = std::span<const std::byte>(bytes).first(input.read(0, bytes));
  if (is_version_1(head)) return header_1(head);
  if (is_version_2(head) && head.size() == kBytes2) return header_2(head);
  throw Error(Error::Data,
              fmt::format("{}: a NIfTI header of {} or {} bytes expected", input.name(), kBytes1, kBytes2));
}

SampleType sample_type(const Header& header, const std::string& file) {
  switch (header.datatype) {
    case 2: return SampleType::U8;
    case 4: return SampleType::I16;
    case 8: return SampleType::I32;
    case 16: return SampleType::F32;
    case 64: return SampleType::F64;
    case 256: return SampleType::I8;
    case 512: return SampleType::U16;
    case 768: return SampleType::U32;
    case 1024: return SampleType::I64;
    case 1280: return SampleType::U64;
    case 1:
    case 32:
    case 128:
    case 1536:
    case 1792:
    case 2048:
    case 2304:
      throw Error(Error::Unsupported, fmt::format("{}: samples of data type {} (bits, colors, complex numbers or more "
                                                  "than 64 bits), expected integers or floats",
                                                  file, header.datatype));
    default: break;
  }
  throw Error(Error::Data, fmt::format("{}: data type {}, which NIfTI doesn't know", file, header.datatype));
}

std::array<std::int64_t, 3> size_of(const Header& header, const std::string& file, const Run& run) {
  if (header.dim[0] < 1 || header.dim[0] > 7) {
    throw Error(Error::Data, fmt::format("{}: {} dimensions, 1–7 expected", file, header.dim[0]));
  }
  const auto dimensions = static_cast<std::size_t>(header.dim[0]);
  std::array<std::int64_t, 3> size = {1, 1, 1};
  for (std::size_t i = 0; i < std::min<std::size_t>(dimensions, 3); ++i) size[i] = header.dim[i + 1];
  double volumes = 1;
  for (std::size_t i = 4; i <= dimensions; ++i) volumes *= static_cast<double>(header.dim[i]);
  if (volumes > 1) warn(run, fmt::format("{}: the first of its {:.0f} volumes is read", file, volumes));
  return size;
}

/// The sform where there is one, else the qform, else steps alone (methods 3, 2 and 1 of the standard).
GridPlacement placement_of(const Header& header) {
  GridPlacement placement;
  if (header.sform > 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) placement.axes[j][i] = header.rows[i][j];
      placement.origin[i] = header.rows[i][3];
    }
    return placement;
  }
  for (std::size_t i = 0; i < 3; ++i) placement.axes[i][i] = std::abs(header.pixdim[i + 1]);
  if (header.qform <= 0) return placement;
  const auto [b, c, d] = header.quaternion;
  const double a = std::sqrt(std::max(0.0, 1.0 - (b * b + c * c + d * d)));
  const double rotation[3][3] = {
      {a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
      {2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)},
      {2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c},
  };
  for (std::size_t j = 0; j < 3; ++j) {
    const double step = placement.axes[j][j] * (j == 2 && header.pixdim[0] < 0 ? -1 : 1);
    for (std::size_t i = 0; i < 3; ++i) placement.axes[j][i] = rotation[i][j] * step;
  }
  placement.origin = header.quaternion_origin;
  return placement;
}

float metres_per_unit(int units) {
  switch (units & 7) {
    case 1: return 1.0F;
    case 2: return 1e-3F;
    case 3: return 1e-6F;
    default: return 0;
  }
}

/// The file with the samples of a pair: "brain.img" for "brain.hdr" and "brain.hdr.gz".
std::shared_ptr<const Input> samples_beside(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  std::filesystem::path name = std::filesystem::path(file.input->name()).filename();
  if (name.extension() == ".gz") name.replace_extension();
  const std::string wanted = name.replace_extension(".img").string();
  if (std::shared_ptr<const Input> input = open_beside(file, wanted, options, run)) return input;
  if (const std::shared_ptr<const Input> packed = open_beside(file, wanted + ".gz", options, run)) {
    return unpack_gzip(*packed, run.limits.memory_bytes);
  }
  throw Error(Error::Data, fmt::format("{}: its samples, {}, are not there", file.input->name(), wanted));
}

Model read_nifti(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  const std::string& name = file.input->name();
  const Header header = read_header(*file.input);
  SampleLayout layout;
  layout.type = sample_type(header, name);
  layout.order = header.order;
  if (!(header.offset >= 0 && header.offset < 0x1p62)) {
    throw Error(Error::Data, fmt::format("{}: samples begin at byte {}, 0 or more expected", name, header.offset));
  }
  layout.begin = static_cast<std::uint64_t>(header.offset);
  if (layout.begin == 0 && !header.pair) layout.begin = header.bytes + 4;  // four bytes say whether extensions follow
  // A slope of 0 means: as stored.
  if (std::isfinite(header.slope) && header.slope != 0 && std::isfinite(header.intercept)) {
    layout.slope = header.slope;
    layout.intercept = header.intercept;
  }
  Volume volume;
  volume.name = header.description;
  set_size(volume, size_of(header, name, run), name, run);
  set_placement(volume, placement_of(header), name, run);
  volume.metres_per_unit = options.metres_per_unit.value_or(metres_per_unit(header.units));
  const std::shared_ptr<const Input> samples = header.pair ? samples_beside(file, options, run) : file.input;
  read_samples(*samples, layout, volume, run);
  return volume;
}

bool matches(std::span<const std::byte> head, std::uint64_t, std::string_view) {
  return is_version_1(head) || is_version_2(head);
}

}  // namespace

extern const ModelCodec kNifti;
const ModelCodec kNifti = {"nifti", {"nii"}, matches, read_nifti, nullptr, nullptr};

}  // namespace azulejo
