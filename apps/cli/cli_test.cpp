// Runs the command itself: what a user types, sees and gets.
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "azulejo/core/json.h"
#include "azulejo/io/image_io.h"
#include "azulejo/operations.h"
#include "cli_testing.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

TEST_F(Cli, RunsOneOperationAndAChain) {
  make_ramp("a.png");
  EXPECT_EQ(run({"grayscale", "a.png", "-o", "gray.png"}).status, 0);
  EXPECT_EQ(read_image(path("gray.png")).channels(), 1);
  EXPECT_EQ(run({"run", "a.png", "grayscale", "gaussian:sigma=1.5", "threshold:level=0.4", "-o", "mask.png"}).status,
            0);
  const Image mask = read_image(path("mask.png"));
  for (int x = 0; x < mask.width(); ++x)
    EXPECT_TRUE(mask.view<std::uint8_t>()(x, 3) == 0 || mask.view<std::uint8_t>()(x, 3) == 255);
}

TEST_F(Cli, AChartIsOfAnImageOrOfATable) {
  make_ramp("a.png");
  EXPECT_EQ(run({"chart", "a.png", "-o", "a.svg"}).status, 0);
  std::ofstream(path("t.csv")) << "x,y\n1,2\n3,4\n";
  EXPECT_EQ(run({"chart", "--data", "t.csv", "--x", "x", "-o", "t.svg"}).status, 0);
  EXPECT_EQ(run({"run", "chart:data=t.csv,x=x", "-o", "u.svg"}).status, 0);
  EXPECT_EQ(read_file(path("t.svg")), read_file(path("u.svg")));
  EXPECT_NE(run({"chart", "-o", "b.svg"}).err.find("data: none"), std::string::npos);
  EXPECT_NE(run({"chart", "a.png", "--data", "t.csv", "-o", "b.svg"}).err.find("beside an image"), std::string::npos);
}

TEST_F(Cli, KeepsAnOperationWithinAnArea) {
  make_ramp("a.png");
  Image mask(32, 24, 1);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) mask.view<std::uint8_t>()(x, y) = x < 16 ? 7 : 0;
  }
  write_image(mask, path("regions.png"));
  const Image source = read_image(path("a.png"));
  ASSERT_EQ(run({"gaussian", "a.png", "--sigma", "3", "-o", "soft.png"}).status, 0);
  const Image soft = read_image(path("soft.png"));
  const auto expect = [&](const std::string& name, auto inside) {
    const Image result = read_image(path(name));
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) {
        const Image& from = inside(x, y) ? soft : source;
        ASSERT_EQ(result.view<std::uint8_t>()(x, y, 1), from.view<std::uint8_t>()(x, y, 1)) << name << x << ' ' << y;
      }
    }
  };
  ASSERT_EQ(run({"gaussian", "a.png", "--sigma", "3", "--within", "5,4,20,10", "-o", "rect.png"}).status, 0);
  expect("rect.png", [](int x, int y) { return x >= 5 && x < 25 && y >= 4 && y < 14; });
  ASSERT_EQ(run({"run", "a.png", "gaussian:sigma=3,within=regions.png:7", "-o", "label.png"}).status, 0);
  expect("label.png", [](int x, int) { return x < 16; });
  // Of an operation that sees the whole image at once, too.
  ASSERT_EQ(run({"frequency_filter", "a.png", "-o", "low.png"}).status, 0);
  ASSERT_EQ(run({"run", "a.png", "as:photo", "threshold:level=0", "@photo", "frequency_filter:within=regions.png:7",
                 "-o", "part.png"})
                .status,
            0);
  const Image low = read_image(path("low.png"));
  const Image part = read_image(path("part.png"));
  for (int x = 0; x < 32; ++x) {
    EXPECT_EQ(part.view<std::uint8_t>()(x, 9), (x < 16 ? low : source).view<std::uint8_t>()(x, 9)) << x;
  }
  const std::string area = "as:photo threshold:level=0 grayscale as:all @photo gaussian:sigma=3,within=@all,feather=2";
  std::vector<std::string> words{"run", "a.png"};
  std::istringstream stages(area);
  words.insert(words.end(), std::istream_iterator<std::string>(stages), {});
  words.insert(words.end(), {"-o", "all.png"});
  ASSERT_EQ(run(words).status, 0);
  const std::map<std::vector<std::string>, std::string> wrong = {
      {{"grayscale", "a.png", "--within", "1,2,3,4", "-o", "b.png"}, "grayscale: within: it makes 32×24, 1 channel"},
      {{"gaussian", "a.png", "--within", "no.png", "-o", "b.png"}, "no.png"},
      {{"gaussian", "a.png", "--within", "1,2,3,-4", "-o", "b.png"}, "gaussian: within: rect: size"},
      {{"gaussian", "a.png", "--within", "1,2,3", "-o", "b.png"}, "within: \"1,2,3\", expected x,y,width,height"},
      {{"gaussian", "a.png", "--within", "", "-o", "b.png"}, "within: \"\", expected x,y,width,height"},
      {{"gaussian", "a.png", "--feather", "4", "-o", "b.png"}, "feather: without an area, expected within"},
      {{"primitive", "--within", "1,2,3,4", "-o", "b.obj"}, "--within: no such option"},
  };
  for (const auto& [call, message] : wrong) {
    const Outcome outcome = run(call);
    EXPECT_NE(outcome.status, 0) << message;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
}

