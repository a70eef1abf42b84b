#include "azulejo/core/json.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

TEST(Json, WritesFloatsWithTheirShortestDigits) {
  EXPECT_EQ(Json(0.1F).dump(-1), "0.1");
  EXPECT_EQ(Json(0.1).dump(-1), "0.1");
  EXPECT_EQ(Json(16777216.0F).dump(-1), "16777216.0");
  EXPECT_EQ(Json(1e-7F).dump(-1), "1e-07");
}

TEST(Json, WritesWhatIsNoNumberAsNull) {
  EXPECT_EQ(Json(std::nanf("")).dump(-1), "null");
  EXPECT_EQ(Json(std::numeric_limits<double>::infinity()).dump(-1), "null");
}

TEST(Json, KeepsTheOrderOfMembers) {
  Json json = Json::object();
  json.set("zebra", 1).set("ant", true).set("list", Json::array().push("a").push(2.5));
  EXPECT_EQ(json.dump(-1), R"({"zebra":1,"ant":true,"list":["a",2.5]})");
  EXPECT_EQ(json.keys(), (std::vector<std::string>{"zebra", "ant", "list"}));
  EXPECT_EQ(json["list"][1].number(), 2.5);
  EXPECT_EQ(json["list"][std::size_t{7}].number(-1), -1);
  EXPECT_TRUE(json["none"].is_null());
}

TEST(Json, ReadsBackWhatItWrote) {
  const std::string text = R"({"a":[1,-2,18446744073709551615],"b":{"c":"\u00e9\n"},"d":null})";
  EXPECT_EQ(Json::parse(text, "text").dump(-1),
            "{\"a\":[1,-2,18446744073709551615],\"b\":{\"c\":\"é\\n\"},\"d\":null}");
}

TEST(Json, RefusesWhatIsNotJson) {
  for (const char* text : {"", "{", "[1,]", "nul", "{\"a\":1} x", "\xff", "1e999"}) {
    try {
      Json::parse(text, "file.json");
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Data);
      EXPECT_TRUE(std::string(error.what()).starts_with("file.json: ")) << error.what();
    }
  }
}

TEST(Json, SurvivesBytesThatAreNotText) {
  EXPECT_EQ(Json("a\xff"
                 "b")
                .dump(-1),
            "\"a\xEF\xBF\xBD"
            "b\"");
}

}  // namespace
}  // namespace azulejo
