#include "azulejo/io/text_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

TEST(TextFile, IsWrittenWholeOverWhatWasThere) {
  const std::string path = testing::TempDir() + "/azulejo-text-file.json";
  std::ofstream(path) << "something much longer than what comes next";
  write_text_file(path, "{}\n");
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "{}\n");
  std::filesystem::remove(path);
  EXPECT_THROW(write_text_file("/no/such/folder/a.json", "{}"), Error);
}

}  // namespace
}  // namespace azulejo