TEST_F(Cli, CompareSaysHowFarApartAndExitsWithTheVerdict) {
  make_ramp("a.png");
  Image image = read_image(path("a.png"));
  image.view<std::uint8_t>()(3, 2, 1) ^= 0x10;
  write_image(image, path("b.png"));
  const Outcome said = run({"compare", "a.png", "b.png", "-o", "difference=d.png"});
  EXPECT_EQ(said.status, 0);
  const Json report = Json::parse(said.out, "report");
  EXPECT_EQ(report["operation"].text(), "compare");
  EXPECT_EQ(report["differing_pixels"].number(), 1);
  EXPECT_NEAR(report["maximum"].number(), 16.0 / 255, 1e-6);
  EXPECT_EQ(read_image(path("d.png")).view<std::uint16_t>()(3, 2, 1), 16 * 257);
  EXPECT_EQ(run({"compare", "a.png", "b.png", "--at-most", "0.07"}).status, 0);
  EXPECT_EQ(run({"compare", "a.png", "b.png", "--at-most", "0.06"}).status, 3);
  EXPECT_EQ(run({"run", "a.png", "b.png", "compare:metric=mean,at_most=0.00001"}).status, 3);
  EXPECT_EQ(run({"compare", "a.png", "a.png", "--metric", "psnr", "--at-least", "99"}).status, 0);
  EXPECT_EQ(run({"compare", "a.png", "-o", "difference=d.png"}).status, 2);
}

TEST_F(Cli, ExposureIsJudged) {
  Image dark(64, 64, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) dark.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(x / 2);
  }
  write_image(dark, path("dark.png"));
  const Outcome as_it_is = run({"exposure", "dark.png", "--stops", "0", "--verdict"});
  EXPECT_EQ(as_it_is.status, 3);
  const Json report = Json::parse(as_it_is.out, "report");
  EXPECT_EQ(report["after"]["exposure"].text(), "under");
  EXPECT_FALSE(report.has("before"));
  const Outcome corrected = run({"exposure", "dark.png", "-o", "good.png", "--verdict"});
  EXPECT_EQ(corrected.status, 0) << corrected.out;
  const Json both = Json::parse(corrected.out, "report");
  EXPECT_EQ(both["before"]["exposure"].text(), "under");
  EXPECT_EQ(both["after"]["exposure"].text(), "good");
  EXPECT_EQ(run({"exposure", "dark.png", "-o", "good.png"}).out, "");
}

TEST_F(Cli, FilesInFrontOfAStageAreItsInputs) {
  make_ramp("a.png");
  make_ramp("b.png");
  EXPECT_EQ(run({"run", "a.png", "b.png", "blend:amount=0.5", "threshold", "-o", "both.png"}).status, 0);
  EXPECT_EQ(read_image(path("both.png")).channels(), 3);
  EXPECT_NE(run({"run", "a.png", "b.png", "threshold", "-o", "c.png"}).err.find("2 inputs, expected one"),
            std::string::npos);
}

