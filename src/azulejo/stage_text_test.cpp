#include "azulejo/stage_text.h"

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

TEST(Stage, IsTakenApart) {
  using Arguments = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(parse_stage("sobel").name, "sobel");
  EXPECT_EQ(parse_stage("gaussian:sigma=2,border=wrap").arguments, (Arguments{{"sigma", "2"}, {"border", "wrap"}}));
  EXPECT_EQ(parse_stage("op:point=1,2,3,next=4").arguments, (Arguments{{"point", "1,2,3"}, {"next", "4"}}));
  EXPECT_EQ(parse_stage("op:layers=color,depth,sizes=1,2").arguments,
            (Arguments{{"layers", "color,depth"}, {"sizes", "1,2"}}));
  EXPECT_EQ(parse_stage("op:background=#ff0000,up=z").arguments, (Arguments{{"background", "#ff0000"}, {"up", "z"}}));
  EXPECT_EQ(parse_stage("op:text='a,b=c',next=\"x y\"").arguments, (Arguments{{"text", "a,b=c"}, {"next", "x y"}}));
  EXPECT_EQ(parse_stage("threshold:invert").arguments, (Arguments{{"invert", "true"}}));
  EXPECT_EQ(parse_stage("op:border-value=1").arguments, (Arguments{{"border_value", "1"}}));
  EXPECT_EQ(parse_stage("op:file=a:b=c").arguments, (Arguments{{"file", "a:b=c"}}));
  EXPECT_THROW(parse_stage("op:text='a"), Error);
  EXPECT_THROW(parse_stage("op:=3"), Error);
  EXPECT_THROW(parse_stage("op:1,2"), Error);
}

}  // namespace
}  // namespace azulejo
