#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/image.h"
#include "azulejo/data/scene.h"
#include "azulejo/imaging/pseudo_color.h"
#include "azulejo/io/csv.h"
#include "azulejo/math/color.h"
#include "azulejo/rendering/camera_choice.h"

namespace azulejo {

/// What is written beside what, and how. A row of the data is a label; its columns:
///
/// x, y, z  a place: on the page or in the image; of a scene in the world
/// id       what it is about: a path or group of a drawing, a region of an image, a node of a scene. Counts where there
///          is no place
/// text     what is written; empty: the value, else the id
/// value    a number that becomes a color
///
/// Names of columns are given by the options; where an option is empty, the column of the option's name is taken, if
/// there is one ("id" may also be "name", "text" also "label").
struct AnnotateOptions {
  std::string data = {};  ///< file: CSV; JSON as a list of objects, or as one object of id → text, number or object
  std::string id = {};
  std::string text = {};
  std::string value = {};
  std::string x = {};
  std::string y = {};
  std::string z = {};

  float font_size = 14;  ///< px
  Color color = {0.1F, 0.1F, 0.1F, 1};
  Color halo = {1, 1, 1, 0.85F};  ///< behind texts; transparent: none
  float mark_size = 6;            ///< px, of points; 0: none
  bool labels = true;             ///< texts are written

  ColorMap map = ColorMap::Viridis;
  std::optional<glm::vec2> range = std::nullopt;  ///< values of the first and the last color; nothing: all
  bool bar = true;                                ///< where there are values, a bar says what the colors stand for
  std::string bar_label = {};                     ///< empty: the value's column
};

/// A drawing with labels on its paths and groups: in the middle of what they are about if they fit there, else beside
/// it, with a line that leads there from far away. What has a value is painted in its color, its fill or else its lines.
///
/// Result   the drawing, then a group "annotations" with the groups "leaders", "marks", "labels" and "color-bar"; ids
///          of labels are those of what they are about
/// Place    labels hide neither each other nor other places as long as there is room; earlier rows choose first
/// NaN      a row without a place (its id is nowhere, its numbers are none) is left out, and a warning tells how many
/// Throws   Error(Argument) for columns that aren't there; those of read_csv and of JSON; Error(Data) beyond 100,000 rows
/// Cost     O(paths + rows)
AZULEJO_EXPORT Drawing annotate(const Drawing& drawing, const CsvTable& data, const AnnotateOptions& options = {},
                                const Run& run = {});

/// Labels to be drawn over an image: at pixels, or at regions.
///
/// regions  the image's size; equal numbers but 0 in its first channel are a region (labels; layers of `render`); null: none.
///          A label is at the region's pixel that is nearest to its middle
/// Result   a page of the image's size
AZULEJO_EXPORT Drawing annotate(const Image& image, const Image* regions, const CsvTable& data,
                                const AnnotateOptions& options = {}, const Run& run = {});

/// The same over a picture of a scene, as a camera sees it: at places of the world, or at nodes, by name or number: in
/// the middle of what they and those below them show.
///
/// width, height  of the page: the picture's
AZULEJO_EXPORT Drawing annotate(const Scene& scene, const CameraOptions& camera, int width, int height,
                                const CsvTable& data, const AnnotateOptions& options = {}, const Run& run = {});

/// The rows of a CSV or JSON file, by its ending.
AZULEJO_EXPORT CsvTable read_annotations(const std::string& path, const Run& run = {});

}  // namespace azulejo
