// Damaged OBJ and MTL files: any bytes give a value or an Error, within limits.

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/mtl.h"

namespace azulejo {
namespace {

const std::string kObj =
    "mtllib a.mtl b.mtl\no first\nv 0 0 0 1 0.5 0\nv 1e-3 -.5 +2.5\nv nan 1.#INF 3\nv 1 2 3 4\nvt 0.5 1\nvt 0 0 1\n"
    "vn 0 0 1\nvn 1 0 0\ns 1\nusemtl red\nf 1/1/1 2/2/2 -2/-1/-1 \\\n4\nl 1/1 2 3\no second\ns off\nf 1//1 2 3//2\n"
    "p 1 2\ncurv 0 1 1 2\nbogus\nusemtl\nf 2 3 4 1\n";
const std::string kMtl =
    "newmtl red\nKd 1 0.5 0\nKa 0 0 0\nKs .3\nNs 10\nd 0.5\nillum 2\nmap_Kd -s 1 2 -o 0.5 0.5 1 -clamp on a b.png\n"
    "map_d -imfchan m c.png\nNi 1.5\nnewmtl glass\nTr 0.25\nPr 0.1\nPm 1\nnorm n.png\nmap_Bump -bm 2 b.png\n";

azulejo::Run small_run() {
  azulejo::Run run;
  run.limits.memory_bytes = 1 << 24;
  run.warn = [](const std::string& line) { EXPECT_EQ(line.find('\n'), std::string::npos) << line; };
  return run;
}

void survive_obj(const std::string& text) {
  try {
    const Model model = read_model(as_bytes(text), "damaged.obj", {}, small_run());
    for (const auto& mesh : std::get<Scene>(model).meshes) mesh->check("result");
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("damaged.obj: ")) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

void survive_mtl(const std::string& text) {
  const std::string terminated = text + "\n";
  for (const MtlMaterial& each : parse_mtl(terminated, "damaged.mtl", small_run())) {
    EXPECT_EQ(each.material.name.find('\n'), std::string::npos);
  }
}

std::string flipped(const std::string& text, std::mt19937& random) {
  static constexpr char kBytes[] = "\n\r\\/-+0123456789 \t#.eofvlpsn\0\xFF";
  std::string result = text;
  for (auto count = 1 + random() % 4; count > 0; --count) {
    char& at = result[random() % result.size()];
    at = random() % 2 == 0 ? kBytes[random() % sizeof kBytes] : static_cast<char>(at ^ (1 << random() % 8));
  }
  return result;
}

TEST(ObjCorruption, CutsAreSurvived) {
  for (std::size_t size = 0; size <= kObj.size(); ++size) survive_obj(kObj.substr(0, size));
  for (std::size_t size = 0; size <= kMtl.size(); ++size) survive_mtl(kMtl.substr(0, size));
}

TEST(ObjCorruption, FlipsAreSurvived) {
  std::mt19937 random(11);
  for (int i = 0; i < 5000; ++i) {
    survive_obj(flipped(kObj, random));
    survive_mtl(flipped(kMtl, random));
  }
}

TEST(ObjCorruption, Utf16IsSurvived) {
  std::mt19937 random(12);
  for (int i = 0; i < 500; ++i) {
    std::string text = i % 2 == 0 ? "\xFE\xFF" : "\xFF\xFE";
    for (auto n = random() % 40; n > 0; --n) text += static_cast<char>(random() % 4 == 0 ? random() : 0);
    survive_obj(text);
  }
}

}  // namespace
}  // namespace azulejo
