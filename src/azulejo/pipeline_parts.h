#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/imaging/within.h"
#include "azulejo/pipeline.h"

namespace azulejo {

/// The area that a step is kept within.
struct Pipeline::Selection {
  WithinOptions options;
  Place mask;  ///< step -1: none
};

struct Pipeline::Step {
  const Operation* operation = nullptr;  ///< null: a source
  std::string label;
  std::shared_ptr<void> options;
  std::vector<Place> inputs;
  std::optional<Selection> selection;
  bool lifted = false;  ///< done to each mesh of a scene
  std::shared_ptr<ImageSource> source;
  int vertex = -1;             ///< its node in the graph; -1: not yet, or none
  std::vector<Value> values;   ///< by output, where they are computed
  std::vector<ValueRef> refs;  ///< by output: where its image is in the graph; vertex -1: not yet, or no image
};

struct Pipeline::Output {
  Place place;
  std::string path;
};

/// A value of the chain as a source of the graph.
class ValueSource final : public ImageSource {
 public:
  /// value  an image
  explicit ValueSource(Value value) : value_(std::move(value)) {}
  const ImageInfo& info() const override { return value_.image()->info(); }
  const Metadata& metadata() const override { return value_.image()->metadata(); }
  const Image* image() const override { return value_.image(); }
  std::unique_ptr<RowReader> rows(const Run&) override { return nullptr; }

 private:
  Value value_;
};

}  // namespace azulejo
