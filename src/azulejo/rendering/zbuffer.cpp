#include "azulejo/rendering/zbuffer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/rendering/bin.h"
#include "azulejo/rendering/raster_scene.h"
#include "azulejo/rendering/tile.h"
#include "azulejo/rendering/vertex_stage.h"

namespace azulejo {
namespace {

struct LayerForm {
  const char* name;
  LayerKind kind;
  int channels;
  ColorState color;
  float nothing;
};

constexpr std::array kLayers{
    LayerForm{"color", LayerKind::Color, 4, ColorState::Srgb, 0},
    LayerForm{"depth", LayerKind::Depth, 1, ColorState::Data, std::numeric_limits<float>::infinity()},
    LayerForm{"normal", LayerKind::Normal, 3, ColorState::Data, 0},
    LayerForm{"position", LayerKind::Position, 3, ColorState::Data, 0},
    LayerForm{"uv", LayerKind::Uv, 2, ColorState::Data, 0},
    LayerForm{"albedo", LayerKind::Albedo, 3, ColorState::Linear, 0},
    LayerForm{"object_id", LayerKind::Object, 1, ColorState::Data, 0},
    LayerForm{"material_id", LayerKind::Material, 1, ColorState::Data, 0},
    LayerForm{"face_id", LayerKind::Face, 1, ColorState::Data, 0},
};

const LayerForm& layer_form(const std::string& name) {
  std::vector<const char*> names;
  for (const LayerForm& form : kLayers) {
    if (form.name == name) return form;
    names.push_back(form.name);
  }
  throw Error(Error::Argument, fmt::format("layers: \"{}\", expected {}", name, fmt::join(names, ", ")));
}

ImageInfo layer_info(const LayerForm& form, const View& view, FrameOutput output) {
  ImageInfo info{view.width, view.height, form.channels, PixelType::F32, form.color, AlphaState::None};
  if (form.kind != LayerKind::Color) return info;
  const bool linear = output == FrameOutput::Linear;
  info.type = linear ? PixelType::F32 : output == FrameOutput::Display16 ? PixelType::U16 : PixelType::U8;
  info.color = linear ? ColorState::Linear : ColorState::Srgb;
  info.alpha = linear ? AlphaState::Premultiplied : AlphaState::Straight;
  return info;
}

void check(const View& view, const ZBufferOptions& options) {
  if (view.width < 1 || view.height < 1) {
    throw Error(Error::Argument, fmt::format("size: {}×{}, expected at least 1×1", view.width, view.height));
  }
  constexpr int kLargest = 65536;
  if (view.width > kLargest || view.height > kLargest) {
    throw Error(Error::Argument, fmt::format("size: {}×{}, expected at most {}", view.width, view.height, kLargest));
  }
  if (options.antialias != 1 && options.antialias != 4 && options.antialias != 8 && options.antialias != 16) {
    throw Error(Error::Argument, fmt::format("antialias: {}, expected 1, 4, 8 or 16", options.antialias));
  }
  if (options.program.varyings < 0 || options.program.varyings > 16) {
    throw Error(Error::Argument, fmt::format("program: {} varyings, expected 0 to 16", options.program.varyings));
  }
  if (options.layers.empty()) throw Error(Error::Argument, "layers: none, expected at least one");
  constexpr float kWidest = 1000;
  for (const auto& [name, width] : {std::pair{"line_width", options.line_width}, {"point_size", options.point_size}}) {
    if (!(width >= 0 && width <= kWidest)) {
      throw Error(Error::Argument, fmt::format("{}: {}, expected 0 to {}", name, width, kWidest));
    }
  }
}

Frame make_frame(const View& view, const ZBufferOptions& options, const Run& run) {
  std::int64_t bytes = 0;
  for (const std::string& name : options.layers) {
    const ImageInfo info = layer_info(layer_form(name), view, options.output);
    check_image_info(info, run.limits);
    bytes += image_bytes(info);
  }
  if (bytes > run.limits.memory_bytes) {
    throw Error(Error::Resource, fmt::format("a picture of {}×{} takes {} bytes, more than the limit of {}", view.width,
                                             view.height, bytes, run.limits.memory_bytes));
  }
  Frame frame;
  for (const std::string& name : options.layers) {
    if (frame.find(name) != nullptr) throw Error(Error::Argument, fmt::format("layers: {} is given twice", name));
    const LayerForm& form = layer_form(name);
    Image image(layer_info(form, view, options.output), run.limits);
    if (form.kind != LayerKind::Color) {
      const ImageView<float> pixels = image.view<float>();
      parallel_for(static_cast<std::size_t>(image.height()), 64, run, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
          std::fill_n(pixels.row(static_cast<int>(y)), static_cast<std::size_t>(pixels.width * pixels.channels),
                      form.nothing);
        }
      });
    }
    frame.layers.push_back({name, std::move(image)});
  }
  return frame;
}

