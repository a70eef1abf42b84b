#include "azulejo/rendering/tile.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace azulejo {

TileRenderer::TileRenderer(const Picture& picture) : picture_(picture), batch_(std::make_unique<FragmentBatch>()) {}

void TileRenderer::draw(std::size_t tile) {
  const TileGrid& grid = picture_.grid;
  const int size = 1 << grid.tile_log2;
  buffer_.log2 = grid.tile_log2;
  buffer_.samples = picture_.samples;
  buffer_.origin_x = static_cast<int>(tile % static_cast<std::size_t>(grid.columns)) * size;
  buffer_.origin_y = static_cast<int>(tile / static_cast<std::size_t>(grid.columns)) * size;
  buffer_.left = std::clamp(grid.area.x - buffer_.origin_x, 0, size);
  buffer_.top = std::clamp(grid.area.y - buffer_.origin_y, 0, size);
  buffer_.right = std::clamp(grid.area.right() - buffer_.origin_x, 0, size);
  buffer_.bottom = std::clamp(grid.area.bottom() - buffer_.origin_y, 0, size);
  const bool touched = std::any_of(picture_.chunks.begin(), picture_.chunks.end(),
                                   [&](const BinnedChunk& chunk) { return !chunk.of_tile(tile).empty(); });
  if (!touched) return write_empty();
  buffer_.prepare();
  layered_.clear();
  raster(tile);
  collect();
  shade_all();
  if (blending_) blend();
  write_color();
}

const RasterInstance& TileRenderer::instance_of(std::uint32_t triangle) {
  const RasterScene& scene = *picture_.shading.scene;
  const RasterInstance& last = scene.instances[last_instance_];
  if (triangle >= last.first_triangle && triangle - last.first_triangle < scene.meshes[last.mesh].triangle_count) {
    return last;
  }
  last_instance_ = scene.instance_of(triangle);
  return scene.instances[last_instance_];
}

/// Opaque triangles go into the visibility buffer, transparent ones are kept for later.
void TileRenderer::raster(std::size_t tile) {
  const RasterScene& scene = *picture_.shading.scene;
  RasterCounts counts;
  const RasterInstance* only = nullptr;
  one_group_ = true;
  for (const BinnedChunk& chunk : picture_.chunks) {
    const std::span<const std::uint32_t> references = chunk.of_tile(tile);
    for (std::size_t i = 0; i < references.size();) {
      const std::uint32_t reference = references[i];
      const bool clipped = (reference & kClippedReference) != 0;
      const RasterInstance& instance =
          instance_of(clipped ? chunk.clipped[reference & ~kClippedReference].triangle : reference);
      if (only == nullptr) only = &instance;
      one_group_ = one_group_ && only == &instance && scene.meshes[instance.mesh].triangle_material.empty();
      if (clipped || !instance.opaque) {
        raster_reference(chunk, reference, instance);
        ++i;
        continue;
      }
      const RasterMesh& mesh = scene.meshes[instance.mesh];
      const std::uint32_t end = instance.first_triangle + mesh.triangle_count;
      std::size_t stop = i;
      while (stop < references.size() && references[stop] < end) ++stop;
      kernels::raster_triangles(buffer_, picture_.shading.vertices.data() + instance.first_vertex, mesh.vertices(),
                                instance.first_triangle, references.subspan(i, stop - i),
                                picture_.count ? &counts : nullptr);
      i = stop;
    }
  }
  statistics_.fragments_tested += counts.tested;
  statistics_.fragments_passed += counts.passed;
}

std::array<ScreenVertex, 3> TileRenderer::vertices_of(const BinnedChunk& chunk, std::uint32_t reference,
                                                      std::uint32_t& triangle) const {
  if ((reference & kClippedReference) != 0) {
    const ClippedTriangle& clipped = chunk.clipped[reference & ~kClippedReference];
    triangle = clipped.triangle;
    return clipped.vertices;
  }
  triangle = reference;
  const RasterScene& scene = *picture_.shading.scene;
  const RasterInstance& instance = scene.instances[last_instance_];
  const std::uint32_t* const v =
      scene.meshes[instance.mesh].vertices() + std::size_t{3} * (reference - instance.first_triangle);
  const ScreenVertex* const vertices = picture_.shading.vertices.data() + instance.first_vertex;
  return {vertices[v[0]], vertices[v[1]], vertices[v[2]]};
}

