// What a picture costs, without peers: its parts from file to file, and how drawing grows with triangles and pixels.
//   render_costs FOLDER [FILE.md]   writes triangles.svg and pixels.svg into FOLDER; FILE.md: puts the tables between
//                                   its lines <!-- pictures --> and <!-- /pictures -->
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

#include "azulejo/io/image_io.h"
#include "azulejo/rendering/camera_choice.h"
#include "azulejo/rendering/lighting.h"
#include "azulejo/rendering/zbuffer.h"
#include "bench/models.h"

namespace azulejo::bench {
namespace {

constexpr int kRounds = 7;

double milliseconds() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Scene scene_in(Model model) {
  if (auto* const mesh = std::get_if<Mesh>(&model)) return scene_of(std::move(*mesh));
  return std::move(std::get<Scene>(model));
}

/// A line of the table of parts.
std::string first_picture(const std::string& name, const std::string& path) {
  std::vector<double> parts[4];
  for (int round = 0; round < kRounds; ++round) {
    const double start = milliseconds();
    const Scene scene = scene_in(read_model(path));
    const double read = milliseconds();
    const View view = choose_camera(scene, {}, 1920, 1080).view;
    const Lighting lighting = choose_lighting(scene, view).lighting;
    const ZBufferRenderer renderer(scene);
    const double prepared = milliseconds();
    const Frame frame = renderer.draw(view, lighting);
    const double drawn = milliseconds();
    encode_image(frame.layers[0].image, "png");
    const double written = milliseconds();
    const double times[4] = {read - start, prepared - read, drawn - prepared, written - drawn};
    for (int p = 0; p < 4; ++p) parts[p].push_back(times[p]);
  }
  double sum = 0;
  std::string line = fmt::format("| {} |", name);
  for (const std::vector<double>& part : parts) {
    sum += median(part);
    line += fmt::format(" {:.0f} |", median(part));
  }
  return line + fmt::format(" {:.0f} |\n", sum);
}

struct Cost {
  double size;
  double milliseconds;
};

Cost draw_cost(std::size_t triangles, int width, int height, bool by_triangles) {
  const Scene scene = scene_of(sphere(triangles));
  const View view = choose_camera(scene, {}, width, height).view;
  const Lighting lighting = choose_lighting(scene, view).lighting;
  ZBufferOptions options;
  options.antialias = 1;
  const ZBufferRenderer renderer(scene, options);
  Frame frame = renderer.draw(view, lighting);
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const double start = milliseconds();
    renderer.draw_into(frame, view, lighting);
    times.push_back(milliseconds() - start);
  }
  const double pixels = static_cast<double>(width) * height;
  return {by_triangles ? static_cast<double>(scene.meshes[0]->face_count()) : pixels, median(times)};
}

/// Points in a square of decades, both axes logarithmic.
std::string plot(const std::vector<Cost>& costs, const std::string& title, const std::string& axis) {
  constexpr double kWidth = 480;
  constexpr double kHeight = 320;
  constexpr double kMargin = 56;
  const double x0 = std::floor(std::log10(costs.front().size));
  const double x1 = std::ceil(std::log10(costs.back().size));
  const double y0 = std::floor(std::log10(costs.front().milliseconds));
  const double y1 = std::ceil(std::log10(costs.back().milliseconds));
  const auto x = [&](double value) { return kMargin + (std::log10(value) - x0) / (x1 - x0) * (kWidth - kMargin - 16); };
  const auto y = [&](double value) {
    return kHeight - 44 - (std::log10(value) - y0) / (y1 - y0) * (kHeight - 44 - 36);
  };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n"
      "<text x=\"{2}\" y=\"20\" font-size=\"14\">{3}</text>\n",
      kWidth, kHeight, kMargin, title);
  const auto line = [&](double ax, double ay, double bx, double by, const char* color) {
    svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", ax, ay, bx,
                       by, color);
  };
  for (double e = x0; e <= x1; ++e) {
    const double value = std::pow(10, e);
    line(x(value), y(std::pow(10, y0)), x(value), y(std::pow(10, y1)), "#ddd");
    svg += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">10<tspan dy=\"-5\" "
        "font-size=\"9\">{:.0f}</tspan></text>\n",
        x(value), kHeight - 26, e);
  }
  for (double e = y0; e <= y1; ++e) {
    const double value = std::pow(10, e);
    line(x(std::pow(10, x0)), y(value), x(std::pow(10, x1)), y(value), "#ddd");
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g} ms</text>\n", kMargin - 6,
                       y(value) + 4, value);
  }
  std::string points;
  for (const Cost& cost : costs) points += fmt::format("{:.1f},{:.1f} ", x(cost.size), y(cost.milliseconds));
  svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"2\"/>\n", points);
  for (const Cost& cost : costs) {
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"#1f5fa8\"/>\n", x(cost.size),
                       y(cost.milliseconds));
  }
  return svg + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n</svg>\n",
                           (kMargin + kWidth - 16) / 2, kHeight - 8, axis);
}

