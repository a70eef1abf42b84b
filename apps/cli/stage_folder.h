#pragma once

#include <string>

#include "azulejo/core/run.h"
#include "azulejo/engine/stages.h"

namespace azulejo::cli {

/// Writes every stage into a folder: images as PNG (floats stretched from their minimum to their maximum),
/// meshes as PLY, reports as JSON, and stages.json that lists them in order with what the stretching did.
class StageFolder final : public Stages {
 public:
  /// Makes the folder. Throws Error(Io).
  explicit StageFolder(std::string folder);
  void image(const std::string& step, const std::string& name, const Image& image) override;
  void mesh(const std::string& step, const std::string& name, const Mesh& mesh) override;
  void drawing(const std::string& step, const std::string& name, const Drawing& drawing) override;
  void report(const std::string& step, const std::string& name, const Json& report) override;
  /// Writes the list.
  void finish();

 private:
  std::string folder_;
  Json list_ = Json::array();
};

}  // namespace azulejo::cli
