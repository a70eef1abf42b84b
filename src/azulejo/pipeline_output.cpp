#include <algorithm>

#include <fmt/format.h>

#include "azulejo/conversion.h"
#include "azulejo/core/error.h"
#include "azulejo/io/decode_pass.h"
#include "azulejo/io/frame_io.h"
#include "azulejo/io/text_file.h"
#include "azulejo/modelling/flatten.h"
#include "azulejo/pipeline.h"
#include "azulejo/pipeline_parts.h"

namespace azulejo {
namespace {

constexpr const char* kVersion = AZULEJO_VERSION;

bool is_model(ValueKind kind) {
  return kind == ValueKind::Mesh || kind == ValueKind::Scene || kind == ValueKind::Drawing;
}

/// Whether files of that name hold values of a kind.
bool holds(const std::string& path, ValueKind kind) {
  if (!is_model(kind)) return is_image_path(path);
  return is_model_path(path) && is_drawing_path(path) == (kind == ValueKind::Drawing);
}

/// "mesh or scene": what files of models of that name hold.
const char* held(const std::string& path) { return is_drawing_path(path) ? "drawing" : "mesh or scene"; }

std::string image_ending(const std::string& path, const WriteOptions& options) {
  return !options.format.empty() ? options.format : path == "-" ? "png" : ending_of(path);
}

/// Whether a file is made of floats, so that nothing of an image's range is lost in it.
bool holds_floats(const std::string& path, const WriteOptions& options) {
  const std::string ending = image_ending(path, options);
  const bool tiff = ending == "tif" || ending == "tiff";
  return ending == "exr" || ending == "hdr" || ending == "pfm" || (tiff && options.type == PixelType::F32);
}

/// The lines that a report has as its table; `otherwise` where it has none.
std::string lines_of(const Json& table, const std::string& otherwise) {
  std::string lines;
  for (std::size_t i = 0; i < table.size(); ++i) lines += table[i].text() + "\n";
  return lines.empty() ? otherwise : lines;
}

bool same(const Pipeline::Place& a, const Pipeline::Place& b) { return a.step == b.step && a.output == b.output; }

}  // namespace

void Pipeline::add_output(const std::string& text) {
  if (current_.step < 0) throw Error(Error::Argument, fmt::format("{}: there is nothing to write", text));
  Output output{current_, text};
  if (const std::size_t length = leading_name(text); length > 0 || text.find('=') != std::string::npos) {
    const std::string name = text.substr(0, text.find('='));
    const Operation* const last = steps_[static_cast<std::size_t>(current_.step)].operation;
    bool found = false;
    for (std::size_t o = 0; last != nullptr && o < last->outputs.size(); ++o) {
      if (last->outputs[o].name != name) continue;
      output = {{current_.step, static_cast<int>(o)}, text.substr(name.size() + 1)};
      found = true;
    }
    const std::string_view stem = std::string_view(name).substr(0, name.find('.'));
    const bool named = std::any_of(names_.begin(), names_.end(), [&](const auto& each) { return each.first == stem; });
    if (!found && named) output = {find(name), text.substr(name.size() + 1)};
    if (!found && !named && name == "picture") {
      output = {picture(), text.substr(name.size() + 1)};
    } else if (!found && !named && is_name(name)) {
      throw Error(Error::Argument, fmt::format("-o {}: \"{}\" is no output of {} and nothing was named so", text, name,
                                               label(current_)));
    }
  }
  if (output.path == text) output.place = fitting(output.place, output.path);
  output.place = drawn(output.place, output.path);
  check_ending(output.place, output.path);
  for (const Output& each : outputs_) {
    if (each.path == output.path) throw Error(Error::Argument, fmt::format("-o {}: given twice", output.path));
  }
  outputs_.push_back(std::move(output));
}

/// The output of the same step that a file of that name holds: the first of all, else the first that fits.
Pipeline::Place Pipeline::fitting(Place place, const std::string& path) const {
  const Operation* const made_by = steps_[static_cast<std::size_t>(place.step)].operation;
  if (made_by == nullptr || path == "-" || !(is_image_path(path) || is_model_path(path))) return place;
  const auto fits = [&](Place each) {
    const ValueKind what = kind(each);
    return what != ValueKind::Report && what != ValueKind::Volume && holds(path, what);
  };
  if (fits(place)) return place;
  for (int o = 0; o < static_cast<int>(made_by->outputs.size()); ++o) {
    if (fits({place.step, o})) return {place.step, o};
  }
  return place;
}

/// A drawing that goes into a file of an image is drawn by the operation `draw`, as large as its page.
Pipeline::Place Pipeline::drawn(Place place, const std::string& path) {
  if (kind(place) != ValueKind::Drawing || !is_image_path(path) || path == "-") return place;
  return drawn_by("draw", place);
}

/// What an operation makes of a value by default; the value, where there is no such operation.
Pipeline::Place Pipeline::drawn_by(std::string_view operation, Place place) {
  const auto draw = std::ranges::find(operations_, operation, [](const Operation* each) { return each->name; });
  if (draw == operations_.end()) return place;
  const Place before = current_;
  const Place image = add_operation(**draw, {}, {&place, 1});
  current_ = before;
  return image;
}

/// What `picture=` stands for.
Pipeline::Place Pipeline::picture() {
  const Operation* const made_by = steps_[static_cast<std::size_t>(current_.step)].operation;
  std::vector<Place> places{current_};
  for (std::size_t o = 0; made_by != nullptr && o < made_by->outputs.size(); ++o) {
    places.push_back({current_.step, static_cast<int>(o)});
  }
  for (const Place place : places) {
    const ValueKind what = kind(place);
    if (what == ValueKind::Report || what == ValueKind::Volume) continue;
    if (!is_model(what)) return place;
    return drawn_by(what == ValueKind::Drawing ? "draw" : "render", place);
  }
  throw Error(Error::Argument, fmt::format("picture: {} gives {}, expected what can be drawn", label(current_),
                                           to_string(kind(current_))));
}

/// "b.png: got report from histogram, expected image (-o chart=b.png)"
void Pipeline::refuse_report(Place report, const std::string& path) const {
  const std::vector<Port>& outputs = steps_[static_cast<std::size_t>(report.step)].operation->outputs;
  const auto picture =
      std::ranges::find_if(outputs, [](const Port& port) { return converts(port.kind, ValueKind::Image); });
  const bool drawn = picture != outputs.end() && is_image_path(path);
  throw Error(Error::Argument,
              fmt::format("{}: got report from {}, expected {}", path, label(report),
                          drawn ? fmt::format("image (-o {}={})", picture->name, path) : "a name such as report.json"));
}

/// Whether a value can be written to a file of that name.
void Pipeline::check_ending(Place place, const std::string& path) const {
  const ValueKind what = kind(place);
  if (what == ValueKind::Report) {
    if (is_image_path(path) || is_model_path(path)) refuse_report(place, path);
    return;
  }
  if (what == ValueKind::Volume) {
    throw Error(Error::Unsupported,
                fmt::format("{}: got volume from {}, volumes can't be written", path, label(place)));
  }
  if (path == "-" || holds(path, what)) return;
  if (is_model(what) && is_image_path(path)) {
    throw Error(Error::Argument, fmt::format("{}: {}", path, mismatch(place, ValueKind::Image)));
  }
  if (is_model_path(path)) {
    throw Error(Error::Argument,
                fmt::format("{}: got {} from {}, expected {}", path, to_string(what), label(place), held(path)));
  }
  if (what == ValueKind::Drawing) {
    throw Error(Error::Argument, fmt::format("{}: can't tell the drawing format from the ending, expected svg", path));
  }
  throw Error(Error::Argument,
              fmt::format("{}: can't tell the {} format from the ending, expected one of {}", path,
                          is_model(what) ? "model" : "image",
                          fmt::join(is_model(what) ? model_endings_written() : image_endings_written(), ", ")));
}

bool Pipeline::has_output() const {
  if (!outputs_.empty()) return true;
  return std::any_of(steps_.begin(), steps_.end(), [](const Step& step) {
    return step.operation != nullptr && step.operation->outputs[0].kind == ValueKind::Report;
  });
}

/// Whether a report goes anywhere: it is printed unless that must be asked for.
bool Pipeline::is_wanted(Place report) const {
  const Step& step = steps_[static_cast<std::size_t>(report.step)];
  return !step.operation->outputs[static_cast<std::size_t>(report.output)].on_request ||
         std::ranges::any_of(outputs_, [&](const Output& output) { return same(output.place, report); });
}

/// A frame that goes into files of floats only is asked for as floats, unless the options say otherwise.
void Pipeline::choose_float_output(std::size_t index) {
  Step& step = steps_[index];
  const StageText wanted = parse_stage("output:" + step.operation->float_output);
  if (wanted.arguments.empty()) return;
  const Place frame{static_cast<int>(index), 0};
  for (const Step& each : steps_) {
    if (std::ranges::any_of(each.inputs, [&](Place input) { return same(input, frame); })) return;
  }
  bool written = false;
  for (const Output& output : outputs_) {
    if (!same(output.place, frame)) continue;
    if (!holds_floats(output.path, files_.write_image)) return;
    written = true;
  }
  const auto& [name, text] = wanted.arguments[0];
  const Field* const field = step.operation->find_field(name);
  if (written && field != nullptr && field->print(step.options.get()) == "auto") field->parse(step.options.get(), text);
}

/// Whether an output is written at once and not by rows: models, and frames with all their layers.
bool Pipeline::written_whole(const Output& output) const {
  const ValueKind what = kind(output.place);
  return is_model(what) || (what == ValueKind::Frame && image_ending(output.path, files_.write_image) == "exr");
}

void Pipeline::write_whole(const Output& output) {
  const Value held = value(output.place);
  if (held.frame() != nullptr) return write_frame(*held.frame(), output.path, files_.write_image, run_);
  if (held.drawing() != nullptr) return write_model(*held.drawing(), output.path, files_.write_model, run_);
  if (held.mesh() != nullptr) return write_model(*held.mesh(), output.path, files_.write_model, run_);
  const Scene& scene = *held.scene();
  if (is_scene_path(output.path)) return write_model(scene, output.path, files_.write_model, run_);
  if (!scene.materials.empty())
    warn(run_, fmt::format("{}: materials and textures are left out, the format has none", output.path));
  Mesh flat = flatten(scene, run_);
  flat.material.clear();  // said already
  write_model(flat, output.path, files_.write_model, run_);
}

/// The name of an operation's output; empty: it is a source.
std::string Pipeline::output_name(Place place) const {
  const Operation* const made_by = steps_[static_cast<std::size_t>(place.step)].operation;
  return made_by != nullptr ? made_by->outputs[static_cast<std::size_t>(place.output)].name : "";
}

/// Where an output's rows go.
std::unique_ptr<ImageSink> Pipeline::make_sink(const Output& output) {
  if (kind(output.place) == ValueKind::Frame) {
    const Value held = value(output.place);
    const Frame& frame = *held.frame();
    // Layers that go into files of their own are not lost.
    const auto lost = std::ranges::count_if(frame.layers, [&](const Frame::Layer& layer) {
      return std::ranges::none_of(outputs_, [&](const Output& other) {
        return other.place.step == output.place.step && output_name(other.place) == layer.name;
      });
    });
    if (lost > 1) {
      warn(run_, fmt::format("{}: only layer \"{}\" of {} is written, OpenEXR holds all", output.path,
                             frame.find("color") != nullptr ? "color" : frame.layers[0].name, frame.layers.size()));
    }
  }
  const ValueRef drawn = ref(output.place);
  if (drawn.vertex < 0) {
    throw Error(Error::Argument, fmt::format("{}: {} gives no {} with these options", output.path, label(output.place),
                                             output_name(output.place)));
  }
  return create_image(output.path, graph_.info(drawn), metadata(output.place), files_.write_image, run_);
}

/// Reports that no output takes are printed. False if one's verdict is no.
bool Pipeline::print_reports(const std::function<void(const std::string&)>& print) {
  bool verdict = true;
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    if (step.operation == nullptr) continue;
    for (std::size_t o = 0; o < step.values.size(); ++o) {
      const Report* const report = step.values[o].report();
      if (report == nullptr) continue;
      verdict = verdict && report->verdict;
      const auto taken = std::find_if(outputs_.begin(), outputs_.end(), [&](const Output& output) {
        return output.place.step == static_cast<int>(s) && output.place.output == static_cast<int>(o);
      });
      if (taken == outputs_.end() && step.operation->outputs[o].on_request) continue;
      Json json = Json::object();
      json.set("azulejo", kVersion).set("operation", step.operation->name);
      for (const std::string& key : report->json.keys()) json.set(key, report->json[key]);
      const std::string text = json.dump() + "\n";
      if (taken == outputs_.end() || taken->path == "-") {
        print(text);
        continue;
      }
      write_text_file(taken->path, ending_of(taken->path) == "txt" ? lines_of(report->json["table"], text) : text);
    }
  }
  return verdict;
}

}  // namespace azulejo
