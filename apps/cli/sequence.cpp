#include "sequence.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "azulejo/core/error.h"
#include "azulejo/io/model_io.h"
#include "azulejo/pipeline.h"
#include "azulejo/rendering/render_operation.h"
#include "azulejo/rendering/spread_directions.h"
#include "batch_run.h"

namespace azulejo::cli {
namespace {

using Arguments = std::vector<std::pair<std::string, std::string>>;

constexpr int kTurntableFrames = 36;
/// Times at which a moving scene's size is looked at, for one camera that sees all of it.
constexpr int kBoundsTimes = 24;

int frame_count(const CommandLine& line) {
  if (line.views > 0) return line.views;
  return line.frames > 0 ? line.frames : kTurntableFrames;
}

void set(Arguments& arguments, const char* name, const std::string& text) {
  std::erase_if(arguments, [&](const auto& each) { return each.first == name; });
  arguments.emplace_back(name, text);
}

void set_orbit(Arguments& arguments, const Orbit& orbit) {
  // The shortest digits that read back the same.
  set(arguments, "azimuth_deg", fmt::format("{}", orbit.azimuth_deg));
  set(arguments, "elevation_deg", fmt::format("{}", orbit.elevation_deg));
  set(arguments, "target", fmt::format("{},{},{}", orbit.target.x, orbit.target.y, orbit.target.z));
  set(arguments, "distance", fmt::format("{}", orbit.distance));
}

RenderOptions parse_options(const Operation& operation, const Arguments& arguments) {
  const std::shared_ptr<void> options = operation.make_options();
  for (const auto& [name, text] : arguments) {
    const Field* const field = operation.find_field(name);
    if (field == nullptr) continue;  // an input
    try {
      field->parse(options.get(), text);
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("{}: {}", operation.name, error.what()));
    }
  }
  operation.check(options.get());
  return *static_cast<const RenderOptions*>(options.get());
}

std::shared_ptr<const Scene> read_scene(const std::string& path, const CommandLine& line, const Run& run) {
  Model model = read_model(path, line.read_model, run);
  if (auto* const scene = std::get_if<Scene>(&model)) return std::make_shared<const Scene>(std::move(*scene));
  if (auto* const mesh = std::get_if<Mesh>(&model)) return std::make_shared<const Scene>(scene_of(std::move(*mesh)));
  throw Error(Error::Unsupported, fmt::format("{}: a volume, expected a mesh or scene", path));
}

/// The box that a scene moves in.
Box3 moving_bounds(const Scene& scene, const RenderOptions& options, float duration, const Run& run) {
  Box3 box;
  for (int i = 0; i < kBoundsTimes; ++i) {
    const float time = duration * static_cast<float>(i) / (kBoundsTimes - 1);
    box = united(box, bounds(posed_scene(scene, options.animation, time, run).value()));
  }
  return box;
}

void refuse_given(const CommandLine& line, const char* sequence, std::initializer_list<const char*> names) {
  for (const auto& [name, text] : line.arguments) {
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      throw Error(Error::Argument, fmt::format("{}: {} given, and {} chooses it", flag_of(name), text, sequence));
    }
  }
}

/// The arguments of every frame.
std::vector<Arguments> plan(const Scene& scene, const CommandLine& line, const Run& run) {
  const RenderOptions options = parse_options(*line.operation, line.arguments);
  const int count = frame_count(line);
  std::vector<Arguments> frames(static_cast<std::size_t>(count), arguments_with_layers(line));
  if (line.views > 0) {
    const std::vector<Direction> directions = spread_directions(count, line.seed);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      set(frames[i], "azimuth_deg", fmt::format("{}", directions[i].azimuth_deg));
      set(frames[i], "elevation_deg", fmt::format("{}", directions[i].elevation_deg));
    }
    return frames;
  }
  const float duration = options.time_s ? 0 : animation_duration(scene, options.animation);
  if (line.command == "turntable" || !(duration > 0)) {
    const std::optional<Scene> posed = posed_scene(scene, options.animation, options.time_s, run);
    const std::vector<Orbit> orbits =
        turntable(posed ? *posed : scene, options.camera, count, options.width, options.height, run);
    for (std::size_t i = 0; i < frames.size(); ++i) set_orbit(frames[i], orbits[i]);
    return frames;
  }
  const bool framed = options.camera.camera.empty() && !options.camera.position &&
                      choose_camera(scene, options.camera, options.width, options.height).from_file == false;
  std::optional<Orbit> orbit;
  if (framed) {
    orbit = framed_orbit(moving_bounds(scene, options, duration, run), scene.space, options.camera, options.width,
                         options.height, run);
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (orbit) set_orbit(frames[i], *orbit);
    set(frames[i], "time_s", fmt::format("{}", duration * static_cast<float>(i) / static_cast<float>(count)));
  }
  return frames;
}