std::string table_of(const std::vector<Cost>& costs, const char* unit) {
  std::string head = fmt::format("| {} |", unit);
  std::string rule = "|---|";
  std::string row = "| ms |";
  for (const Cost& cost : costs) {
    head += fmt::format(" {:.3g} |", cost.size);
    rule += "---:|";
    row += fmt::format(" {:.1f} |", cost.milliseconds);
  }
  return head + "\n" + rule + "\n" + row + "\n\n";
}

/// Replaces what stands between the two lines.
void put(const std::string& path, const std::string& text) {
  std::ifstream in(path);
  std::string file{std::istreambuf_iterator<char>(in), {}};
  const std::string from = "<!-- pictures -->\n";
  const std::size_t begin = file.find(from);
  const std::size_t end = file.find("<!-- /pictures -->");
  if (begin == std::string::npos || end == std::string::npos) return;
  file.replace(begin + from.size(), end - begin - from.size(), text);
  std::ofstream(path) << file;
}

int run(int count, char** words) {
  if (count < 2) {
    std::fputs("render_costs FOLDER [FILE.md]\n", stderr);
    return 2;
  }
  std::string text = "From file to PNG, 1920×1080, 4 samples, two threads, median of 7, milliseconds:\n\n";
  text += "| model | read | prepare | draw | encode | sum |\n|---|---:|---:|---:|---:|---:|\n";
  text += first_picture("sphere, 1 M triangles, binary STL", sphere_file("stl")());
  const std::pair<const char*, const char*> shared[] = {
      {"Stanford dragon, 871,414 triangles, ASCII PLY in gzip", "meshes/scans/stanford_dragon_full.ply.gz"},
      {"Stanford bunny, 69,451 triangles, ASCII PLY", "meshes/scans/stanford_bunny_zippered.ply"},
      {"damaged helmet, 15,452 triangles, five 2048² JPEG textures, GLB",
       "scenes/gltf/DamagedHelmet/DamagedHelmet.glb"}};
  for (const auto& [name, path] : shared) {
    if (const auto file = shared_model(path)) text += first_picture(name, *file);
  }
  text +=
      "\nDrawing a sphere, one sample, two threads, at 1920×1080 with more triangles, and of 100,000 triangles with "
      "more pixels:\n\n";
  std::vector<Cost> triangles;
  for (const std::size_t n : {10'000, 30'000, 100'000, 300'000, 1'000'000, 3'000'000, 10'000'000}) {
    triangles.push_back(draw_cost(n, 1920, 1080, true));
  }
  std::vector<Cost> pixels;
  for (const int scale : {1, 2, 4, 8, 16, 32}) pixels.push_back(draw_cost(100'000, 240 * scale, 135 * scale, false));
  text += table_of(triangles, "triangles") + table_of(pixels, "pixels");
  text += "![time against triangles](triangles.svg) ![time against pixels](pixels.svg)\n";
  const std::string folder = words[1];
  std::ofstream(folder + "/triangles.svg") << plot(triangles, "A sphere at 1920×1080, two threads", "triangles");
  std::ofstream(folder + "/pixels.svg") << plot(pixels, "A sphere of 100,000 triangles, two threads", "pixels");
  std::fputs(text.c_str(), stdout);
  if (count > 2) put(words[2], text);
  return 0;
}

}  // namespace
}  // namespace azulejo::bench

int main(int count, char** words) { return azulejo::bench::run(count, words); }
