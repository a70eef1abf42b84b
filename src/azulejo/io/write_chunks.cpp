#include "azulejo/io/write_chunks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <vector>

#include "azulejo/core/parallel.h"

namespace azulejo {

void write_text(Output& output, const std::string& text) { output.write(std::as_bytes(std::span(text))); }

void write_in_chunks(Output& output, std::size_t count, std::size_t chunk, const Run& run,
                     const std::function<void(std::string& text, std::size_t begin, std::size_t end)>& append) {
  std::vector<std::string> texts(static_cast<std::size_t>(thread_count(run)));
  const std::size_t chunks = (count + chunk - 1) / chunk;
  for (std::size_t first = 0; first < chunks; first += texts.size()) {
    const std::size_t batch = std::min(texts.size(), chunks - first);
    parallel_tasks(batch, run, [&](std::size_t i, int) {
      const std::size_t begin = (first + i) * chunk;
      texts[i].clear();
      append(texts[i], begin, std::min(count, begin + chunk));
    });
    for (std::size_t i = 0; i < batch; ++i) write_text(output, texts[i]);
  }
}

void append_number(std::string& text, float value) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr);
}

void append_number(std::string& text, std::uint32_t value) {
  std::array<char, 16> digits;
  text.append(digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr);
}

}  // namespace azulejo