/// A model, read and made ready when its first frame is wanted.
class Sequence {
 public:
  Sequence(const CommandLine& line, const std::string& input) : line_(line), input_(input) {}

  bool draw(int frame, const std::vector<std::string>& outputs, const Run& run) {
    if (failure_) throw Error(*failure_);
    if (frames_.empty()) prepare(run);
    Operation operation = *line_.operation;
    operation.invoke = [this](std::span<const Value>, const void* given, const Run& inner) {
      const auto& options = *static_cast<const RenderOptions*>(given);
      if (!renderer_ || options.time_s != time_) renderer_.emplace(*scene_, options, inner);
      time_ = options.time_s;
      return rendered_values(*renderer_, options, nullptr, inner);
    };
    Pipeline pipeline(run, {line_.read, line_.write, line_.read_model, line_.write_model});
    const Pipeline::Place place = pipeline.add_value(Value(scene_), input_);
    pipeline.add_operation(operation, frames_[static_cast<std::size_t>(frame)], {&place, 1});
    for (const std::string& output : outputs) pipeline.add_output(output);
    return pipeline.execute(print);
  }

 private:
  /// What fails here would fail for every frame.
  void prepare(const Run& run) {
    try {
      scene_ = read_scene(input_, line_, run);
      frames_ = plan(*scene_, line_, run);
    } catch (const Error& error) {
      failure_ = error;
      throw;
    }
  }

  const CommandLine& line_;
  std::string input_;
  std::optional<Error> failure_;
  std::shared_ptr<const Scene> scene_;
  std::vector<Arguments> frames_;
  std::optional<SceneRenderer> renderer_;
  std::optional<float> time_;
};

std::vector<std::string> frame_outputs(const CommandLine& line, const std::string& input, int frame) {
  std::vector<std::string> outputs = outputs_for(line.outputs, input);
  for (std::string& output : outputs) output = with_frame(output, frame);
  return outputs;
}

void check(const CommandLine& line) {
  const auto refuse = [](const std::string& message) { throw Error(Error::Argument, message); };
  if (line.operation == nullptr || line.operation->name != "render") {
    refuse(fmt::format("{}: {{frame}}, --frames and --views are for render and turntable", line.command));
  }
  const bool turntable = line.command == "turntable";
  if (!turntable && line.frames == 0 && line.views == 0) refuse("-o: {frame} in it, expected --frames or --views too");
  if (line.frames > 0 && line.views > 0) refuse("--frames and --views: both given, expected one");
  if (turntable && line.views > 0) refuse("turntable: --views given, expected --frames");
  if (line.positionals.empty()) refuse(fmt::format("{}: input missing, expected a model file", line.command));
  if (line.outputs.empty()) refuse("-o: missing, expected where the pictures go, with {frame} in it");
  if (line.explain || !line.stages.empty()) refuse("--explain and --stages are for one picture, not for a sequence");
  for (const std::string& output : line.outputs) {
    if (with_frame(output, 0) == output && frame_count(line) > 1) {
      refuse(
          fmt::format("-o {}: every picture would be written there, expected {{frame}} or {{frame:04}} in it", output));
    }
  }
  if (std::ranges::any_of(line.arguments, [](const auto& each) { return each.first == "onto"; })) {
    refuse("--onto is for one picture, not for a sequence");
  }
  if (line.views > 0) {
    refuse_given(line, "--views", {"camera", "view", "azimuth_deg", "elevation_deg", "position"});
  } else if (turntable) {
    refuse_given(line, "turntable", {"camera", "position"});
  }
}

}  // namespace

