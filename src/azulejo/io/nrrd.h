#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/io/input.h"
#include "azulejo/io/model_io.h"

namespace azulejo {

enum class NrrdEncoding : std::uint8_t { Raw, Text, Hex, Gzip };

/// What a NRRD header says, as far as it counts here. Lists may be empty; else they have an element for each axis.
struct NrrdHeader {
  SampleType type = SampleType::U8;
  NrrdEncoding encoding = NrrdEncoding::Raw;
  std::endian order = std::endian::little;
  std::vector<std::int64_t> sizes;
  std::vector<std::string> kinds;
  std::vector<std::string> units;
  std::vector<double> spacings;
  std::vector<double> mins;                                      ///< of the axes
  std::vector<std::optional<std::array<double, 3>>> directions;  ///< none: the axis is not one of space
  std::array<double, 3> origin = {0, 0, 0};
  std::vector<std::string> space_units;  ///< an element for each axis of space
  std::string content;
  std::string data_file;  ///< empty: the samples follow the header
  std::int64_t line_skip = 0;
  std::int64_t byte_skip = 0;    ///< −1: the samples are the last bytes
  std::uint64_t data_begin = 0;  ///< behind the header
};

/// Throws Error(Data | Unsupported) naming file and line.
NrrdHeader read_nrrd_header(const std::shared_ptr<const Input>& input);

}  // namespace azulejo
