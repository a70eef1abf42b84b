#include "report.h"

#include <fmt/format.h>
#include <vips/vips.h>

#include <assimp/version.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "azulejo/core/error.h"
#include "llvmpipe.h"

namespace azulejo::bench {
namespace {

/// What is not bound by memory should gain this much from a second core.
constexpr double kAimGain = 1.7;

std::string duration(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.1f} µs", seconds * 1e6) : fmt::format("{:.2f} ms", seconds * 1e3);
}

std::string aim_of(const Measured& row) {
  std::string aim = row.peer_name.empty() ? "" : fmt::format("{:.2g}×", row.aim);
  if (row.aim_seconds > 0) aim += fmt::format("{}≤ {}", aim.empty() ? "" : ", ", duration(row.aim_seconds));
  return aim;
}

const char* verdict(const Measured& row, const Timing& timing) {
  if (!row.check.right) return "WRONG";
  if (!timing.reached) return "BELOW";
  return timing.parity ? "PASS (parity)" : "PASS";
}

bool memory_reached(const Measured& row) {
  return row.aim_memory <= 0 ||
         static_cast<double>(row.memory_ours) <= row.aim_memory * static_cast<double>(row.memory_peer);
}

std::string memory_of(const Measured& row) {
  constexpr double kMegabyte = 1 << 20;
  return fmt::format("{:.1f} MB, {} {:.1f} MB", static_cast<double>(row.memory_ours) / kMegabyte, row.peer_name,
                     static_cast<double>(row.memory_peer) / kMegabyte);
}

std::string gain_of(const Measured& row) {
  if (row.gain <= 0) return "–";
  const bool bound = row.timings.back().parity || row.gain >= kAimGain || row.aim_seconds > 0;
  return fmt::format("{:.2f}×{}", row.gain, bound ? "" : " (low)");
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string opengl() {
  try {
    return Llvmpipe(0).renderer();
  } catch (const Error& error) {
    return error.what();
  }
}

std::string machine() {
  return fmt::format("{}, {} processors; GCC {}; OpenCV {}, libvips {}, assimp {}.{}.{}, {}", processor(),
                     std::thread::hardware_concurrency(), __VERSION__, CV_VERSION, vips_version_string(),
                     aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch(), opengl());
}

/// Of all ratios that aren't parity; 0 if there are none.
double geometric_mean(const std::vector<Measured>& rows) {
  double sum = 0;
  int count = 0;
  for (const Measured& row : rows) {
    for (const Timing& timing : row.timings) {
      if (timing.ratio <= 0 || timing.parity) continue;
      sum += std::log(timing.ratio);
      ++count;
    }
  }
  return count == 0 ? 0 : std::exp(sum / count);
}

}  // namespace

bool reached(const Measured& row) {
  bool all = row.check.right && memory_reached(row);
  for (const Timing& timing : row.timings) all = all && timing.reached;
  return all;
}

std::string as_text(const Measured& row) {
  std::string text = fmt::format("{}\n", row.name);
  if (!row.check.right) text += fmt::format("  WRONG: differs from {} by {}\n", row.peer_name, row.check.text);
  for (const Timing& timing : row.timings) {
    text += fmt::format("  {} thread{} {:8.0f} {} {:>10}", timing.threads, timing.threads == 1 ? " " : "s", timing.rate,
                        row.unit, duration(timing.seconds));
    if (timing.ratio > 0) {
      text += fmt::format("  {:5.2f}× {} ({:.2f}–{:.2f}, of the fastest {:.2f})", timing.ratio, row.peer_name,
                          timing.ratio_low, timing.ratio_high, timing.ratio_best);
    }
    if (timing.of_limit > 0) text += fmt::format("  {:3.0f} % of copy", timing.of_limit * 100);
    text += fmt::format("  aim {}: {}\n", aim_of(row), verdict(row, timing));
  }
  if (row.gain > 0) text += fmt::format("  second core {}\n", gain_of(row));
  if (row.memory_peer > 0) {
    text += fmt::format("  beyond source and result {}: aim {:.2g}×: {}\n", memory_of(row), row.aim_memory,
                        memory_reached(row) ? "PASS" : "BELOW");
  }
  return text;
}

std::string summary(const std::vector<Measured>& rows) {
  const double mean = geometric_mean(rows);
  std::string text = mean > 0 ? fmt::format("geometric mean of the ratios to the peers: {:.2f}×\n", mean) : "";
  for (const Measured& row : rows) {
    if (!reached(row)) text += fmt::format("{}: {}\n", row.check.right ? "below its aim" : "WRONG", row.name);
  }
  return text;
}

std::string as_markdown(const std::vector<Measured>& rows) {
  std::string text = fmt::format(
      "Machine: {}.\nGeometric mean of the ratios, rows of parity left out: **{:.2f}×**.\n\n"
      "| operation | 1 thread | × peer | 2 threads | × peer (quartiles) | of a copy | second core | aim | |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---|\n",
      machine(), geometric_mean(rows));
  for (const Measured& row : rows) {
    const Timing& one = row.timings.front();
    const Timing& two = row.timings.back();
    const auto rate = [&](const Timing& timing) {
      return row.aim_seconds > 0 ? duration(timing.seconds) : fmt::format("{:.0f} {}", timing.rate, row.unit);
    };
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", row.name, rate(one),
                        one.ratio > 0 ? fmt::format("{:.2f}", one.ratio) : "–", rate(two),
                        two.ratio > 0 ? fmt::format("{:.2f} ({:.2f}–{:.2f}) {}", two.ratio, two.ratio_low,
                                                    two.ratio_high, row.peer_name)
                                      : "–",
                        two.of_limit > 0 ? fmt::format("{:.0f} %", two.of_limit * 100) : "–", gain_of(row), aim_of(row),
                        verdict(row, one.reached ? two : one));
  }
  text += "\n";
  for (const Measured& row : rows) {
    if (row.memory_peer > 0)
      text += fmt::format("- {}: memory beyond source and result {}.\n", row.name, memory_of(row));
  }
  return text;
}

