// The grids of the renderer Mitsuba. Source: its documentation, "Grid-based volume data source".

#include <array>
#include <bit>
#include <cstring>
#include <span>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/volume_grid.h"
#include "azulejo/io/volume_samples.h"

namespace azulejo {
namespace {

constexpr std::size_t kHeader = 48;

bool matches(std::span<const std::byte> head, std::uint64_t, std::string_view) {
  constexpr std::string_view kMagic = "VOL\x03";
  return head.size() >= kHeader && std::memcmp(head.data(), kMagic.data(), kMagic.size()) == 0;
}

SampleType sample_type(int encoding, const std::string& file) {
  if (encoding == 1) return SampleType::F32;
  if (encoding == 3) return SampleType::U8;
  throw Error(Error::Unsupported,
              fmt::format("{}: encoding {}, expected 1 (32-bit floats) or 3 (bytes)", file, encoding));
}

Model read_mitsuba(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  const std::string& name = file.input->name();
  std::array<std::byte, kHeader> head = {};
  if (file.input->read(0, head) != kHeader || !matches(head, kHeader, name)) {
    throw Error(Error::Data, fmt::format("{}: a header of {} bytes expected", name, kHeader));
  }
  const auto whole = [&](std::size_t at) { return load_number<std::int32_t>(head.data() + at, std::endian::little); };
  const auto real = [&](std::size_t at) {
    return static_cast<double>(load_number<float>(head.data() + at, std::endian::little));
  };
  SampleLayout layout{.type = sample_type(whole(4), name), .begin = kHeader};
  if (layout.type == SampleType::U8) layout.slope = 1.0 / 255;  // bytes stand for 0–1
  const std::int32_t channels = whole(20);
  if (channels < 1 || channels > static_cast<std::int32_t>(kMostComponents)) {
    throw Error(Error::Data, fmt::format("{}: {} channels, 1–{} expected", name, channels, kMostComponents));
  }
  layout.components = static_cast<std::uint32_t>(channels);
  if (channels > 1) warn(run, fmt::format("{}: the first of its {} values a sample is read", name, channels));
  Volume volume;
  const std::array<std::int64_t, 3> size = {whole(8), whole(12), whole(16)};
  set_size(volume, size, name, run);
  GridPlacement placement;
  for (std::size_t i = 0; i < 3; ++i) {
    // The outermost samples lie on the faces of the box.
    placement.origin[i] = real(24 + 4 * i);
    const double extent = real(36 + 4 * i) - placement.origin[i];
    placement.axes[i][i] = size[i] > 1 ? extent / static_cast<double>(size[i] - 1) : 1.0;
  }
  set_placement(volume, placement, name, run);
  volume.metres_per_unit = options.metres_per_unit.value_or(0.0F);
  read_samples(*file.input, layout, volume, run);
  return volume;
}

}  // namespace

extern const ModelCodec kMitsubaVolume;
const ModelCodec kMitsubaVolume = {"mitsuba-volume", {"vol"}, matches, read_mitsuba, nullptr, nullptr};

}  // namespace azulejo