TEST_F(Cli, AFileGetsTheFirstOutputThatItHolds) {
  make_ramp("a.png");
  const Outcome drawn = run({"histogram", "a.png", "-o", "b.png"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("\"histogram\""), std::string::npos);  // the report goes where it goes without files
  EXPECT_GT(read_image(path("b.png")).width(), 100);
  EXPECT_EQ(run({"histogram", "a.png", "-o", "b.json", "-o", "c.png"}).out, "");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "b.json", "b.png", "c.png", "err.txt", "out.txt"}));
}

TEST_F(Cli, SaysInOneLineWhatIsWrong) {
  make_ramp("a.png");
  const std::map<std::vector<std::string>, std::pair<int, std::string>> wrong = {
      {{"gausian", "a.png"}, {2, "did you mean gaussian?"}},
      {{"gaussian", "a.png", "--sgma", "2", "-o", "b.png"}, {2, "did you mean --sigma?"}},
      {{"gaussian", "a.png", "--sigma", "x", "-o", "b.png"}, {2, "sigma: \"x\", expected a number from 0"}},
      {{"gaussian", "a.png", "--sigma", "-1", "-o", "b.png"}, {2, "expected a number from 0"}},
      {{"gaussian", "a.png"}, {2, "-o: missing"}},
      {{"gaussian", "-o", "b.png"}, {2, "input missing"}},
      {{"gaussian", "none.png", "-o", "b.png"}, {1, "none.png"}},
      {{"gaussian", "a.png", "-o", "b.xyz"}, {2, "can't tell the image format"}},
      {{"gaussian", "a.png", "a.png", "-o", "b.png"}, {2, "2 inputs, expected 1"}},
      {{"test_pattern", "a.png", "-o", "b.png"}, {2, "1 inputs, expected 0"}},
      {{"histogram", "a.png", "-o", "report=b.png"}, {2, "-o chart=b.png"}},
      {{"run", "a.png", "grayscale", "sobl", "-o", "b.png"}, {2, "sobl: no such operation"}},
      {{"run", "a.png", "treshold", "-o", "b.png"}, {2, "did you mean threshold?"}},
      {{"run", "a.png", "threshold:level=7", "-o", "b.png"}, {2, "level: 7, expected a number from 0 to 1"}},
      {{"threshold", "a.png", "-o", "b.png", "--threads", "many"}, {2, "--threads: \"many\", expected a whole number"}},
      {{"threshold", "a.png", "-o", "b.png", "--max-pixels", "100"}, {1, "the limit is 100"}},
      {{"threshold", "a.png", "-o", "/no/such/folder/b.png"}, {1, "/no/such/folder"}},
      {{"info"}, {2, "file missing"}},
      {{"ops", "soble"}, {2, "no such operation"}},
      {{"completion", "fish"}, {2, "expected bash or zsh"}},
  };
  for (const auto& [words, expected] : wrong) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, expected.first) << outcome.err;
    EXPECT_NE(outcome.err.find(expected.second), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("azulejo: ")) << outcome.err;
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "err.txt", "out.txt"}));
}

TEST_F(Cli, StepsKeepTheOrderOfTheCommandLine) {
  make_ramp("a.png");
  const std::string steps = "transform:translate=3,1,scale=2,about=center,translate=0,5,rotate_deg=90,filter=bilinear";
  EXPECT_EQ(run({"run", "a.png", steps, "-o", "chain.png"}).status, 0);
  const Outcome flags = run({"transform", "--translate", "3,1", "a.png", "--scale=2", "--about", "center",
                             "--translate", "0,5", "-o", "flags.png", "--filter", "bilinear", "--rotate_deg", "90"});
  EXPECT_EQ(flags.status, 0) << flags.err;
  EXPECT_EQ(read_file(path("chain.png")), read_file(path("flags.png")));
  EXPECT_EQ(run({"transform", "a.png", "--scale", "2", "--translate", "3,1", "--translate", "0,5", "--rotate-deg", "90",
                 "--filter", "bilinear", "-o", "other.png"})
                .status,
            0);
  EXPECT_NE(read_file(path("chain.png")), read_file(path("other.png")));
  const Outcome axis = run({"transform", "a.png", "--rotate-deg", "9", "--axis", "0,0,1", "-o", "b.png"});
  EXPECT_EQ(axis.status, 2);
  EXPECT_NE(axis.err.find("transform: no option \"axis\""), std::string::npos) << axis.err;
}