/// All vertices of all instances in the picture.
Array<ScreenVertex> transform_all(const RasterScene& scene, const Program& program, const glm::mat4& clip_from_world,
                                  const ScreenTransform& transform, ProgramVertices& made, const Run& run) {
  const bool programmed = program.vertex != nullptr;
  const std::size_t varyings = programmed ? static_cast<std::size_t>(program.varyings) : 0;
  const std::size_t vertex_bytes =
      sizeof(ScreenVertex) + (programmed ? sizeof(glm::vec4) + varyings * sizeof(float) : 0);
  const auto bytes = static_cast<std::int64_t>(scene.vertex_count * vertex_bytes);
  if (bytes > run.limits.memory_bytes) {
    throw Error(Error::Resource, fmt::format("{} vertices over all instances take {} bytes, more than the limit of {}",
                                             scene.vertex_count, bytes, run.limits.memory_bytes));
  }
  Array<ScreenVertex> vertices(scene.vertex_count);
  if (programmed) {
    made.clip.resize(scene.vertex_count);
    made.varyings.resize(scene.vertex_count * varyings);
  }
  constexpr std::size_t kChunk = 32768;
  parallel_for(scene.vertex_count, kChunk, run, [&](std::size_t begin, std::size_t end) {
    auto instance =
        std::upper_bound(scene.instances.begin(), scene.instances.end(), begin,
                         [](std::size_t wanted, const RasterInstance& each) { return wanted < each.first_vertex; });
    for (--instance; instance != scene.instances.end() && instance->first_vertex < end; ++instance) {
      const Array<glm::vec3>& positions = scene.meshes[instance->mesh].mesh->positions;
      const std::size_t from = std::max(begin, instance->first_vertex);
      const std::size_t to = std::min(end, instance->first_vertex + positions.size());
      if (programmed) {
        run_vertex_program(scene, *instance, program, clip_from_world, from - instance->first_vertex,
                           to - instance->first_vertex, made);
        for (std::size_t v = from; v < to; ++v) vertices[v] = to_screen(made.clip[v], transform);
        continue;
      }
      kernels::transform_vertices(positions.data() + (from - instance->first_vertex), to - from,
                                  clip_from_world * instance->world_from_object, transform, vertices.data() + from);
    }
  });
  return vertices;
}

void add(ZBufferStatistics& to, const ZBufferStatistics& from) {
  to.faces_in += from.faces_in;
  to.faces_outside += from.faces_outside;
  to.faces_culled += from.faces_culled;
  to.faces_empty += from.faces_empty;
  to.faces_clipped += from.faces_clipped;
  to.faces_drawn += from.faces_drawn;
  to.fragments_tested += from.fragments_tested;
  to.fragments_passed += from.fragments_passed;
  to.fragments_shaded += from.fragments_shaded;
}

}  // namespace

struct ZBufferRenderer::Prepared {
  RasterScene scene;
};

ZBufferRenderer::ZBufferRenderer(const Scene& scene, const ZBufferOptions& options, const Run& run)
    : options_(options), prepared_(std::make_shared<Prepared>()) {
  prepared_->scene =
      prepare_raster_scene(scene, {options.crease_angle, options.shading == Shading::Flat, options.polygon_mode}, run);
}

