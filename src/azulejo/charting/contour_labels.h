#pragma once

#include <string>
#include <vector>

#include "azulejo/charting/plot.h"

namespace azulejo {

/// Numbers on contours: one on each line that is long enough, where the line is straightest, none over another.
class ContourLabels {
 public:
  explicit ContourLabels(Plot& plot) : plot_(plot) {}
  /// path  lines on the page
  void add(const Path& path, float level);
  void draw();

 private:
  struct Label {
    std::string text;
    glm::vec2 place;
    float angle = 0;
    float radius = 0;  ///< no other label is nearer
  };
  void add_line(const std::vector<glm::vec2>& points, const std::string& text);
  bool is_free(const glm::vec2& place, float radius) const;

  Plot& plot_;
  std::vector<Label> labels_;
};

}  // namespace azulejo
