// Files that are made to be too much: each is refused, or read, at once.

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/io/svg_document.h"
#include "azulejo/io/svg_testing.h"

namespace azulejo {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

/// The message and kind of what reading a file throws.
std::string refusal(const std::string& text, std::int64_t memory = std::int64_t{1} << 30) {
  Run run;
  run.limits.memory_bytes = memory;
  try {
    svg_file(text, run);
  } catch (const Error& error) {
    return std::string(to_string(error.kind())) + ": " + error.what();
  }
  return "none";
}

TEST(SvgHostile, DeepElements) {
  const int levels = SvgDocument::kMostLevels - 1;
  EXPECT_EQ(refusal("<svg>" + repeated("<g>", levels) + repeated("</g>", levels) + "</svg>"), "none");
  EXPECT_EQ(refusal("<svg>" + repeated("<g>", 1'000'000) + repeated("</g>", 1'000'000) + "</svg>"),
            "resource: test.svg: elements in more than 1000 others");
  // By one after the other.
  std::string chain = "<svg><defs>";
  for (int i = 0; i < 3000; ++i) {
    chain += "<g id='g" + std::to_string(i) + "'><use href='#g" + std::to_string(i + 1) + "'/></g>";
  }
  EXPECT_EQ(refusal(chain + "</defs><use href='#g0'/></svg>"), "resource: test.svg: elements in more than 1000 others");
}

TEST(SvgHostile, UsesOfUses) {
  std::string bomb = "<svg><defs><path id='g0' d='M0 0L1 1'/>";
  for (int i = 1; i < 30; ++i) {
    const std::string use = "<use href='#g" + std::to_string(i - 1) + "'/>";
    bomb += "<g id='g" + std::to_string(i) + "'>" + repeated(use, 10) + "</g>";
  }
  EXPECT_EQ(refusal(bomb + "</defs><use href='#g29'/></svg>"),
            "resource: test.svg: its elements are used more than 1000000 times, or 268435456 bytes of them");
}

TEST(SvgHostile, LongThingsManyTimes) {
  // Path data that gives nothing, and counts for no memory.
  const std::string blanks(1 << 16, ' ');
  EXPECT_EQ(refusal("<svg><path id='p' d='" + blanks + "'/>" + repeated("<use href='#p'/>", 10'000) + "</svg>"),
            "resource: test.svg: its elements are used more than 1000000 times, or 268435456 bytes of them");
  const std::string line = "M" + repeated("1 1 ", 20'000);
  EXPECT_EQ(refusal("<svg><path id='p' d='" + line + "'/>" + repeated("<use href='#p'/>", 1000) + "</svg>", 1 << 27),
            "resource: test.svg: more than 134217728 bytes to hold, the limit of memory");
}

TEST(SvgHostile, MoreElementsThanMemory) {
  EXPECT_EQ(refusal("<svg>" + repeated("<a/>", 100'000) + "</svg>", 1 << 23).substr(0, 41),
            "resource: test.svg: its elements may take");
}

TEST(SvgHostile, Entities) {
  std::string bomb = "<!DOCTYPE svg [<!ENTITY a0 'ha'>";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "&a" + std::to_string(i - 1) + ";";
    bomb += "<!ENTITY a" + std::to_string(i) + " '" + before + before + "'>";
  }
  EXPECT_EQ(refusal(bomb + "]><svg><g id='&a29;'/></svg>"), "none") << "they are not expanded";
}

TEST(SvgHostile, SelectorsTimesElements) {
  std::string sheet;
  for (int i = 0; i < 30'000; ++i) sheet += ".a.b" + std::to_string(i) + ".c{}";
  const std::string file = "<svg><style>" + sheet + "</style>" + repeated("<g class='c'/>", 30'000) + "</svg>";
  EXPECT_EQ(refusal(file), "resource: test.svg: its style sheets take more than 200000000 comparisons");
}

TEST(SvgHostile, ClipsOfClips) {
  // Each is measured by the box of what it clips, and so each time another.
  std::string clips;
  for (int i = 0; i < 40; ++i) {
    const std::string rect = "<rect width='1' height='1' clip-path='url(#c" + std::to_string(i + 1) + ")'/>";
    clips += "<clipPath id='c" + std::to_string(i) + "' clipPathUnits='objectBoundingBox'>" + repeated(rect, 10) +
             "</clipPath>";
  }
  EXPECT_EQ(refusal("<svg>" + clips + "<rect width='9' height='9' clip-path='url(#c0)'/></svg>").substr(0, 30),
            "resource: test.svg: its elemen");
}

TEST(SvgHostile, NumbersWithoutEnd) {
  EXPECT_EQ(refusal("<svg width='1e999' viewBox='0 0 1e-30 1e30'><rect width='1e38' height='1e38' "
                    "transform='scale(1e30) scale(1e30)' stroke-width='1e38' stroke='red' rx='1e-38'/></svg>"),
            "none");
  EXPECT_EQ(
      refusal("<svg width='1e38' height='1e38' viewBox='1e38 1e38 1e-38 1e-38'><path d='M1e38 0l3e38 3e38'/></svg>"),
      "none");
}

}  // namespace
}  // namespace azulejo
