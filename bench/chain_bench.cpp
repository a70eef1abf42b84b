// A chain of operations on a large image: what fusing its steps gives, beside our own steps one after the other and
// beside OpenCV's, in time and in memory.
#include <opencv2/imgproc.hpp>

#include "azulejo/engine/graph.h"
#include "azulejo/operations.h"
#include "azulejo/pipeline.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr const char* kStages[] = {"grayscale", "gaussian:sigma=1.5", "unsharp_mask", "sobel", "threshold"};
constexpr double kLevel = 0.5;

/// Computes the chain's first result into `result`.
void run_chain(const ConstAnyView& source, const AnyView& result, const Run& run) {
  Graph graph;
  ValueRef current = graph.add_source(source, "source");
  for (const char* const text : kStages) {
    const StageText stage = parse_stage(text);
    const Operation& operation = *find_operation(stage.name);
    const std::shared_ptr<void> options = operation.make_options();
    for (const auto& [name, value] : stage.arguments) operation.find_field(name)->parse(options.get(), value);
    auto node = make_node(operation, options.get(), std::span(&graph.info(current), 1));
    current = graph.add_node(std::move(node), {current}, stage.name, image_names(operation));
  }
  const Target target{current, result, nullptr};
  execute(graph, std::span(&target, 1), run);
}

/// OpenCV's steps, each into memory that is used again.
class Steps {
 public:
  void run(const ConstAnyView& source, const AnyView& result) {
    cv::cvtColor(mat(source), gray_, cv::COLOR_RGB2GRAY);
    cv::GaussianBlur(gray_, smooth_, {13, 13}, 1.5, 1.5, cv::BORDER_REFLECT_101);
    cv::GaussianBlur(smooth_, smoother_, {9, 9}, 1, 1, cv::BORDER_REFLECT_101);
    cv::addWeighted(smooth_, 2, smoother_, -1, 0, sharp_);
    cv::Sobel(sharp_, across_, CV_32F, 1, 0, 3, 1.0 / 255, 0, cv::BORDER_REFLECT_101);
    cv::Sobel(sharp_, down_, CV_32F, 0, 1, 3, 1.0 / 255, 0, cv::BORDER_REFLECT_101);
    cv::magnitude(across_, down_, magnitude_);
    cv::threshold(magnitude_, mat(result), kLevel, 1, cv::THRESH_BINARY);
  }

 private:
  cv::Mat gray_, smooth_, smoother_, sharp_, across_, down_, magnitude_;
};

/// The peer rounds the smoothed image and the mask its own way, which moves a few pixels across the level.
Check mostly_equal(const Image& ours, const Image& peer) {
  const auto a = ours.view<float>();
  const auto b = peer.view<float>();
  std::int64_t different = 0;
  std::int64_t marked = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      different += a(x, y) != b(x, y) ? 1 : 0;
      marked += a(x, y) != 0 ? 1 : 0;
    }
  }
  const double part = static_cast<double>(different) / static_cast<double>(ours.info().rect().area());
  if (marked == 0) return {false, "nothing is above the level"};
  return {part <= 0.002, std::to_string(part * 100) + " % of the pixels"};
}

Row chain_row(Size size, bool beside_opencv) {
  const auto source = make_photo(photo(PixelType::U8, 3, size));
  const auto ours = make_result(photo(PixelType::F32, 1, size));
  const auto peer = make_result(ours->info());
  const auto steps = std::make_shared<Steps>();
  Row row;
  row.work = static_cast<double>(source->info().rect().area());
  row.ours = [=](int threads) { run_chain(source->any(), ours->any(), Run{.threads = threads}); };
  if (beside_opencv) {
    row.peer = [=](int) { steps->run(source->any(), peer->any()); };
    row.check = [=] { return mostly_equal(*ours, *peer); };
    row.aim = 3;
  } else {
    row.peer_name = "unfused";
    row.peer = [=](int threads) {
      Run run{.threads = threads};
      run.testing.fuse = false;
      run_chain(source->any(), peer->any(), run);
    };
    row.check = [=] { return compare(ours->any(), peer->any(), 0); };
    row.aim = 2;
  }
  row.limit = copy_limit(static_cast<std::size_t>(source->bytes()), static_cast<std::size_t>(ours->bytes()));
  row.memory = true;
  row.aim_memory = 0.1;
  return row;
}

const Rows kRows([](Bench& bench) {
  const std::string name = "chain grayscale gaussian:sigma=1.5 unsharp_mask sobel threshold";
  bench.row(name + ", u8 RGB 6000×4000", [] { return chain_row(k24Megapixels, true); });
  bench.row(name + " beside its steps one by one, u8 RGB 6000×4000", [] { return chain_row(k24Megapixels, false); });
  // Too large for any cache, and for the pool of recycled memory.
  bench.row(name + " beside its steps one by one, u8 RGB 16384×12288", [] { return chain_row({16384, 12288}, false); });
});

}  // namespace
}  // namespace azulejo::bench