void TileRenderer::raster_reference(const BinnedChunk& chunk, std::uint32_t reference, const RasterInstance& instance) {
  std::uint32_t triangle = 0;
  const std::array<ScreenVertex, 3> vertices = vertices_of(chunk, reference, triangle);
  const RasterScene& scene = *picture_.shading.scene;
  const std::uint32_t material = scene.meshes[instance.mesh].material(triangle - instance.first_triangle);
  switch (scene.materials[material].material.alpha_mode) {
    case AlphaMode::Opaque: {
      RasterCounts counts;
      kernels::raster_triangle(buffer_, vertices, triangle, picture_.count ? &counts : nullptr);
      statistics_.fragments_tested += counts.tested;
      statistics_.fragments_passed += counts.passed;
      break;
    }
    case AlphaMode::Mask: raster_masked(vertices, triangle); break;
    case AlphaMode::Blend:
      // Kept with all their samples; those behind opaque surfaces are dropped when everything opaque is drawn.
      covered_.clear();
      kernels::cover_triangle(buffer_, vertices, covered_);
      for (const CoveredSample& sample : covered_) layered_.push_back({sample.at, sample.depth, triangle, 0});
      break;
  }
}

/// Only where the opacity reaches the cutoff: it is looked up at the centres of the pixels.
void TileRenderer::raster_masked(const std::array<ScreenVertex, 3>& vertices, std::uint32_t triangle) {
  covered_.clear();
  kernels::cover_triangle(buffer_, vertices, covered_);
  const RasterScene& scene = *picture_.shading.scene;
  const RasterInstance& instance = instance_of(triangle);
  FragmentBatch& batch = *batch_;
  batch.instance = &instance;
  batch.mesh = &scene.meshes[instance.mesh];
  batch.material = &scene.materials[batch.mesh->material(triangle - instance.first_triangle)];
  const float cutoff = batch.material->material.alpha_cutoff;
  for (std::size_t begin = 0; begin < covered_.size(); begin += FragmentBatch::kMost) {
    batch.count = std::min(FragmentBatch::kMost, covered_.size() - begin);
    for (std::size_t i = 0; i < batch.count; ++i) {
      const std::size_t pixel = covered_[begin + i].at & (buffer_.pixels() - 1);
      batch.x[i] = static_cast<float>(pixel_x(pixel)) + 0.5F;
      batch.y[i] = static_cast<float>(pixel_y(pixel)) + 0.5F;
      batch.triangle[i] = triangle - instance.first_triangle;
    }
    interpolate_batch(batch, picture_.shading);
    const Parameter& opacity = batch.base_color[3];
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (!((opacity.varying != nullptr ? opacity.varying[i] : opacity.uniform) >= cutoff)) continue;
      const CoveredSample& sample = covered_[begin + i];
      buffer_.depth[sample.at] = sample.depth;
      buffer_.triangle[sample.at] = triangle;
      ++statistics_.fragments_passed;
    }
  }
  statistics_.fragments_tested += covered_.size();
}

std::uint32_t TileRenderer::group_of(std::uint32_t triangle) {
  const RasterInstance& instance = instance_of(triangle);
  const std::uint32_t material =
      picture_.shading.scene->meshes[instance.mesh].material(triangle - instance.first_triangle);
  if (!groups_.empty()) {
    const Group& last = groups_[last_group_];
    if (last.instance == last_instance_ && last.material == material) return last_group_;
  }
  const std::uint64_t key = (std::uint64_t{last_instance_} << 32) | material;
  const auto [known, added] = group_numbers_.try_emplace(key, static_cast<std::uint32_t>(groups_.size()));
  if (added) groups_.push_back({last_instance_, material, 0, 0});
  return last_group_ = known->second;
}

