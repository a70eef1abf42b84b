#include "azulejo/io/gltf_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::uint64_t kMostBytes = 0xFFFFFFFF;  ///< a GLB counts them in 32 bits

void put32(std::vector<std::byte>& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(value >> shift));
}

/// The least and largest of each component; of a component without finite values 0.
void set_bounds(GltfObject& accessor, std::span<const float> values, std::size_t components, const GltfOutput& output) {
  std::array<float, 16> least;
  std::array<float, 16> most;
  least.fill(std::numeric_limits<float>::infinity());
  most.fill(-std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    least[i % components] = std::min(least[i % components], values[i]);
    most[i % components] = std::max(most[i % components], values[i]);
  }
  for (std::size_t c = 0; c < components; ++c) {
    if (least[c] > most[c]) least[c] = most[c] = 0;
  }
  accessor["min"] = output.numbers(std::span(least).first(components), "bounds");
  accessor["max"] = output.numbers(std::span(most).first(components), "bounds");
}

}  // namespace

std::size_t GltfOutput::add_view(std::span<const std::byte> bytes, int target, std::size_t stride) {
  binary_.resize((binary_.size() + 3) / 4 * 4);
  if (bytes.size() > kMostBytes - binary_.size()) {
    throw error(Error::Resource, "more than the 4 GiB that a GLB holds");
  }
  GltfObject view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (stride > 0) view["byteStride"] = stride;
  if (target > 0) view["target"] = target;
  binary_.insert(binary_.end(), bytes.begin(), bytes.end());
  views_.push_back(std::move(view));
  return views_.size() - 1;
}

std::size_t GltfOutput::add_accessor(std::span<const std::byte> bytes, std::uint32_t component, const char* type,
                                     std::size_t count, int target, std::size_t stride) {
  accessors_.push_back({{"bufferView", add_view(bytes, target, stride)},
                        {"componentType", component},
                        {"count", count},
                        {"type", type}});
  return accessors_.size() - 1;
}

std::size_t GltfOutput::add_floats(std::span<const float> values, std::size_t components, bool bounds, int target) {
  static constexpr std::array<const char*, 5> kTypes = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  const std::size_t stride = target == kVertices ? components * sizeof(float) : 0;
  const std::size_t accessor = add_accessor(std::as_bytes(values), 5126, components == 16 ? "MAT4" : kTypes[components],
                                            values.size() / components, target, stride);
  if (bounds) set_bounds(accessors_[accessor], values, components, *this);
  return accessor;
}

std::size_t GltfOutput::add_shared_floats(std::span<const float> values, std::size_t components, bool bounds) {
  const std::span<const std::byte> bytes = std::as_bytes(values);
  std::string key(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  key.push_back(static_cast<char>(components));
  key.push_back(static_cast<char>(bounds));
  const auto found = shared_.find(key);
  if (found != shared_.end()) return found->second;
  return shared_.emplace(std::move(key), add_floats(values, components, bounds)).first->second;
}

GltfObject GltfOutput::number(float value, const char* what) const {
  if (!std::isfinite(value)) throw error(Error::Data, fmt::format("{} of {}, which glTF can't hold", what, value));
  // The double whose shortest digits are the float's shortest digits.
  return std::strtod(fmt::format("{}", value).c_str(), nullptr);
}

void GltfOutput::set(const char* name, GltfObject list) {
  if (!list.empty()) root_[name] = std::move(list);
}

void GltfOutput::write(Output& output) {
  GltfObject used = GltfObject::array();
  for (const std::string& name : extensions_) used.push_back(name);
  set("extensionsUsed", std::move(used));
  set("bufferViews", std::move(views_));
  set("accessors", std::move(accessors_));
  binary_.resize((binary_.size() + 3) / 4 * 4);
  GltfObject buffers = GltfObject::array();
  if (!binary_.empty()) buffers.push_back({{"byteLength", binary_.size()}});
  set("buffers", std::move(buffers));
  root_["asset"] = {{"version", "2.0"}, {"generator", "azulejo " AZULEJO_VERSION}};
  std::string text = root_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::uint64_t size = 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size());
  if (size > kMostBytes) throw error(Error::Resource, "more than the 4 GiB that a GLB holds");
  std::vector<std::byte> head;
  for (const std::uint64_t word :
       {std::uint64_t{0x46546C67}, std::uint64_t{2}, size, std::uint64_t{text.size()}, std::uint64_t{0x4E4F534A}}) {
    put32(head, word);
  }
  output.write(head);
  output.write(std::as_bytes(std::span(text)));
  if (binary_.empty()) return;
  head.clear();
  put32(head, binary_.size());
  put32(head, 0x004E4942);
  output.write(head);
  output.write(binary_);
}

}  // namespace azulejo