std::string as_json(const std::vector<Measured>& rows) {
  nlohmann::ordered_json report;
  report["azulejo"] = AZULEJO_VERSION;
  report["machine"] = machine();
  report["geometric_mean"] = geometric_mean(rows);
  for (const Measured& row : rows) {
    nlohmann::ordered_json entry = {{"name", row.name},
                                    {"unit", row.unit},
                                    {"peer", row.peer_name},
                                    {"aim", row.aim},
                                    {"aim_seconds", row.aim_seconds},
                                    {"right", row.check.right},
                                    {"difference", row.check.text},
                                    {"gain", row.gain}};
    for (const Timing& timing : row.timings) {
      entry["timings"].push_back({{"threads", timing.threads},
                                  {"seconds", timing.seconds},
                                  {"rate", timing.rate},
                                  {"ratio", timing.ratio},
                                  {"ratio_low", timing.ratio_low},
                                  {"ratio_high", timing.ratio_high},
                                  {"ratio_best", timing.ratio_best},
                                  {"of_limit", timing.of_limit},
                                  {"parity", timing.parity},
                                  {"reached", timing.reached}});
    }
    if (row.memory_peer > 0) entry["memory"] = {{"ours", row.memory_ours}, {"peer", row.memory_peer}};
    report["rows"].push_back(std::move(entry));
  }
  return report.dump(2) + "\n";
}

void replace_between_markers(const std::string& path, const std::string& name, const std::string& text) {
  std::ifstream file(path);
  std::stringstream content;
  content << file.rdbuf();
  std::string all = content.str();
  const std::string begin = "<!-- " + name + " -->\n";
  const std::size_t from = all.find(begin);
  const std::size_t to = all.find("<!-- /" + name + " -->");
  if (from == std::string::npos || to == std::string::npos || to < from) {
    throw Error(Error::Io, path + ": no lines <!-- " + name + " --> and <!-- /" + name + " -->");
  }
  all.replace(from + begin.size(), to - from - begin.size(), text);
  if (!(std::ofstream(path) << all)) throw Error(Error::Io, path + ": can't be written");
}

}  // namespace azulejo::bench