std::size_t TileRenderer::add_visible(std::size_t pixel, std::uint8_t weight, std::uint32_t triangle) {
  Visible& v = visible_;
  if (v.count == v.pixel.size()) {
    const std::size_t room = 2 * v.count;
    v.pixel.resize(room);
    v.triangle.resize(room);
    v.weight.resize(room);
    v.primary.resize(room);
  }
  v.pixel[v.count] = static_cast<std::uint32_t>(pixel);
  v.triangle[v.count] = triangle;
  v.weight[v.count] = weight;
  v.primary[v.count] = 0;
  return v.count++;
}

/// What is seen in each pixel: once for every triangle, however many samples see it.
void TileRenderer::collect() {
  // Of the transparent samples only those in front of everything opaque matter.
  std::erase_if(layered_, [&](const Layered& each) { return !(each.depth > buffer_.depth[each.at]); });
  blending_ = !layered_.empty();
  const std::size_t room = buffer_.pixels() + 64;
  mixed_.resize(room);
  if (visible_.pixel.size() < room) {
    visible_.pixel.resize(room);
    visible_.triangle.resize(room);
    visible_.weight.resize(room);
    visible_.primary.resize(room);
  }
  const kernels::VisibleCounts counts =
      kernels::visible_pixels(buffer_, visible_.pixel.data(), visible_.triangle.data(), mixed_.data());
  visible_.whole = visible_.count = counts.whole;
  if (blending_) {
    of_sample_.assign(buffer_.pixels() * buffer_.samples.size(), kNoTriangle);
    for (std::uint32_t v = 0; v < visible_.whole; ++v) {
      for (std::size_t s = 0; s < buffer_.samples.size(); ++s) of_sample_[s * buffer_.pixels() + visible_.pixel[v]] = v;
    }
  }
  for (std::size_t i = 0; i < counts.mixed; ++i) collect_mixed(mixed_[i]);
  if (blending_) collect_layered();
  group_visible();
}

void TileRenderer::collect_mixed(std::size_t pixel) {
  const std::size_t pixels = buffer_.pixels();
  const std::size_t first = visible_.count;
  std::size_t most = first;
  for (std::size_t s = 0; s < buffer_.samples.size(); ++s) {
    const std::uint32_t triangle = buffer_.triangle[s * pixels + pixel];
    if (triangle == kNoTriangle) continue;
    std::size_t known = first;
    while (known < visible_.count && visible_.triangle[known] != triangle) ++known;
    if (known == visible_.count) {
      add_visible(pixel, 1, triangle);
    } else {
      ++visible_.weight[known];
    }
    if (blending_) of_sample_[s * pixels + pixel] = static_cast<std::uint32_t>(known);
    if (visible_.weight[known] > visible_.weight[most]) most = known;
  }
  visible_.primary[most] = 1;
}

/// Transparent triangles are shaded once a pixel too.
void TileRenderer::collect_layered() {
  const auto pixel_of = [&](const Layered& each) { return each.at & (buffer_.pixels() - 1); };
  std::sort(layered_.begin(), layered_.end(), [&](const Layered& a, const Layered& b) {
    return std::tuple(pixel_of(a), a.triangle, a.at) < std::tuple(pixel_of(b), b.triangle, b.at);
  });
  for (std::size_t i = 0; i < layered_.size(); ++i) {
    const bool same =
        i > 0 && layered_[i].triangle == layered_[i - 1].triangle && pixel_of(layered_[i]) == pixel_of(layered_[i - 1]);
    if (!same) add_visible(pixel_of(layered_[i]), 0, layered_[i].triangle);
    layered_[i].visible = static_cast<std::uint32_t>(visible_.count - 1);
  }
}

void TileRenderer::group_visible() {
  groups_.clear();
  group_numbers_.clear();
  visible_.group.clear();
  order_.clear();
  last_group_ = 0;
  const auto count = static_cast<std::uint32_t>(visible_.count);
  if (count == 0) return;
  if (one_group_) {
    group_of(visible_.triangle[0]);
    groups_[0].count = groups_[0].next = count;
    return;
  }
  visible_.group.resize(count);
  for (std::size_t v = 0; v < count; ++v) ++groups_[visible_.group[v] = group_of(visible_.triangle[v])].count;
  std::uint32_t sum = 0;
  for (Group& group : groups_) {
    group.next = sum;
    sum += group.count;
  }
  order_.resize(count);
  for (std::uint32_t v = 0; v < count; ++v) order_[groups_[visible_.group[v]].next++] = v;
}

