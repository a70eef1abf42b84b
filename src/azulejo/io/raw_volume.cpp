// Samples without a header, and files that say what they are and aren't read.

#include <bit>
#include <cstring>
#include <span>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/volume_grid.h"
#include "azulejo/io/volume_samples.h"

namespace azulejo {
namespace {

Model read_raw(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  const std::string& name = file.input->name();
  if (!options.raw) {
    throw Error(Error::Argument,
                fmt::format("{}: samples without a header, expected their size and type (--raw 64x64x93:i16)", name));
  }
  const RawVolume& raw = *options.raw;
  if (raw.width < 1 || raw.height < 1 || raw.depth < 1 || raw.skip_bytes < 0) {
    throw Error(Error::Argument, fmt::format("{}: raw: {}x{}x{} from byte {}, expected sizes of 1 or more", name,
                                             raw.width, raw.height, raw.depth, raw.skip_bytes));
  }
  Volume volume;
  set_size(volume, {raw.width, raw.height, raw.depth}, name, run);
  volume.spacing = raw.spacing;
  volume.metres_per_unit = options.metres_per_unit.value_or(0.0F);
  const SampleLayout layout{.type = raw.type,
                            .order = raw.big_endian ? std::endian::big : std::endian::little,
                            .begin = static_cast<std::uint64_t>(raw.skip_bytes)};
  read_samples(*file.input, layout, volume, run);
  const std::uint64_t rest = file.input->size() - layout.begin - stored_bytes(volume, layout);
  if (rest > 0) {
    warn(run, fmt::format("{}: {} bytes behind the {}x{}x{} samples ({}) are left over", name, rest, raw.width,
                          raw.height, raw.depth, to_string(raw.type)));
  }
  return volume;
}

/// A known ending is all that such files have.
bool matches_raw(std::span<const std::byte>, std::uint64_t, std::string_view name) { return name.ends_with(".raw"); }

bool begins(std::span<const std::byte> head, std::string_view with) {
  return head.size() >= with.size() && std::memcmp(head.data(), with.data(), with.size()) == 0;
}

bool matches_numpy(std::span<const std::byte> head, std::uint64_t, std::string_view name) {
  return begins(head, "\x93NUMPY") || (begins(head, "PK\x03\x04") && name.ends_with(".npz"));
}

Model refuse_numpy(const ModelFile& file, const ModelReadOptions&, const Run&) {
  throw Error(Error::Unsupported,
              fmt::format("{}: NumPy's files are not read; array.tofile(\"x.raw\") writes what --raw takes",
                          file.input->name()));
}

}  // namespace

extern const ModelCodec kRaw;
extern const ModelCodec kNumpy;
const ModelCodec kRaw = {"raw", {"raw"}, matches_raw, read_raw, nullptr, nullptr};
const ModelCodec kNumpy = {"numpy", {"npz", "npy"}, matches_numpy, refuse_numpy, nullptr, nullptr};

}  // namespace azulejo
