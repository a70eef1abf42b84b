#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "azulejo/core/export.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/frame.h"
#include "azulejo/data/image.h"
#include "azulejo/data/labels.h"
#include "azulejo/data/mesh.h"
#include "azulejo/data/scene.h"
#include "azulejo/data/volume.h"
#include "azulejo/engine/report.h"

namespace azulejo {

enum class ValueKind : std::uint8_t { Image, Labels, Report, Mesh, Scene, Volume, Frame, Drawing };

/// Anything that flows from one operation to the next. Shared, never changed.
class AZULEJO_EXPORT Value {
 public:
  Value() = default;
  Value(Image image) : value_(std::make_shared<const Image>(std::move(image))) {}
  Value(Labels labels) : value_(std::make_shared<const Labels>(std::move(labels))) {}
  Value(Report report) : value_(std::make_shared<const Report>(std::move(report))) {}
  Value(Mesh mesh) : value_(std::make_shared<const Mesh>(std::move(mesh))) {}
  Value(Scene scene) : value_(std::make_shared<const Scene>(std::move(scene))) {}
  Value(Volume volume) : value_(std::make_shared<const Volume>(std::move(volume))) {}
  Value(Frame frame) : value_(std::make_shared<const Frame>(std::move(frame))) {}
  Value(Drawing drawing) : value_(std::make_shared<const Drawing>(std::move(drawing))) {}
  template <class T>
  explicit Value(std::shared_ptr<const T> value) : value_(std::move(value)) {}

  bool empty() const { return value_.index() == 0; }
  /// Throws Error(Argument) if it is empty.
  ValueKind kind() const;
  /// Null if it is of another kind.
  const Image* image() const { return get<Image>(); }
  const Labels* labels() const { return get<Labels>(); }
  const Report* report() const { return get<Report>(); }
  const Mesh* mesh() const { return get<Mesh>(); }
  const Scene* scene() const { return get<Scene>(); }
  const Volume* volume() const { return get<Volume>(); }
  const Frame* frame() const { return get<Frame>(); }
  const Drawing* drawing() const { return get<Drawing>(); }
  /// What it holds, to be kept: `shared<Mesh>()`. Null if it is of another kind.
  template <class T>
  std::shared_ptr<const T> shared() const {
    const auto* held = std::get_if<std::shared_ptr<const T>>(&value_);
    return held != nullptr ? *held : nullptr;
  }

 private:
  template <class T>
  const T* get() const {
    const auto* held = std::get_if<std::shared_ptr<const T>>(&value_);
    return held != nullptr ? held->get() : nullptr;
  }
  /// In the order of ValueKind.
  std::variant<std::monostate, std::shared_ptr<const Image>, std::shared_ptr<const Labels>,
               std::shared_ptr<const Report>, std::shared_ptr<const Mesh>, std::shared_ptr<const Scene>,
               std::shared_ptr<const Volume>, std::shared_ptr<const Frame>, std::shared_ptr<const Drawing>>
      value_;
};

/// "image", "labels", "report", "mesh", "scene", "volume", "frame", "drawing"
AZULEJO_EXPORT const char* to_string(ValueKind kind);

}  // namespace azulejo