void TileRenderer::shade_all() {
  accumulated_.resize(buffer_.pixels());
  std::fill(accumulated_.begin(), accumulated_.end(), glm::vec4(0));
  if (blending_) shaded_.resize(visible_.count);
  for (const Group& group : groups_) shade_group(group, group.next - group.count, group.next);
  statistics_.fragments_shaded += visible_.count;
}

/// Pixels and triangles of a batch. Where its members follow each other the compiler does this in vectors.
void TileRenderer::place_batch(const std::uint32_t* members) {
  FragmentBatch& batch = *batch_;
  const std::size_t count = batch.count;
  const int shift = buffer_.log2;
  const std::uint32_t mask = (1U << shift) - 1;
  const float left = static_cast<float>(buffer_.origin_x) + 0.5F;
  const float top = static_cast<float>(buffer_.origin_y) + 0.5F;
  const std::uint32_t first_triangle = batch.instance->first_triangle;
  FragmentBatch::Column<std::uint32_t> gathered;
  const std::uint32_t* pixels = visible_.pixel.data() + members[0];
  const std::uint32_t* triangles = visible_.triangle.data() + members[0];
  if (members[count - 1] - members[0] != count - 1) {
    for (std::size_t i = 0; i < count; ++i) gathered[i] = visible_.pixel[members[i]];
    for (std::size_t i = 0; i < count; ++i) batch.triangle[i] = visible_.triangle[members[i]] - first_triangle;
    pixels = gathered.data();
  } else {
    for (std::size_t i = 0; i < count; ++i) batch.triangle[i] = triangles[i] - first_triangle;
  }
  for (std::size_t i = 0; i < count; ++i)
    batch.x[i] = left + static_cast<float>(static_cast<std::int32_t>(pixels[i] & mask));
  for (std::size_t i = 0; i < count; ++i)
    batch.y[i] = top + static_cast<float>(static_cast<std::int32_t>(pixels[i] >> shift));
}

void TileRenderer::shade_group(const Group& group, std::size_t begin, std::size_t end) {
  const RasterScene& scene = *picture_.shading.scene;
  FragmentBatch& batch = *batch_;
  batch.instance = &scene.instances[group.instance];
  batch.mesh = &scene.meshes[batch.instance->mesh];
  batch.material = &scene.materials[group.material];
  const bool layers = picture_.layers.size() > 1 || picture_.layers[0].kind != LayerKind::Color;
  const float share = 1.0F / static_cast<float>(buffer_.samples.size());
  std::array<std::uint32_t, FragmentBatch::kMost> members;
  alignas(64) std::array<glm::vec4, FragmentBatch::kMost + 16> colors;
  for (; begin < end; begin += batch.count) {
    batch.count = std::min(FragmentBatch::kMost, end - begin);
    for (std::size_t i = 0; i < batch.count; ++i) {
      members[i] = order_.empty() ? static_cast<std::uint32_t>(begin + i) : order_[begin + i];
    }
    place_batch(members.data());
    interpolate_batch(batch, picture_.shading);
    if (layers) write_layers(batch, members.data());
    light_batch(batch, picture_.shading);
    if (blending_) {
      kernels::interleave_colors(batch, false, colors.data());
      for (std::size_t i = 0; i < batch.count; ++i) shaded_[members[i]] = colors[i];
    }
    kernels::interleave_colors(batch, true, colors.data());
    for (std::size_t i = 0; i < batch.count; ++i) {
      const std::uint32_t v = members[i];
      glm::vec4& sum = accumulated_[visible_.pixel[v]];
      if (v < visible_.whole) {
        sum = colors[i];
      } else {
        sum += colors[i] * (share * static_cast<float>(visible_.weight[v]));
      }
    }
  }
}