TEST_F(Cli, TellsItsOperations) {
  const Outcome list = run({"ops", "--json"});
  EXPECT_EQ(list.status, 0);
  const Json json = Json::parse(list.out, "ops");
  EXPECT_EQ(json["operations"].size(), operations().size());
  for (const Operation* each : operations()) {
    const Outcome help = run({each->name, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.out, run({"ops", each->name}).out);
    EXPECT_NE(help.out.find(each->summary), std::string::npos);
    EXPECT_NE(run({"manual"}).out.find(each->name), std::string::npos);
    EXPECT_NE(run({"completion", "bash"}).out.find(each->name), std::string::npos);
    for (const VariantField& option : fields_of(*each))
      EXPECT_NE(help.out.find(option.field->help), std::string::npos) << option.field->name;
  }
  EXPECT_EQ(run({"--version"}).out, "azulejo " AZULEJO_VERSION "\n");
  EXPECT_NE(run({}).out.find("Operations"), std::string::npos);
}

TEST_F(Cli, CompletionAndManualAreWellFormed) {
  std::ofstream(path("completion")) << run({"completion", "bash"}).out;
  EXPECT_EQ(std::system(("bash -n " + path("completion")).c_str()), 0);
  const std::string script = "source " + path("completion") +
                             "; COMP_WORDS=(azulejo gaussian --bor); COMP_CWORD=2; _azulejo; echo ${COMPREPLY[*]}; "
                             "COMP_WORDS=(azulejo gaussian --border mi); COMP_CWORD=3; _azulejo; echo ${COMPREPLY[*]}";
  EXPECT_EQ(std::system(("bash -c '" + script + "' > " + path("completed")).c_str()), 0);
  EXPECT_EQ(read_file(path("completed")), "--border --border-value\nmirror\n");
}

TEST_F(Cli, UsesStandardStreams) {
  make_ramp("a.png");
  const Outcome piped = run({"threshold", "-", "-o", "-"}, path("a.png"));
  EXPECT_EQ(piped.status, 0) << piped.err;
  ASSERT_GT(piped.out.size(), 8U);
  EXPECT_EQ(piped.out.substr(1, 3), "PNG");
  run({"threshold", "a.png", "-o", "b.png"});
  EXPECT_EQ(piped.out, read_file(path("b.png")));
}

TEST_F(Cli, InfoTellsWhatAFileHolds) {
  make_ramp("a.png");
  const Json json = Json::parse(run({"info", "a.png", "--json"}).out, "info");
  EXPECT_EQ(json["format"].text(), "png");
  EXPECT_EQ(json["width"].number(), 32);
  EXPECT_EQ(json["height"].number(), 24);
  EXPECT_EQ(json["channels"].number(), 3);
  std::ofstream(path("bad.png")) << "no image";
  const Outcome both = run({"info", "bad.png", "a.png"});
  EXPECT_EQ(both.status, 1);
  EXPECT_NE(both.err.find("bad.png"), std::string::npos);
  EXPECT_NE(both.out.find("32×24"), std::string::npos);
}

TEST_F(Cli, ExplainDoesNothing) {
  make_ramp("a.png");
  const Outcome outcome =
      run({"run", "a.png", "grayscale", "gaussian:sigma=30", "threshold", "-o", "b.png", "--explain"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("1-grayscale is kept whole"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("pass 2: 2-gaussian + 3-threshold"), std::string::npos) << outcome.out;
  EXPECT_FALSE(fs::exists(path("b.png")));
}

TEST_F(Cli, WritesStages) {
  make_ramp("a.png");
  EXPECT_EQ(run({"run", "a.png", "grayscale", "equalize", "-o", "b.png", "--stages", "steps"}).status, 0);
  const Json list = Json::parse(read_file(path("steps/stages.json")), "stages");
  ASSERT_GE(list.size(), 4U);
  EXPECT_EQ(list[std::size_t{0}]["file"].text(), "1-grayscale-gray.png");
  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_TRUE(fs::exists(path("steps/" + list[i]["file"].text()))) << i;
}

TEST_F(Cli, StrictMakesWarningsErrors) {
  Image image(8, 8, 1, PixelType::F32);
  for (int y = 0; y < 8; ++y) std::fill_n(image.view<float>().row(y), 8, 2.0F);
  write_image(image, path("bright.pfm"));
  const Outcome warned = run({"run", "bright.pfm", "gaussian:sigma=0", "-o", "a.png"});
  EXPECT_EQ(warned.status, 0);
  EXPECT_NE(warned.err.find("warning"), std::string::npos);
  EXPECT_EQ(run({"run", "bright.pfm", "gaussian:sigma=0", "-o", "b.png", "--quiet"}).err, "");
  EXPECT_EQ(run({"run", "bright.pfm", "gaussian:sigma=0", "-o", "c.png", "--strict"}).status, 1);
  EXPECT_FALSE(fs::exists(path("c.png")));
}

std::map<std::string, fs::file_time_type> times(const std::string& folder) {
  std::map<std::string, fs::file_time_type> all;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") all[entry.path().filename().string()] = entry.last_write_time();
  }
  return all;
}

TEST_F(Cli, BatchDoesWhatIsNotDoneYet) {
  fs::create_directories(path("in"));
  std::vector<std::string> words{"gaussian"};
  for (const char* name : {"in/a.png", "in/b.png", "in/c.png"}) {
    make_ramp(name);
    words.emplace_back(name);
  }
  words.insert(words.end(), {"-o", "out/{name}.png", "--sigma", "2"});
  Outcome first = run(words);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.err.find("3 done, 0 done before, 0 failed, 3 in all"), std::string::npos) << first.err;
  const auto before = times(path("out"));
  EXPECT_EQ(before.size(), 3U);

  EXPECT_NE(run(words).err.find("0 done, 3 done before"), std::string::npos);
  EXPECT_EQ(times(path("out")), before);

  make_ramp("in/b.png", 40, 40);  // another input
  fs::remove(path("out/c.png"));  // a lost result
  EXPECT_NE(run(words).err.find("2 done, 1 done before"), std::string::npos);
  EXPECT_EQ(read_image(path("out/b.png")).width(), 40);

  words.back() = "3";  // another command
  EXPECT_NE(run(words).err.find("3 done, 0 done before"), std::string::npos);
  words.push_back("--force");
  EXPECT_NE(run(words).err.find("3 done, 0 done before"), std::string::npos);
}

TEST_F(Cli, BatchGoesOnAfterAFailure) {
  make_ramp("a.png");
  make_ramp("c.png");
  std::ofstream(path("b.png")) << "no image";
  const Outcome outcome = run({"run", "a.png", "b.png", "c.png", "grayscale", "-o", "out/{name}.png"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("2 done, 0 done before, 1 failed, 3 in all"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("b.png"), std::string::npos);
  EXPECT_TRUE(fs::exists(path("out/a.png")));
  EXPECT_TRUE(fs::exists(path("out/c.png")));
  EXPECT_FALSE(fs::exists(path("out/b.png")));
}

TEST_F(Cli, BatchRefusesResultsThatCollide) {
  fs::create_directories(path("x"));
  make_ramp("a.png");
  make_ramp("x/a.png");
  EXPECT_EQ(run({"grayscale", "a.png", "x/a.png", "-o", "out/{name}.png"}).status, 2);
  EXPECT_EQ(run({"blend", "a.png", "--other", "x/a.png", "-o", "out/{name}.png"}).status, 0);
}

TEST_F(Cli, AKilledBatchGoesOnWhereItStopped) {
  std::vector<std::string> words{"gaussian"};
  for (int i = 0; i < 12; ++i) {
    const std::string name = "in" + std::to_string(i) + ".png";
    make_ramp(name, 400, 400);
    words.push_back(name);
  }
  words.insert(words.end(), {"-o", "out/{name}.png", "--sigma", "15"});
  int kills = 0;
  std::map<std::string, fs::file_time_type> finished;
  for (int wait_ms = 5; kills < 20; wait_ms += 10) {
    const pid_t child = start(words);
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    const bool killed = kill(child, SIGKILL) == 0;
    if (wait(child).status == 0) break;
    kills += killed ? 1 : 0;
    if (!fs::exists(path("out"))) continue;
    const auto now = times(path("out"));
    for (const auto& [name, time] : finished) EXPECT_EQ(now.at(name), time) << name << " was done twice";
    for (const auto& [name, time] : now) EXPECT_NO_THROW(read_image(path("out/" + name))) << name << " is half-written";
    finished = now;
  }
  EXPECT_GT(kills, 0);
  const Outcome last = run(words);
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_EQ(times(path("out")).size(), 12U);
}

/// A house: a box with a tip to the right of its front.
constexpr const char* kHouse =
    "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv 0.9 2 0.9\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 1 5 7 3\nf 2 4 8 6\nf 3 7 9\nf 7 8 9\nf 8 4 9\nf 4 3 9\n";

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const std::vector<std::string> kSmall = {"--width", "40", "--height", "30", "--antialias", "1"};

TEST_F(Cli, RendersAModelWithItsLayersAndReports) {
  std::ofstream(path("house.obj")) << kHouse;
  const Outcome plain = run(with({"render", "house.obj", "-o", "a.png"}, kSmall));
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_EQ(plain.out, "") << "reports are printed on request only";
  EXPECT_EQ(plain.err, "");
  const Outcome all = run(with({"render", "house.obj", "-o", "b.png", "-o", "camera=b.json", "-o", "depth=b.exr",
                                "--statistics", "--background", "white"},
                               kSmall));
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(all.err, "");
  EXPECT_EQ(Json::parse(all.out, "statistics")["faces_in"].number(), 14);
  EXPECT_EQ(Json::parse(read_file(path("b.json")), "camera")["width"].number(), 40);
  EXPECT_EQ(read_image(path("b.exr")).channels(), 1);
  EXPECT_EQ(read_image(path("b.png")).view<std::uint8_t>()(0, 0, 0), 255);
  // --output is a path or what the color is made of.
  EXPECT_EQ(run(with({"render", "house.obj", "--output", "c.png", "--output", "display16"}, kSmall)).status, 0);
  EXPECT_EQ(read_image(path("c.png")).type(), PixelType::U16);
  EXPECT_EQ(run(with({"run", "house.obj", "render:width=40,height=30", "grayscale", "-o", "d.png"}, {})).status, 0);
  EXPECT_EQ(read_image(path("d.png")).width(), 40);
}

TEST_F(Cli, ATurntableGoesAroundAndGoesOn) {
  std::ofstream(path("house.obj")) << kHouse;
  const auto words = with({"turntable", "house.obj", "-o", "t/{frame:03}.png", "-o", "camera=t/{frame}.json",
                           "--frames", "4", "--azimuth-deg", "0", "--elevation-deg", "10"},
                          kSmall);
  Outcome outcome = run(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("4 done, 0 done before"), std::string::npos) << outcome.err;
  double distance[4] = {};
  double side[4] = {};
  for (std::size_t i = 0; i < 4; ++i) {
    const Json camera = Json::parse(read_file(path("t/" + std::to_string(i) + ".json")), "camera");
    const Json matrix = camera["opengl"]["world_from_camera"];
    side[i] = matrix[std::size_t{0}][std::size_t{3}].number();
    distance[i] = std::hypot(side[i], matrix[std::size_t{1}][std::size_t{3}].number() - 0.5,
                             matrix[std::size_t{2}][std::size_t{3}].number());
    EXPECT_NEAR(distance[i], distance[0], 1e-4);
  }
  EXPECT_NEAR(side[0], 0, 1e-4);
  EXPECT_NEAR(side[1], distance[0] * std::cos(10 * 3.14159265 / 180), 1e-3) << "from the right";
  EXPECT_NEAR(side[3], -side[1], 1e-4);
  // A frame is what render draws from there.
  const Json camera = Json::parse(read_file(path("t/1.json")), "camera");
  EXPECT_EQ(run(with({"render", "house.obj", "-o", "one.png", "--azimuth-deg", "90", "--elevation-deg", "10",
                      "--target", "0,0.5,0", "--distance", fmt::format("{}", static_cast<float>(distance[1]))},
                     kSmall))
                .status,
            0);
  const Image one = read_image(path("one.png"));
  const Image frame = read_image(path("t/001.png"));
  int other = 0;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x)
      other += one.view<std::uint8_t>()(x, y, 3) != frame.view<std::uint8_t>()(x, y, 3) ? 1 : 0;
  }
  EXPECT_LE(other, 2) << "the distance in the camera file is rounded";

  const auto before = times(path("t"));
  EXPECT_NE(run(words).err.find("0 done, 4 done before"), std::string::npos);
  EXPECT_EQ(times(path("t")), before);
  fs::remove(path("t/2.json"));
  EXPECT_NE(run(words).err.find("1 done, 3 done before"), std::string::npos);
}

TEST_F(Cli, ViewsAreSeeded) {
  std::ofstream(path("house.obj")) << kHouse;
  const auto views = [&](const std::string& seed, const std::string& to) {
    const Outcome outcome =
        run(with({"render", "house.obj", "-o", to + "/{frame:02}.png", "--views", "5", "--seed", seed}, kSmall));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  };
  views("1", "a");
  views("1", "b");
  views("2", "c");
  int same = 0;
  for (int i = 0; i < 5; ++i) {
    const std::string name = "/0" + std::to_string(i) + ".png";
    EXPECT_EQ(read_file(path("a" + name)), read_file(path("b" + name)));
    same += read_file(path("a" + name)) == read_file(path("c" + name)) ? 1 : 0;
  }
  EXPECT_LT(same, 2);
}

TEST_F(Cli, FramesOfAModelThatStandsStillGoAroundIt) {
  std::ofstream(path("house.obj")) << kHouse;
  EXPECT_EQ(run(with({"render", "house.obj", "-o", "r{frame}.png", "--frames", "3"}, kSmall)).status, 0);
  EXPECT_EQ(run(with({"turntable", "house.obj", "-o", "t{frame}.png", "--frames", "3"}, kSmall)).status, 0);
  for (const char* number : {"0", "1", "2"}) {
    EXPECT_EQ(read_file(path(std::string("r") + number + ".png")), read_file(path(std::string("t") + number + ".png")));
  }
}

TEST_F(Cli, WrongSequencesAreRefusedInOneLine) {
  std::ofstream(path("house.obj")) << kHouse;
  make_ramp("a.png");
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {{"turntable", "house.obj", "-o", "a.png"}, "expected {frame}"},
      {{"turntable", "house.obj"}, "-o: missing"},
      {{"turntable", "-o", "{frame}.png"}, "input missing"},
      {{"turntable", "house.obj", "-o", "{frame:x}.png"}, "expected {frame} or {frame:04}"},
      {{"turntable", "house.obj", "-o", "{frame}.png", "--position", "1,2,3"}, "--position"},
      {{"render", "house.obj", "-o", "{frame}.png"}, "expected --frames or --views"},
      {{"render", "house.obj", "-o", "{frame}.png", "--views", "3", "--view", "top"}, "--view"},
      {{"render", "house.obj", "-o", "{frame}.png", "--views", "3", "--frames", "3"}, "expected one"},
      {{"render", "house.obj", "-o", "{frame}.png", "--frames", "3", "--camera", "x"}, "no camera"},
      {{"render", "house.obj", "-o", "{frame}.png", "--frames", "3", "--zoom", "0"}, "zoom"},
      {{"gaussian", "a.png", "-o", "{frame}.png", "--frames", "3"}, "for render and turntable"},
      {{"render", "house.obj", "house.obj", "-o", "{frame}.png", "--frames", "2"}, "would be written from"},
      {{"render", "house.obj", "-o", "a.png", "--width", "0"}, "width"},
      {{"render", "house.obj", "-o", "a.png", "--camera", "0"}, "no camera"},
  };
  for (const auto& [words, expected] : wrong) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  const Outcome huge = run({"render", "house.obj", "-o", "b.png", "--width", "65536", "--height", "65536"});
  EXPECT_EQ(huge.status, 1);
  EXPECT_NE(huge.err.find("limit"), std::string::npos) << huge.err;
}

TEST_F(Cli, InterruptingLeavesNothingHalfWritten) {
  make_ramp("a.png", 3000, 3000);
  std::ofstream(path("b.png")) << "was here";
  const std::size_t before = files().size();
  const pid_t child = start({"gaussian", "a.png", "--sigma", "400", "-o", "b.png"});
  // The result's temporary file says that the work has begun.
  for (int i = 0; i < 3000 && files().size() < before + 3; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Outcome outcome = wait(child);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(outcome.err, "azulejo: cancelled\n");
  EXPECT_EQ(read_file(path("b.png")), "was here");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "b.png", "err.txt", "out.txt"}));
}

}  // namespace
}  // namespace azulejo
