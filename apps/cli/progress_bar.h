#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace azulejo::cli {

/// A line on standard error that is drawn over again; nothing if that is not a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(double fraction, const std::string& text);
  /// Prints a line above the bar.
  void print(const std::string& line);

 private:
  void clear();

  std::mutex mutex_;
  bool wanted_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_ = begun_;
};

}  // namespace azulejo::cli