/// The data layers, from what most of a pixel's samples see.
void TileRenderer::write_layers(const FragmentBatch& batch, const std::uint32_t* members) {
  const RasterScene& scene = *picture_.shading.scene;
  const ShadingView& view = picture_.shading.view;
  // All that has no material counts as one more.
  const auto place = static_cast<std::uint32_t>(batch.material - scene.materials.data());
  const auto material = static_cast<float>(std::min(place, scene.own_materials));
  for (const LayerTarget& layer : picture_.layers) {
    if (layer.kind == LayerKind::Color) continue;
    const ImageView<float> pixels = layer.pixels.as<float>();
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (members[i] >= visible_.whole && visible_.primary[members[i]] == 0) continue;
      const std::uint32_t pixel = visible_.pixel[members[i]];
      float* const to = &pixels(pixel_x(pixel), pixel_y(pixel));
      const auto put = [&](const auto& columns, std::size_t channels) {
        for (std::size_t c = 0; c < channels; ++c) to[c] = columns[c][i];
      };
      const auto parameter = [&](const Parameter& p) { return p.varying != nullptr ? p.varying[i] : p.uniform; };
      switch (layer.kind) {
        case LayerKind::Color: break;
        case LayerKind::Depth: {
          float distance = 0;
          for (std::size_t c = 0; c < 3; ++c) {
            const int axis = static_cast<int>(c);
            distance += (batch.position[c][i] - view.eye[axis]) * view.forward[axis];
          }
          *to = distance;
          break;
        }
        case LayerKind::Normal: put(batch.normal, 3); break;
        case LayerKind::Position: put(batch.position, 3); break;
        case LayerKind::Uv: put(batch.uv, 2); break;
        case LayerKind::Albedo:
          for (std::size_t c = 0; c < 3; ++c) to[c] = parameter(batch.base_color[c]);
          break;
        case LayerKind::Object: *to = static_cast<float>(batch.instance->object) + 1; break;
        case LayerKind::Material: *to = material + 1; break;
        case LayerKind::Face: *to = static_cast<float>(batch.mesh->face(batch.triangle[i])) + 1; break;
      }
    }
  }
}

/// Transparent samples over what is behind them, the farthest first.
void TileRenderer::blend() {
  std::sort(layered_.begin(), layered_.end(), [](const Layered& a, const Layered& b) {
    return std::tuple(a.at, a.depth, b.triangle) < std::tuple(b.at, b.depth, a.triangle);
  });
  const float share = 1.0F / static_cast<float>(buffer_.samples.size());
  for (std::size_t begin = 0; begin < layered_.size();) {
    const std::uint32_t at = layered_[begin].at;
    const std::uint32_t behind = of_sample_[at];
    const glm::vec4 before = behind == kNoTriangle ? glm::vec4(0) : glm::vec4(glm::vec3(shaded_[behind]), 1);
    glm::vec4 color = before;
    std::size_t i = begin;
    for (; i < layered_.size() && layered_[i].at == at; ++i) {
      const glm::vec4& over = shaded_[layered_[i].visible];
      color = glm::vec4(glm::vec3(over) * over.w, over.w) + color * (1 - over.w);
    }
    accumulated_[at & (buffer_.pixels() - 1)] += (color - before) * share;
    begin = i;
  }
}

Rect TileRenderer::tile_rect() const {
  return intersection({buffer_.origin_x, buffer_.origin_y, buffer_.size(), buffer_.size()},
                      {0, 0, picture_.width, picture_.height});
}

void TileRenderer::write_color() {
  for (const LayerTarget& layer : picture_.layers) {
    if (layer.kind != LayerKind::Color) continue;
    kernels::resolve_pixels(accumulated_.data(), static_cast<std::size_t>(buffer_.size()), picture_.resolve,
                            layer.pixels.crop(tile_rect()));
  }
}

/// A tile without triangles: one row of background, again and again.
void TileRenderer::write_empty() {
  accumulated_.assign(static_cast<std::size_t>(buffer_.size()), glm::vec4(0));
  for (const LayerTarget& layer : picture_.layers) {
    if (layer.kind != LayerKind::Color) continue;
    const AnyView part = layer.pixels.crop(tile_rect());
    kernels::resolve_pixels(accumulated_.data(), 0, picture_.resolve, part.crop({0, 0, part.width(), 1}));
    for (int y = 1; y < part.height(); ++y) std::copy_n(part.row(0), part.info.row_bytes(), part.row(y));
  }
}

}  // namespace azulejo
