#pragma once

#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

/// Times azulejo beside a peer and beside a limit of the machine, in turn in one process, and checks that the results
/// agree. An X_bench.cpp registers its rows at namespace scope:
///
///   const Rows kRows([](Bench& bench) {
///     bench.image_row({.name = "gaussian sigma=1",
///                      .source = photo(PixelType::U8, 1, kFullHd),
///                      .ours = [](const ConstAnyView& source, const AnyView& result, const Run& run) {
///                        gaussian(source, result, {.sigma = 1}, run);
///                      },
///                      .peer = [](const ConstAnyView& source, const AnyView& result) {
///                        cv::GaussianBlur(mat(source), mat(result), {9, 9}, 1, 1, cv::BORDER_REFLECT_101);
///                      },
///                      .tolerance = 1});
///   });
///
/// Includes of OpenCV's other headers belong into the X_bench.cpp, those of libvips too.
namespace azulejo::bench {

/// One call. The peer's threads are set for the whole process before it is called.
using Call = std::function<void(int threads)>;

/// Whether the results of ours and of the peer, after a call of each, agree.
struct Check {
  bool right = true;
  std::string text;  ///< the largest difference, or what is wrong
};

/// A row of the table: what is timed.
struct Row {
  double work = 0;              ///< units of work in a call
  std::string unit = "Mpix/s";  ///< 10⁶ units of work a second
  Call ours;
  std::string peer_name = "OpenCV";
  Call peer;  ///< empty: none
  std::string limit_name = "copy";
  Call limit;  ///< empty: none. A limit named "copy" makes a row within 1.5× of it one of parity
  std::function<Check()> check;
  double aim = 2;          ///< peer's time ÷ ours
  double aim_seconds = 0;  ///< of a call on the most threads; 0: none
  bool memory = false;     ///< peak memory of ours and of the peer is measured too
  double aim_memory = 0;   ///< ours ÷ the peer's; 0: none
  std::vector<int> threads = {1, 2};
};

using ImageCall = std::function<void(const ConstAnyView& source, const AnyView& result)>;

/// A row of an operation with one source and one result; the limit is a copy of as many bytes.
struct ImageRow {
  std::string name;  ///< without type and size
  ImageInfo source;
  ImageInfo result = {};  ///< left out: like the source
  std::function<void(const ConstAnyView& source, const AnyView& result, const Run& run)> ours;
  std::string peer_name = "OpenCV";
  ImageCall peer = {};
  double tolerance = 0;  ///< largest difference between the results, in units of the stored type
  int margin = 0;        ///< rows and columns at the edges that aren't compared
  double aim = 2;
  double aim_seconds = 0;
  bool packed = false;                                   ///< rows without padding, for peers that know no stride
  std::function<void(const AnyView& source)> fill = {};  ///< left out: `fill_photo`
};

class Bench {
 public:
  /// Adds a row. `make` is called when the row is run: it allocates and fills what the calls use.
  void row(std::string name, std::function<Row()> make);
  /// Adds a row named after the operation, pixel type, channels and size: "gaussian sigma=1, u8 gray 1920×1080".
  void image_row(ImageRow row);

  struct Entry {
    std::string name;
    std::function<Row()> make;
  };
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

/// Registers the rows of a file.
class Rows {
 public:
  explicit Rows(void (*add)(Bench&));
};

/// All rows, sorted by name of file.
Bench all_rows();

struct Size {
  int width;
  int height;
};
inline constexpr Size kFullHd{1920, 1080};
inline constexpr Size k24Megapixels{6000, 4000};

/// 2 and 4 channels end in straight alpha, as a typed view's do.
ImageInfo photo(PixelType type, int channels, Size size);
/// "u8 gray 1920×1080"
std::string kind(const ImageInfo& info);

/// Fills with what looks like a photograph to a filter: smooth shading, sharp edges, fine noise; the whole range.
void fill_photo(const AnyView& pixels);
std::shared_ptr<Image> make_photo(const ImageInfo& info);
/// Memory for a result, its pages touched.
std::shared_ptr<Image> make_result(const ImageInfo& info);

/// The same pixels for OpenCV, not copied. A result given this way must have the peer's size and type: it is written
/// in place.
cv::Mat mat(const ConstAnyView& view);

/// The largest difference of two images of the same kind, in units of the stored type, `margin` pixels from the edges.
Check compare(const ConstAnyView& ours, const ConstAnyView& peer, double tolerance, int margin = 0);

/// Copies `read` bytes from somewhere and `written` bytes to somewhere: the limit of a scan over memory.
Call copy_limit(std::size_t read, std::size_t written);

/// What came out of timing a row with a number of threads.
struct Timing {
  int threads = 1;
  double seconds = 0;     ///< of a call of ours, median
  double rate = 0;        ///< in the row's unit
  double ratio = 0;       ///< peer's time ÷ ours, median of the rounds; 0: no peer
  double ratio_low = 0;   ///< lower quartile
  double ratio_high = 0;  ///< upper quartile
  double ratio_best = 0;  ///< of the fastest calls of each: steadier where other programs use the machine too
  double of_limit = 0;    ///< limit's time ÷ ours; 0: no limit
  bool parity = false;    ///< within 1.5× of a copy: at least 0.9× the peer is asked
  bool reached = true;    ///< the aim
};

struct Measured {
  std::string name;
  std::string unit;
  std::string peer_name;
  double aim = 0;
  double aim_seconds = 0;
  Check check;
  std::vector<Timing> timings;
  double gain = 0;               ///< time with one thread ÷ time with two
  std::int64_t memory_ours = 0;  ///< bytes beyond the source and the result; 0: not measured
  std::int64_t memory_peer = 0;
  double aim_memory = 0;
};

/// Of a row with `memory`: bytes that one call of ours or of the peer, the first of a process, takes beyond the
/// source and the result. For a process that does nothing else.
std::int64_t peak_memory(const Row& row, bool of_peer);

/// Rounds of ours, peer, limit, each thread count in turn, until there are enough of them.
/// How to measure.
struct Measuring {
  bool quick = false;           ///< fewer rounds
  bool processor_time = false;  ///< of all threads, instead of the clock's: for a machine that others use too
};
Measured measure(const std::string& name, const Row& row, const Measuring& measuring);

}  // namespace azulejo::bench
