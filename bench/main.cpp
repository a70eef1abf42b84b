#include <vips/vips.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <opencv2/core/ocl.hpp>

#include "azulejo/core/error.h"
#include "harness.h"
#include "report.h"

namespace {

using namespace azulejo;
using namespace azulejo::bench;

constexpr const char* kHelp =
    "azulejo_bench [--filter TEXT] [--quick] [--cpu] [--list] [--json FILE] [--markdown FILE]\n"
    "  --filter TEXT     only rows whose name contains it\n"
    "  --quick           fewer rounds, for a first look\n"
    "  --cpu             processor time of all threads, not the clock's: on a machine that others use too\n"
    "  --list            names only\n"
    "  --json FILE       all numbers\n"
    "  --memory-of ROW --who ours|peer   prints the bytes that one call takes beyond source and result\n"
    "  --markdown FILE   puts the table between the lines <!-- rows --> and <!-- /rows -->\n"
    "Exit status: 0, 1 if a result was wrong, 2 for a wrong call. A row below its aim is not a failure.\n";

struct Options {
  std::string filter, json, markdown, memory_of, who;
  Measuring measuring;
  bool list = false;
};

Options parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    const auto value = [&] {
      if (i + 1 == count) throw Error(Error::Argument, argument + ": a value is missing");
      return std::string(arguments[++i]);
    };
    if (argument == "--filter")
      options.filter = value();
    else if (argument == "--json")
      options.json = value();
    else if (argument == "--markdown")
      options.markdown = value();
    else if (argument == "--memory-of")
      options.memory_of = value();
    else if (argument == "--who")
      options.who = value();
    else if (argument == "--quick")
      options.measuring.quick = true;
    else if (argument == "--cpu")
      options.measuring.processor_time = true;
    else if (argument == "--list")
      options.list = true;
    else
      throw Error(Error::Argument, argument + ": no such option\n" + kHelp);
  }
  if (!options.markdown.empty() && !options.filter.empty()) {
    throw Error(Error::Argument, "--markdown: not with --filter, the table has all rows");
  }
  return options;
}

/// What a process started for a row with `memory` prints.
int print_memory(const Bench& bench, const Options& options) {
  for (const Bench::Entry& entry : bench.entries()) {
    if (entry.name != options.memory_of) continue;
    std::printf("%lld\n", static_cast<long long>(peak_memory(entry.make(), options.who == "peer")));
    return 0;
  }
  throw Error(Error::Argument, "--memory-of: no row is called " + options.memory_of);
}

int run(const Options& options) {
  std::vector<Measured> rows;
  bool right = true;
  const Bench bench = all_rows();
  if (!options.memory_of.empty()) return print_memory(bench, options);
  for (const Bench::Entry& entry : bench.entries()) {
    if (entry.name.find(options.filter) == std::string::npos) continue;
    if (options.list) {
      std::printf("%s\n", entry.name.c_str());
      continue;
    }
    rows.push_back(measure(entry.name, entry.make(), options.measuring));
    right = right && rows.back().check.right;
    std::printf("%s", as_text(rows.back()).c_str());
    std::fflush(stdout);
  }
  if (rows.empty()) return 0;
  std::printf("\n%s", summary(rows).c_str());
  if (!options.json.empty()) std::ofstream(options.json) << as_json(rows);
  if (!options.markdown.empty()) replace_between_markers(options.markdown, "rows", as_markdown(rows));
  return right ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const Options options = parse(count, arguments);
    if (VIPS_INIT(arguments[0]) != 0) throw Error(Error::Resource, "libvips does not start");
    vips_cache_set_max(0);  // no result is remembered
    cv::ocl::setUseOpenCL(false);
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "azulejo_bench: %s\n", error.what());
    return 2;
  }
}
