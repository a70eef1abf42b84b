#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/engine/graph.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/value.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/model_io.h"
#include "azulejo/operations.h"
#include "azulejo/stage_text.h"

namespace azulejo {

/// How files are read and written.
struct FileOptions {
  ReadOptions read_image = {};
  WriteOptions write_image = {};
  ModelReadOptions read_model = {};
  ModelWriteOptions write_model = {};
};

/// A chain of operations from files to files, checked as it is built and run as one computation.
class AZULEJO_EXPORT Pipeline {
 public:
  /// A result of a step.
  struct Place {
    int step = -1;
    int output = 0;
  };

  /// Names and texts.
  using Arguments = std::vector<std::pair<std::string, std::string>>;

  explicit Pipeline(Run run, FileOptions files = {},
                    std::span<const Operation* const> operations = azulejo::operations());
  Pipeline(Pipeline&&) noexcept;
  ~Pipeline();

  /// Opens an image (its header is read), or reads a model, and makes it the current value.
  Place add_file(const std::string& path);
  /// Makes a value in memory the current one.
  Place add_value(Value value, std::string label);
  /// Adds a stage as written in `run`: an operation on the current value; `as:name` names the current value;
  /// `@name` or `@name.output` makes a named value the current one.
  /// An argument is an option, or an input: a file, or `@name`. An operation that makes an image of an image takes
  /// `within` too, the area outside of which the image stays as it is: `x,y,width,height`, a mask as an input, or
  /// `labels:7` for region 7 of an input; and `feather`, the width over which the change fades in.
  /// inputs  bound to the declared inputs of an operation, in order, as in `add_operation`
  void add_stage(std::string_view text, std::span<const Place> inputs = {});
  /// Adds an operation. `inputs` bind to the declared inputs in order, arguments by name; without
  /// `inputs` the current value fills the first input that nothing else does. A mesh is taken where a scene is wanted, a scene where a mesh is, a frame
  /// or labels where an image is; an operation on one mesh is done to each mesh of a scene. Of an operation with
  /// variants the one for the first input's kind is added.
  /// Throws Error(Argument | Unsupported), with a suggestion for a misspelt name, if kinds or images don't fit.
  Place add_operation(const Operation& operation, const Arguments& arguments, std::span<const Place> inputs = {});

  /// Where a result goes: `path` takes the current value, or where files of that name hold no such value the first
  /// other output of its operation that they hold; `name=path` an output of the last operation, or a value named by
  /// `as`. A frame is written as its color, into OpenEXR with all layers; a scene is flattened for formats that hold a
  /// mesh; a drawing that goes into an image's format is drawn first, as `draw` does it by default. "-" is standard
  /// output. A report with a "table", lines of text, goes into .txt as these. `picture=path`, where nothing is named so, is a picture: of the current value, or else of the first other
  /// output that can be drawn; a drawing as `draw` does it by default, a mesh or scene as `render` does.
  /// Throws Error(Argument) for an ending that can't be written.
  void add_output(const std::string& text);
  /// True if something is written at all: an output, or a report that goes to standard output.
  bool has_output() const;

  /// What `execute` will do, several lines.
  std::string explain();
  /// Computes and writes everything. Reports without a file are handed to `print`.
  /// False if a report's verdict is no.
  bool execute(const std::function<void(const std::string&)>& print);
  /// Computes the current value in memory, and writes nothing.
  Value compute();

 private:
  struct Step;
  struct Selection;
  struct Output;
  const Operation& operation(std::string_view name) const;
  Place find(std::string_view reference) const;
  Place argument_input(const std::string& text);
  Arguments take_inputs(Step& step, const Arguments& arguments);
  void parse_option(Step& step, const std::string& name, const std::string& text);
  ValueKind kind(Place place) const;
  std::string label(Place place) const;
  std::string output_name(Place place) const;
  bool select(Step& step, const std::string& name, const std::string& text);
  void keep_within(Step& step, ValueRef source);
  static void check_kept(const Step& step, const ImageInfo& before, const ImageInfo& after);
  Value kept_within(const Step& step, const Value& source);
  void bind(Step& step, bool takes_current);
  void build(std::size_t step);
  ValueRef ref(Place place);
  const Metadata& metadata(Place place) const;
  std::string mismatch(Place got, ValueKind expected) const;
  Place fitting(Place place, const std::string& path) const;
  Place drawn(Place place, const std::string& path);
  Place drawn_by(std::string_view operation, Place place);
  Place picture();
  [[noreturn]] void refuse_report(Place report, const std::string& path) const;
  void check_ending(Place place, const std::string& path) const;
  Value value(Place place);
  Value measured(Place place);
  Target report_target(Place place);
  Value input_value(const Step& step, std::size_t input);
  void choose_float_output(std::size_t step);
  void run_steps();
  bool is_wanted(Place report) const;
  void add_report_targets(std::vector<Target>& targets);
  bool written_whole(const Output& output) const;
  void write_whole(const Output& output);
  std::unique_ptr<ImageSink> make_sink(const Output& output);
  bool print_reports(const std::function<void(const std::string&)>& print);

  Run run_;
  FileOptions files_;
  std::span<const Operation* const> operations_;
  Graph graph_;
  std::vector<Step> steps_;
  std::vector<Output> outputs_;
  std::vector<std::pair<std::string, Place>> names_;
  Place current_;
  int operations_added_ = 0;
};

}  // namespace azulejo
