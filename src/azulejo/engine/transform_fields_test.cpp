#include "azulejo/engine/transform_fields.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/math/transform2d.h"
#include "azulejo/math/transform3d.h"

namespace azulejo {
namespace {

TransformOptions& same(void* options) { return *static_cast<TransformOptions*>(options); }

using Words = std::vector<std::pair<std::string, std::string>>;

/// The options that words give, or the error's message in `message`.
TransformOptions parsed(const std::vector<Field>& fields, const Words& words, std::string* message = nullptr) {
  TransformOptions options;
  try {
    for (const auto& [name, text] : words) {
      const auto field = std::ranges::find(fields, name, &Field::name);
      if (field == fields.end()) throw Error(Error::Argument, "no " + name);
      field->parse(&options, text);
    }
    for (const Field& field : fields) field.check(&options);
  } catch (const Error& error) {
    if (message != nullptr) *message = error.what();
  }
  return options;
}

std::string refusal(const Words& words) {
  std::string message = "nothing was thrown";
  parsed(picture_transform_fields(same), words, &message);
  return message;
}

TEST(TransformFields, StepsKeepTheOrderInWhichTheyAreGiven) {
  const TransformOptions options =
      parsed(picture_transform_fields(same),
             {{"translate", "1,2"}, {"rotate_deg", "90"}, {"about", "3,4"}, {"translate", "5,6"}, {"scale", "2"}});
  ASSERT_EQ(options.steps.size(), 4U);
  EXPECT_EQ(options.steps[0].kind, StepKind::Translate);
  EXPECT_FALSE(options.steps[0].about);
  EXPECT_EQ(options.steps[1].about, glm::vec3(3, 4, 0));
  EXPECT_EQ(options.steps[3].numbers, std::vector<float>{2});
  // (0, 0) → (1, 2) → around (3, 4), counter-clockwise as seen → (1, 6) → (6, 12) → twice as far.
  EXPECT_EQ(picture_transform(options, {}) * glm::dvec3(0, 0, 1), glm::dvec3(12, 24, 1));
}

TEST(TransformFields, WhatIsSaidBeforeAllStepsIsOfTheFirst) {
  const std::vector<Field> fields = space_transform_fields(same);
  const TransformOptions options =
      parsed(fields, {{"axis", "0,1,0"}, {"about", "center"}, {"rotate_deg", "90"}, {"translate", "0,0"}});
  ASSERT_EQ(options.steps.size(), 2U);
  EXPECT_EQ(options.steps[0].kind, StepKind::Rotate);
  EXPECT_EQ(options.steps[0].axis, glm::vec3(0, 1, 0));
  EXPECT_TRUE(options.steps[0].about_center);
  EXPECT_FALSE(options.steps[1].about_center);
  EXPECT_EQ(space_transform(options, {1, 1, 1}) * glm::dvec4(1, 1, 2, 1), glm::dvec4(2, 1, 1, 1));
  const TransformOptions nothing = parsed(fields, {{"about", "1,2,3"}, {"translate", "none"}});
  EXPECT_EQ(space_transform(nothing, {}), glm::dmat4(1));
}

TEST(TransformFields, SayWhatIsWrong) {
  EXPECT_EQ(refusal({{"translate", "1"}}),
            "translate: \"1\", expected x,y from -1000000000 to 1000000000, or none; once or more often");
  EXPECT_NE(refusal({{"about", "middle"}}).find("about: \"middle\""), std::string::npos);
  EXPECT_NE(refusal({{"rotate_deg", "1,2"}}).find("rotate_deg: \"1,2\""), std::string::npos);
  EXPECT_NE(refusal({{"matrix", "1,2/3"}}).find("matrix"), std::string::npos);
  EXPECT_NE(refusal({{"scale", "1e9"}}).find("scale: 1e9"), std::string::npos);
  EXPECT_EQ(refusal({{"scale", "1,2,3"}}), "nothing was thrown") << "seen when the matrix is made";
}

TEST(TransformFields, ReportsTellWhatItIs) {
  const TransformOptions options =
      parsed(picture_transform_fields(same), {{"scale", "2"}, {"rotate_deg", "30"}, {"translate", "3,4"}});
  const Json json = picture_transform_report(picture_transform(options, {})).json;
  EXPECT_EQ(json["class"].text(), "similarity");
  EXPECT_FALSE(json["mirrored"].truth(true));
  EXPECT_NEAR(json["rotation_deg"].number(), 30, 1e-12);
  EXPECT_NEAR(json["scale"][1].number(), 2, 1e-12);
  EXPECT_NEAR(json["translation"][0].number(), 3, 1e-12);
  EXPECT_NEAR(json["determinant"].number(), 4, 1e-12);
  EXPECT_EQ(json["matrix"][0][2].number(), 3);
  const Json turned = space_transform_report(Rotation3d(turn_of_degrees(90), {0, 1, 0}).matrix()).json;
  EXPECT_EQ(turned["class"].text(), "rigid");
  EXPECT_NEAR(turned["rotation_deg"].number(), 90, 1e-12);
  EXPECT_NEAR(turned["axis"][1].number(), 1, 1e-12);
  EXPECT_FALSE(space_transform_report(Scaling3d{{1, 0, 1}, {}}.matrix()).json.has("scale")) << "singular";
}

}  // namespace
}  // namespace azulejo
