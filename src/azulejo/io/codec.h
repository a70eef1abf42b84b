#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/source.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/input.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// What a codec makes of an opened file. The pixels that it gives are as stored in sense (the file's profile,
/// orientation and transfer); image_io.cpp does to all formats alike what the fields here ask for.
struct DecodedHeader {
  ImageFile file;                 ///< all fields but `profile` and `streamed`; file.info is what `read` gives
  std::vector<std::uint8_t> icc;  ///< embedded profile, empty if none
  float gamma = 0;                ///< PNG's gAMA as file exponent (0.45455 for sRGB-like); 0: sRGB or not said
  bool cmyk = false;              ///< 4 channels C, M, Y, K, 255 = full ink, alpha None: converted to RGB by the caller
};

/// A pass over one file's pixels, from the top. Made by Codec::decode after the header was read.
class Decoder {
 public:
  virtual ~Decoder() = default;
  const DecodedHeader& header() const { return header_; }
  /// Rows that come cheaply together (a row of tiles, a strip).
  virtual int row_group() const { return 1; }
  /// False: `read` is only called once, for all rows (interlaced PNG, progressive JPEG and formats decoded at once).
  virtual bool streams() const { return true; }
  /// Fills `rows` with the next rows; full width, header().file.info's type and channels. Rows come strictly in
  /// order. A truncated or damaged file: Error(Data) with name and place; damage that the format's own rules let
  /// pass is a warning.
  virtual void read(const AnyView& rows) = 0;

 protected:
  DecodedHeader header_;
};

class Encoder {
 public:
  virtual ~Encoder() = default;
  virtual int row_group() const { return 1; }
  virtual void write(const ConstAnyView& rows) = 0;  ///< the next rows, of the info given to Codec::encode
  virtual void finish() = 0;                         ///< the last bytes of the format; the caller commits the Output
};

/// One file format. A codec is a constant; codecs.cpp lists them.
struct Codec {
  const char* name;                       ///< "png"
  std::vector<std::string_view> endings;  ///< "png"; the first is the usual one
  /// Whether a file begins like this format; `head` has up to 64 bytes.
  bool (*matches)(std::span<const std::byte> head, std::string_view name);
  /// Reads the header, checks it against run.limits before anything is allocated from it, and starts a pass.
  std::unique_ptr<Decoder> (*decode)(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);
  /// What the format can hold of `info`: the caller converts the pixels to the answer before `encode` is called.
  /// Null: the format is only read.
  ImageInfo (*storable)(const ImageInfo& info, const WriteOptions& options);
  std::unique_ptr<Encoder> (*encode)(Output& output, const ImageInfo& info, const Metadata& metadata,
                                     const WriteOptions& options, const Run& run);
};

/// All formats, in the order in which their `matches` are asked.
std::span<const Codec* const> codecs();

}  // namespace azulejo
