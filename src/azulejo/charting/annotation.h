#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/charting/annotate.h"

namespace azulejo {

/// What a row of the data is about, on the page.
struct AnnotationPlace {
  glm::vec2 point{0, 0};
  Box2 room;             ///< around the point; empty: a point that gets a mark
  bool painted = false;  ///< its color shows by itself: no mark
};

/// The rows of the data that have a place.
struct Annotation {
  std::string id;
  std::string text;
  std::optional<glm::vec4> color;  ///< of its value
  AnnotationPlace place;
};

/// What the columns of a table say.
class AnnotationTable {
 public:
  AnnotationTable(const CsvTable& data, const AnnotateOptions& options);

  std::size_t rows() const { return data_.rows; }
  bool has_places() const { return x_ != nullptr && y_ != nullptr; }
  bool has_ids() const { return id_ != nullptr; }
  std::string id(std::size_t row) const { return cell(id_, row); }
  std::string text(std::size_t row) const;
  double x(std::size_t row) const { return number(x_, row); }
  double y(std::size_t row) const { return number(y_, row); }
  double z(std::size_t row) const { return z_ != nullptr ? number(z_, row) : 0; }
  std::optional<glm::vec4> color(std::size_t row) const;
  bool has_colors() const { return value_ != nullptr && low_ <= high_; }
  double low() const { return low_; }
  double high() const { return high_; }
  std::string value_name() const { return value_ != nullptr ? value_->name : ""; }

  /// Those rows that have one of both places, where `by_id` knows it, `by_point` else; warns of the others.
  std::vector<Annotation> placed(const std::function<std::optional<AnnotationPlace>(std::size_t row)>& by_point,
                                 const std::function<std::optional<AnnotationPlace>(const std::string& id)>& by_id,
                                 const Run& run) const;

 private:
  static std::string cell(const CsvColumn* column, std::size_t row);
  static double number(const CsvColumn* column, std::size_t row);

  const CsvTable& data_;
  const CsvColumn* id_ = nullptr;
  const CsvColumn* text_ = nullptr;
  const CsvColumn* value_ = nullptr;
  const CsvColumn* x_ = nullptr;
  const CsvColumn* y_ = nullptr;
  const CsvColumn* z_ = nullptr;
  double low_ = 0;
  double high_ = -1;
  std::vector<glm::vec4> colors_;
};

/// Adds leaders, marks, labels and the bar.
void add_annotations(Drawing& drawing, const std::vector<Annotation>& annotations, const AnnotationTable& table,
                     const AnnotateOptions& options, const Run& run);

}  // namespace azulejo
