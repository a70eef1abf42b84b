#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/mesh.h"
#include "azulejo/data/scene.h"
#include "azulejo/data/volume.h"

namespace azulejo {

class Input;

/// What a model file holds: STL, PLY, OFF a Mesh; OBJ, glTF a Scene; NIfTI, NRRD and raw samples a Volume; SVG a
/// Drawing.
using Model = std::variant<Mesh, Scene, Volume, Drawing>;

enum class SampleType : std::uint8_t { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };

/// How to read samples without a header.
struct RawVolume {
  int width = 0;
  int height = 0;
  int depth = 0;
  SampleType type = SampleType::U8;
  bool big_endian = false;
  std::int64_t skip_bytes = 0;  ///< before the first sample
  glm::vec3 spacing{1, 1, 1};
};

struct ModelReadOptions {
  bool weld = true;                           ///< STL: vertices at exactly equal positions become one (-0 = 0)
  bool outside = false;                       ///< files that the model names may lie outside its folder
  bool textures = true;                       ///< images are read; false: only their names
  std::optional<UpAxis> up = {};              ///< instead of the format's own (STL z, others y)
  std::optional<float> metres_per_unit = {};  ///< instead of the format's own
  std::optional<RawVolume> raw = {};          ///< the file has samples and no header
};

struct ModelWriteOptions {
  bool ascii = false;     ///< STL and PLY as text
  bool svg_text = false;  ///< SVG: texts as text, whose look depends on the reader's fonts; false: as outlines
};

/// Recognized by its bytes where the format has a signature, by its ending where not (raw; of OBJ by what its first line
/// that counts says, if it comes without an ending). Gzip is undone.
/// "-" is standard input; files beside it can't be named then.
/// Throws Error(Io | Data | Unsupported | Resource) naming the file and the byte or line.
AZULEJO_EXPORT Model read_model(const std::string& path, const ModelReadOptions& options = {}, const Run& run = {});
/// The same of what is open already (see input.h).
AZULEJO_EXPORT Model read_model(std::shared_ptr<const Input> input, const ModelReadOptions& options = {},
                                const Run& run = {});
/// The same from bytes; `name` stands in messages and tells the format where bytes don't. Names no other files.
AZULEJO_EXPORT Model read_model(std::span<const std::byte> bytes, const std::string& name,
                                const ModelReadOptions& options = {}, const Run& run = {});

/// The name of the format that `read_model` takes a file for: "stl", "nifti". Throws as it does.
AZULEJO_EXPORT std::string model_format(const std::string& path, const ModelReadOptions& options = {},
                                        const Run& run = {});
AZULEJO_EXPORT std::string model_format(const Input& input, const ModelReadOptions& options = {});

/// True if the file is a model and not an image: by its first bytes, else by its ending. Throws Error(Io).
/// Standard input is gone then: open it, and ask what was opened.
AZULEJO_EXPORT bool is_model_file(const std::string& path, const Run& run = {});
AZULEJO_EXPORT bool is_model_file(const Input& input);

/// Writes beside `path` and renames; the format follows from the ending: stl, ply, off (a Scene is flattened by the
/// caller), obj, glb, svg. "-" writes a mesh as PLY, a scene as GLB, a drawing as SVG.
/// Throws Error(Argument) for an ending that isn't written, Error(Io).
AZULEJO_EXPORT void write_model(const Mesh& mesh, const std::string& path, const ModelWriteOptions& options = {},
                                const Run& run = {});
AZULEJO_EXPORT void write_model(const Scene& scene, const std::string& path, const ModelWriteOptions& options = {},
                                const Run& run = {});
AZULEJO_EXPORT void write_model(const Drawing& drawing, const std::string& path, const ModelWriteOptions& options = {},
                                const Run& run = {});
AZULEJO_EXPORT std::vector<std::byte> encode_model(const Mesh& mesh, const std::string& format,
                                                   const ModelWriteOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT std::vector<std::byte> encode_model(const Scene& scene, const std::string& format,
                                                   const ModelWriteOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT std::vector<std::byte> encode_model(const Drawing& drawing, const std::string& format,
                                                   const ModelWriteOptions& options = {}, const Run& run = {});

/// Endings that can be written and read.
AZULEJO_EXPORT std::vector<std::string> model_endings_written();
AZULEJO_EXPORT std::vector<std::string> model_endings_read();
/// True if the ending of `path` is one of a model that can be written.
AZULEJO_EXPORT bool is_model_path(const std::string& path);
/// True if files of that ending hold scenes; others hold a mesh: a Scene is flattened first. "-" holds a scene.
AZULEJO_EXPORT bool is_scene_path(const std::string& path);
/// True if files of that ending hold drawings. "-" may.
AZULEJO_EXPORT bool is_drawing_path(const std::string& path);

}  // namespace azulejo