Frame ZBufferRenderer::draw(const View& view, const Lighting& lighting, const Run& run,
                            ZBufferStatistics* statistics) const {
  check(view, options_);
  Frame frame = make_frame(view, options_, run);
  draw_into(frame, view, lighting, run, statistics);
  return frame;
}

void ZBufferRenderer::draw_into(Frame& frame, const View& view, const Lighting& lighting, const Run& run,
                                ZBufferStatistics* statistics) const {
  check(view, options_);
  const RasterScene& scene = prepared_->scene;
  Picture picture;
  picture.width = view.width;
  picture.height = view.height;
  picture.samples = sample_pattern(options_.antialias);
  picture.grid = tile_grid(view.width, view.height, view.viewport, options_.antialias);
  picture.count = statistics != nullptr;
  const auto& b = options_.background;
  picture.resolve = {{b[0] * b[3], b[1] * b[3], b[2] * b[3], b[3]}, options_.exposure};
  picture.shading.scene = &scene;
  picture.shading.view = shading_view(view);
  picture.shading.lighting = &lighting;
  picture.shading.shading = options_.shading;
  picture.shading.clip_from_world = view.clip_from_world();
  picture.shading.transform = screen_transform(view.viewport);
  std::vector<LayerTarget> layers;
  for (Frame::Layer& layer : frame.layers) layers.push_back({layer_form(layer.name).kind, layer.image.any()});
  picture.layers = layers;

  const bool uv =
      std::any_of(layers.begin(), layers.end(), [](const LayerTarget& each) { return each.kind == LayerKind::Uv; });
  picture.shading.needs_uv = uv || options_.program.fragment != nullptr;
  ProgramVertices made;
  if (options_.program) {
    picture.shading.program = &options_.program;
    picture.shading.program_vertices = &made;
  }

  Array<ScreenVertex> vertices;
  std::vector<BinnedChunk> chunks;
  if (scene.triangle_count > 0 && !picture.grid.area.empty()) {
    vertices =
        transform_all(scene, options_.program, picture.shading.clip_from_world, picture.shading.transform, made, run);
    // Every chunk has a list a tile: in pictures of many tiles there are fewer chunks.
    constexpr std::size_t kChunk = 16384;
    constexpr std::size_t kMostLists = std::size_t{1} << 23;
    const std::size_t most = std::max<std::size_t>(1, kMostLists / picture.grid.tiles());
    const std::size_t chunk = std::max(kChunk, (scene.triangle_count + most - 1) / most);
    const BinSettings settings{picture.grid, picture.shading.clip_from_world, picture.shading.transform,
                               options_.line_width, options_.point_size};
    chunks.resize((scene.triangle_count + chunk - 1) / chunk);
    std::vector<std::unique_ptr<Binner>> binners(static_cast<std::size_t>(thread_count(run)));
    parallel_tasks(chunks.size(), run, [&](std::size_t c, int worker) {
      std::unique_ptr<Binner>& binner = binners[static_cast<std::size_t>(worker)];
      if (binner == nullptr) binner = std::make_unique<Binner>(scene, vertices, made.clip, settings);
      const std::size_t begin = c * chunk;
      const std::size_t end = std::min<std::size_t>(begin + chunk, scene.triangle_count);
      chunks[c] = binner->bin(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin));
    });
  }
  picture.shading.vertices = vertices;
  picture.chunks = chunks;

  std::vector<std::unique_ptr<TileRenderer>> workers(static_cast<std::size_t>(thread_count(run)));
  parallel_tasks(picture.grid.tiles(), run, [&](std::size_t tile, int worker) {
    std::unique_ptr<TileRenderer>& renderer = workers[static_cast<std::size_t>(worker)];
    if (renderer == nullptr) renderer = std::make_unique<TileRenderer>(picture);
    renderer->draw(tile);
  });
  if (statistics == nullptr) return;
  *statistics = {};
  for (const BinnedChunk& chunk : chunks) add(*statistics, chunk.statistics);
  for (const auto& worker : workers) {
    if (worker != nullptr) add(*statistics, worker->statistics());
  }
}

}  // namespace azulejo