bool is_sequence(const CommandLine& line) {
  return line.command == "turntable" || line.frames > 0 || line.views > 0 ||
         std::ranges::any_of(line.outputs,
                             [](const std::string& each) { return each.find("{frame") != std::string::npos; });
}

std::string with_frame(const std::string& output, int frame) {
  constexpr std::string_view kOpen = "{frame";
  std::string result;
  std::size_t at = 0;
  for (std::size_t open = output.find(kOpen); open != std::string::npos; open = output.find(kOpen, at)) {
    const std::size_t close = output.find('}', open);
    const std::string form =
        close == std::string::npos ? "" : output.substr(open + kOpen.size(), close - open - kOpen.size());
    const std::string digits = form.starts_with(':') ? form.substr(1) : "";
    const bool numbered = !digits.empty() && digits.size() <= 2 &&
                          std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (close == std::string::npos || (!form.empty() && !numbered)) {
      throw Error(Error::Argument, fmt::format("-o {}: expected {{frame}} or {{frame:04}}", output));
    }
    result += output.substr(at, open - at);
    const int width = numbered ? std::stoi(digits) : 0;
    result += digits.starts_with('0') ? fmt::format("{:0{}}", frame, width) : fmt::format("{:{}}", frame, width);
    at = close + 1;
  }
  return result + output.substr(at);
}

std::vector<std::pair<std::string, std::string>> arguments_with_layers(const CommandLine& line) {
  std::vector<std::pair<std::string, std::string>> arguments = line.arguments;
  const Field* const layers = line.operation->find_field("layers");
  if (layers == nullptr) return arguments;
  std::vector<std::string> wanted;
  for (const std::string& output : line.outputs) {
    const std::string name = output.substr(0, output.find('='));
    const bool layer = std::ranges::find(layers->choices, name) != layers->choices.end();
    if (layer && name.size() < output.size()) wanted.push_back(name);
  }
  if (wanted.empty()) return arguments;
  const std::shared_ptr<void> defaults = line.operation->make_options();
  std::string text = layers->print(defaults.get());
  for (const auto& [name, given] : arguments) {
    if (name == "layers") text = given;
  }
  for (const std::string& name : wanted) {
    if (("," + text + ",").find("," + name + ",") == std::string::npos) text += "," + name;
  }
  set(arguments, "layers", text);
  return arguments;
}

int sequence_command(const CommandLine& line, const CancelToken& cancel) {
  check(line);
  const int count = frame_count(line);
  std::vector<Manifest::Item> items;
  std::map<std::string, std::string> writer;
  for (const std::string& input : line.positionals) {
    for (int frame = 0; frame < count; ++frame) {
      Manifest::Item item{input, {}};
      for (const std::string& output : frame_outputs(line, input, frame)) {
        item.files.push_back(path_of_output(output));
        const std::string picture = fmt::format("frame {} of {}", frame, input);
        const auto [same, added] = writer.emplace(item.files.back(), picture);
        if (!added) {
          throw Error(Error::Argument, fmt::format("{}: would be written from {} and from {}", item.files.back(),
                                                   same->second, picture));
        }
      }
      items.push_back(std::move(item));
    }
  }
  std::size_t current = line.positionals.size();
  std::optional<Sequence> sequence;
  return BatchRun(line, line.positionals, std::move(items), cancel).in_turn([&](std::size_t i, const Run& run) {
    const std::size_t input = i / static_cast<std::size_t>(count);
    const auto frame = static_cast<int>(i % static_cast<std::size_t>(count));
    if (input != current) sequence.emplace(line, line.positionals[input]);
    current = input;
    return sequence->draw(frame, frame_outputs(line, line.positionals[input], frame), run);
  });
}

}  // namespace azulejo::cli
