#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/io/model_codec.h"

namespace azulejo {

/// What the opacity of an image's pixels is.
enum class Opacity : std::uint8_t { Opaque, Masked, Blended };  ///< Masked: all of 0 or 255

Opacity opacity_of(const Image& image);

/// Opens a file that a model names, or one of the same name beside the model: paths of another machine are common.
/// Null where there is none, or where it lies outside and may not: `refused` says so then.
/// Throws Error(Resource), Error(Cancelled).
std::shared_ptr<const Input> open_near(const ModelFile& file, const std::string& name, const ModelReadOptions& options,
                                       const Run& run, std::string& refused);

/// The images that a model's materials name, each read once.
class MtlImages {
 public:
  MtlImages(const ModelFile& file, const ModelReadOptions& options, const Run& run)
      : file_(file), options_(options), run_(run) {}

  /// 8 bits a channel. Null, and a warning at the first time, if there is no such file or it can't be read; null if
  /// options.textures is false. A file that isn't where its name says is looked for beside the model.
  /// Throws Error(Resource) where all images together pass run.limits.memory_bytes, Error(Cancelled).
  std::shared_ptr<const Image> read(const std::string& name);

  /// The colours of one image with the opacity of another: its fourth channel, else its gray. Without colours: white.
  /// Null, and a warning, if the sizes differ.
  std::shared_ptr<const Image> with_opacity(const std::string& color, const std::string& opacity);

 private:
  std::shared_ptr<const Image> decoded(const Input& input);
  std::shared_ptr<const Image> combined(const std::string& color, const std::string& opacity);
  void count(const Image& image);

  const ModelFile& file_;
  const ModelReadOptions& options_;
  const Run& run_;
  std::map<std::string, std::shared_ptr<const Image>> images_;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const Image>> combined_;
  std::int64_t bytes_ = 0;
};

}  // namespace azulejo
