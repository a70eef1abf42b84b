#include "azulejo/engine/transform_fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include "azulejo/math/transform2d.h"
#include "azulejo/math/transform3d.h"

namespace azulejo {
namespace {

constexpr Range kCoordinates{-1e9, 1e9};
constexpr Range kFactors{-1e6, 1e6};
constexpr Range kAngles{-1e6, 1e6};
constexpr const char* kAbout = "what the step before leaves where it is, or center; otherwise the origin";

const TransformOptions& read_only(TransformAccess access, const void* options) {
  return access(const_cast<void*>(options));
}

/// Adds a step; what was said of the first one before it came is its.
void append(std::vector<TransformStep>& steps, TransformStep step) {
  if (steps.size() == 1 && steps[0].kind == StepKind::Nothing) {
    step.axis = steps[0].axis;
    step.about = steps[0].about;
    step.about_center = steps[0].about_center;
    steps.clear();
  }
  steps.push_back(std::move(step));
}

void check_range(const Field& field, std::span<const float> numbers) {
  for (const float number : numbers) {
    if (fields::outside(number, field.range)) fields::refuse(field, fields::print(number));
  }
}

Field described(const char* name, const char* help, FieldType type, int components, Range range) {
  Field field;
  field.name = name;
  field.help = help;
  field.type = type;
  field.components = components;
  field.range = range;
  return field;
}

/// A field of which each use is a step. read(step, field, text) takes the text, write(step) gives it back.
template <class Read, class Write>
Field step_field(Field field, StepKind kind, TransformAccess access, Read read, Write write) {
  field.repeated = true;
  const Field known = field;
  field.parse = [=](void* options, std::string_view text) {
    if (text == "none") return;
    TransformStep step;
    step.kind = kind;
    read(step, known, text);
    append(access(options).steps, std::move(step));
  };
  field.print = [=](const void* options) {
    const std::vector<TransformStep>& steps = read_only(access, options).steps;
    const auto last =
        std::find_if(steps.rbegin(), steps.rend(), [&](const TransformStep& each) { return each.kind == kind; });
    return last == steps.rend() ? std::string("none") : write(*last);
  };
  field.check = [=](const void* options) {
    for (const TransformStep& step : read_only(access, options).steps) {
      if (step.kind != kind) continue;
      check_range(known, step.numbers);
      check_range(known, step.matrix.values);
    }
  };
  return field;
}

/// Steps of numbers: a point, of so many coordinates (counts, the most at the end), or a list, of which it is seen later
/// whether it has as many as it takes.
Field numbers_field(Field field, StepKind kind, TransformAccess access, std::vector<std::size_t> counts = {}) {
  return step_field(
      std::move(field), kind, access,
      [counts](TransformStep& step, const Field& known, std::string_view text) {
        for (const std::string_view part : fields::parse_list(known, text))
          step.numbers.push_back(fields::parse_float(known, part));
        if (!counts.empty() && std::ranges::find(counts, step.numbers.size()) == counts.end())
          fields::refuse(known, fmt::format("\"{}\"", text));
      },
      [](const TransformStep& step) { return fields::print_point(step.numbers); });
}

Field step_point(const char* name, const char* help, StepKind kind, TransformAccess access,
                 std::vector<std::size_t> counts) {
  const auto components = static_cast<int>(counts.back());
  return numbers_field(described(name, help, FieldType::Point, components, kCoordinates), kind, access,
                       std::move(counts));
}

Field step_list(const char* name, const char* help, StepKind kind, TransformAccess access) {
  Field field = described(name, help, FieldType::Float, 1, kFactors);
  field.list = true;
  return numbers_field(std::move(field), kind, access);
}

Field angle_field(const char* help, TransformAccess access) {
  Field field = described("rotate_deg", help, FieldType::Float, 1, kAngles);
  field.unit = "deg";
  return numbers_field(std::move(field), StepKind::Rotate, access, {1});
}

Field matrix_field(TransformAccess access, const char* help) {
  return step_field(
      described("matrix", help, FieldType::Grid, 1, kCoordinates), StepKind::Matrix, access,
      [](TransformStep& step, const Field& known, std::string_view text) {
        step.matrix = fields::parse_grid(known, text);
      },
      [](const TransformStep& step) { return fields::print_grid(step.matrix); });
}

/// A point of the step before, or of the first one if there is none yet. center: whether that word is understood
Field point_field(Field field, std::optional<glm::vec3> TransformStep::*point, bool center, TransformAccess access) {
  field.repeated = true;
  const Field known = field;
  const auto components = static_cast<std::size_t>(known.components);
  field.parse = [=](void* options, std::string_view text) {
    if (text == "none") return;
    std::vector<TransformStep>& steps = access(options).steps;
    const bool is_center = center && text == "center";
    glm::vec3 parsed(0);
    if (!is_center) fields::parse_point(known, text, {&parsed.x, components});
    if (steps.empty()) steps.emplace_back();
    steps.back().*point = parsed;
    if (center) steps.back().about_center = is_center;
  };
  field.print = [=](const void* options) {
    const std::vector<TransformStep>& steps = read_only(access, options).steps;
    if (steps.empty() || !(steps.back().*point)) return std::string("none");
    const TransformStep& step = steps.back();
    return center && step.about_center ? std::string("center") : fields::print_point({&(step.*point)->x, components});
  };
  field.check = [=](const void* options) {
    for (const TransformStep& step : read_only(access, options).steps) {
      if (step.*point) check_range(known, {&(step.*point)->x, components});
    }
  };
  return field;
}

/// The field of a member of TransformOptions.
template <class Member>
Field member_field(std::string name, Member TransformOptions::*member, std::string help, TransformAccess access) {
  Field described = field(std::move(name), member, std::move(help));
  described.parse = [access, parse = described.parse](void* options, std::string_view text) {
    parse(&access(options), text);
  };
  described.print = [access, print = described.print](const void* options) {
    return print(&read_only(access, options));
  };
  described.check = [access, check = described.check](const void* options) { check(&read_only(access, options)); };
  return described;
}

void add_common(std::vector<Field>& list, TransformAccess access) {
  list.push_back(member_field("inverse", &TransformOptions::inverse, "undoes it instead", access));
  list.push_back(member_field("convention", &TransformOptions::convention,
                              "what matrices multiply: columns M · p, or rows p · M, whose matrices are transposed",
                              access));
}

double degrees(double radians) { return radians * (180 / std::numbers::pi); }

template <glm::length_t N>
Json numbers_json(const glm::vec<N, double>& numbers) {
  Json list = Json::array();
  for (glm::length_t i = 0; i < N; ++i) list.push(numbers[i]);
  return list;
}

template <glm::length_t N>
Json begun_report(const glm::mat<N, N, double>& m) {
  Json rows = Json::array();
  for (glm::length_t row = 0; row < N; ++row) rows.push(numbers_json(glm::row(m, row)));
  Json json = Json::object();
  json.set("class", enum_names(TransformClass{})[static_cast<std::size_t>(classify(m))])
      .set("mirrored", is_mirroring(m))
      .set("matrix", rows)
      .set("determinant", glm::determinant(m));
  return json;
}

}  // namespace

std::vector<Field> picture_transform_fields(TransformAccess access) {
  std::vector<Field> list{
      step_point("translate", "moves", StepKind::Translate, access, {2}),
      angle_field("turns counter-clockwise as seen", access),
      step_list("scale", "one factor, or those along x,y; negative ones mirror", StepKind::Scale, access),
      step_point("shear", "what x grows by for each unit of y, and y for each of x", StepKind::Shear, access, {2}),
      step_point("reflect", "mirrors at the line in this direction: 1,0 turns upside down", StepKind::Reflect, access,
                 {2}),
      matrix_field(access, "2×2, 2×3 or 3×3 numbers"),
      point_field(described("about", kAbout, FieldType::Point, 2, kCoordinates), &TransformStep::about, true, access)};
  add_common(list, access);
  return list;
}

std::vector<Field> space_transform_fields(TransformAccess access) {
  std::vector<Field> list{
      step_point("translate", "moves; z may be left out", StepKind::Translate, access, {2, 3}),
      angle_field("turns around `axis`, counter-clockwise for those who look against it", access),
      point_field(described("axis", "of the rotation before; otherwise 0,0,1", FieldType::Point, 3, kCoordinates),
                  &TransformStep::axis, false, access),
      step_list("scale", "one factor, or those along x,y,z; negative ones mirror", StepKind::Scale, access),
      step_list("shear", "six: of x by y, x by z, y by x, y by z, z by x, z by y", StepKind::Shear, access),
      step_point("reflect", "mirrors at the plane with this normal", StepKind::Reflect, access, {3}),
      matrix_field(access, "3×3, 3×4 or 4×4 numbers"),
      point_field(described("about", kAbout, FieldType::Point, 3, kCoordinates), &TransformStep::about, true, access)};
  add_common(list, access);
  return list;
}

Report picture_transform_report(const glm::dmat3& m) {
  Report report;
  report.json = begun_report(m);
  if (const std::optional<Decomposition2d> parts = decompose(m)) {
    report.json.set("translation", numbers_json(parts->translation))
        .set("rotation_deg", parts->rotation == 0 ? 0 : -degrees(parts->rotation))
        .set("shear", parts->shear)
        .set("scale", numbers_json(parts->scale));
  }
  return report;
}

Report space_transform_report(const glm::dmat4& m) {
  Report report;
  report.json = begun_report(m);
  if (const std::optional<Decomposition3d> parts = decompose(m)) {
    const glm::dquat& q = parts->rotation;
    const glm::dvec3 axis(q.x, q.y, q.z);
    const double sine = glm::length(axis);
    report.json.set("translation", numbers_json(parts->translation))
        .set("rotation_deg", degrees(2 * std::atan2(sine, q.w)))
        .set("axis", numbers_json(sine > 0 ? axis / sine : glm::dvec3(0, 0, 1)))
        .set("shear", numbers_json(parts->shear))
        .set("scale", numbers_json(parts->scale));
  }
  return report;
}

}  // namespace azulejo
