#include "azulejo/conversion.h"

#include <algorithm>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/modelling/flatten.h"

namespace azulejo {
namespace {

Value scene_around(const Value& value) {
  const std::shared_ptr<const Mesh> mesh = value.shared<Mesh>();
  // A scene of its own has no materials that faces could name.
  if (!mesh->material.empty()) return Value(scene_of(mesh->clone()));
  Mesh named;
  named.name = mesh->name;
  named.space = mesh->space;
  Scene scene = scene_of(std::move(named));
  scene.meshes[0] = mesh;
  return Value(std::move(scene));
}

Value image_of(const std::shared_ptr<const Frame>& frame) {
  const Image* const layer = main_layer(*frame);
  if (layer == nullptr) throw Error(Error::Argument, "a frame without layers, expected one to take as an image");
  return Value(std::shared_ptr<const Image>(frame, layer));
}

template <class T>
Image image_of(const ImageView<const std::uint32_t>& ids, PixelType type, const Run& run) {
  Image image({ids.width, ids.height, 1, type, ColorState::Data, AlphaState::None}, run.limits);
  const auto view = image.view<T>();
  for (int y = 0; y < ids.height; ++y) {
    std::transform(ids.row(y), ids.row(y) + ids.width, view.row(y),
                   [](std::uint32_t id) { return static_cast<T>(id); });
  }
  return image;
}

Image image_of(const Labels& labels, const Run& run) {
  const auto ids = labels.view();
  std::uint32_t largest = 0;
  for (int y = 0; y < ids.height; ++y) {
    largest = std::max(largest, *std::max_element(ids.row(y), ids.row(y) + ids.width));
  }
  const bool small = largest <= std::numeric_limits<std::uint16_t>::max();
  return small ? image_of<std::uint16_t>(ids, PixelType::U16, run) : image_of<float>(ids, PixelType::F32, run);
}

}  // namespace

bool converts(ValueKind from, ValueKind to) {
  return from == to || (from == ValueKind::Mesh && to == ValueKind::Scene) ||
         (from == ValueKind::Scene && to == ValueKind::Mesh) || (from == ValueKind::Frame && to == ValueKind::Image) ||
         (from == ValueKind::Labels && to == ValueKind::Image);
}

Value convert(const Value& value, ValueKind wanted, const Run& run) {
  const ValueKind kind = value.kind();
  if (kind == wanted) return value;
  if (!converts(kind, wanted)) {
    throw Error(Error::Argument, fmt::format("got {}, expected {}", to_string(kind), to_string(wanted)));
  }
  switch (kind) {
    case ValueKind::Mesh: return scene_around(value);
    case ValueKind::Scene: return Value(flatten(*value.scene(), run));
    case ValueKind::Frame: return image_of(value.shared<Frame>());
    default: return Value(image_of(*value.labels(), run));
  }
}

const Operation& variant_for(const Operation& operation, ValueKind first) {
  const std::vector<const Operation*> variants = variants_of(operation);
  const auto takes = [&](auto accepts) -> const Operation* {
    const auto found = std::ranges::find_if(
        variants, [&](const Operation* each) { return !each->inputs.empty() && accepts(each->inputs[0].kind); });
    return found == variants.end() ? nullptr : *found;
  };
  if (const Operation* same = takes([&](ValueKind kind) { return kind == first; })) return *same;
  if (const Operation* near = takes([&](ValueKind kind) { return converts(first, kind); })) return *near;
  return operation;
}

const Image* main_layer(const Frame& frame) {
  if (const Image* const color = frame.find("color")) return color;
  return frame.layers.empty() ? nullptr : &frame.layers[0].image;
}

}  // namespace azulejo
