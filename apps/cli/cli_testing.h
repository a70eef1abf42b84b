#pragma once

// What the tests of the command share: it is run as a user runs it, in a folder of its own.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/image_io.h"

namespace azulejo {

struct Outcome {
  int status = -1;  ///< exit status; 128 + signal
  std::string out;
  std::string err;
};

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Cli : public testing::Test {
 protected:
  Cli()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("cli-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Cli() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  pid_t start(const std::vector<std::string>& words, const std::string& input = "/dev/null") const {
    std::vector<const char*> pointers{AZULEJO_COMMAND};
    for (const std::string& word : words) pointers.push_back(word.c_str());
    pointers.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.c_str()) != 0) _exit(126);
      const auto redirect = [](const std::string& file, int flags, int to) {
        const int from = open(file.c_str(), flags | O_CREAT, 0644);
        if (from < 0 || dup2(from, to) < 0) _exit(126);
      };
      redirect(input, O_RDONLY, STDIN_FILENO);
      redirect(path("out.txt"), O_WRONLY | O_TRUNC, STDOUT_FILENO);
      redirect(path("err.txt"), O_WRONLY | O_TRUNC, STDERR_FILENO);
      execv(AZULEJO_COMMAND, const_cast<char* const*>(pointers.data()));
      _exit(127);
    }
    return child;
  }

  Outcome wait(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(path("out.txt")),
            read_file(path("err.txt"))};
  }

  Outcome run(const std::vector<std::string>& words, const std::string& input = "/dev/null") const {
    return wait(start(words, input));
  }

  void make_ramp(const std::string& name, int width = 32, int height = 24) const {
    Image image(width, height, 3);
    const auto view = image.view<std::uint8_t>();
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < 3 * width; ++i)
        view.row(y)[i] = static_cast<std::uint8_t>((7 * i + 13 * y + i * y / 5) % 256);
    }
    write_image(image, path(name), {.compression_level = 1});
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) names.push_back(std::filesystem::relative(entry.path(), folder_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace azulejo
