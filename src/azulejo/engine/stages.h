#pragma once

#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/image.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// Receives the named intermediate results of operations (`Run::stages`). Called from one thread at a time, in
/// the order of the steps.
class AZULEJO_EXPORT Stages {
 public:
  virtual ~Stages() = default;
  /// step  "sobel", in a chain "2-sobel";  name  "magnitude"
  virtual void image(const std::string& step, const std::string& name, const Image& image) = 0;
  /// Left out by receivers that only look at images.
  virtual void mesh(const std::string& /*step*/, const std::string& /*name*/, const Mesh& /*mesh*/) {}
  /// Left out by receivers that don't look at drawings.
  virtual void drawing(const std::string& /*step*/, const std::string& /*name*/, const Drawing& /*drawing*/) {}
  virtual void report(const std::string& step, const std::string& name, const Json& report) = 0;
};

/// The stages of one step.
class AZULEJO_EXPORT StageReporter {
 public:
  StageReporter(Stages& stages, std::string step) : stages_(stages), step_(std::move(step)) {}
  void image(const std::string& name, const Image& image) const { stages_.image(step_, name, image); }
  void mesh(const std::string& name, const Mesh& mesh) const { stages_.mesh(step_, name, mesh); }
  void drawing(const std::string& name, const Drawing& drawing) const { stages_.drawing(step_, name, drawing); }
  void report(const std::string& name, const Json& report) const { stages_.report(step_, name, report); }

 private:
  Stages& stages_;
  std::string step_;
};

}  // namespace azulejo
