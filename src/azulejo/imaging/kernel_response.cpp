#include "azulejo/imaging/kernel_response.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/kernel_factors.h"
#include "azulejo/imaging/kernel_file.h"
#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

using Complex = std::complex<double>;

constexpr std::int64_t kCycle = std::int64_t{1} << 32;  ///< parts of a cycle a pixel in which frequencies are told

/// Σ weights[i] · e^(−2πi · frequency · i), frequency in parts of a cycle.
template <class T>
Complex response_of(const std::vector<T>& weights, std::int64_t frequency) {
  Complex sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Turn turn = turn_of(frequency * static_cast<std::int64_t>(i), kCycle);
    sum += weights[i] * Complex(turn.cosine, -turn.sine);
  }
  return sum;
}

double length(Complex value) { return std::sqrt(value.real() * value.real() + value.imag() * value.imag()); }

/// The lowest frequency at which a line of weights falls to 1/√2 of their sum, in cycles a pixel.
std::optional<double> cutoff_of(const std::vector<double>& weights, double magnitude) {
  constexpr std::int64_t kStep = kCycle / 4096;
  const double at_zero = length(response_of(weights, 0));
  if (at_zero <= kKernelTolerance * magnitude) return std::nullopt;
  const double level = at_zero * std::sqrt(0.5);
  const auto passes = [&](std::int64_t frequency) { return length(response_of(weights, frequency)) > level; };
  std::int64_t high = kStep;
  while (high <= kCycle / 2 && passes(high)) high += kStep;
  if (high > kCycle / 2) return std::nullopt;
  std::int64_t low = high - kStep;
  while (high - low > 1) {
    const std::int64_t middle = (low + high) / 2;
    (passes(middle) ? low : high) = middle;
  }
  return static_cast<double>(high) / static_cast<double>(kCycle);
}

/// |H| at the frequencies of the picture: along rows of the kernel first, then along columns.
std::vector<double> magnitudes(const NumberGrid& kernel, int size, const Run& run) {
  const auto side = static_cast<std::size_t>(size);
  const auto rows = static_cast<std::size_t>(kernel.rows);
  const auto frequency = [&](std::size_t place) {
    return (static_cast<std::int64_t>(place) - size / 2) * kCycle / size;
  };
  std::vector<double> result(side * side);
  parallel_for(side, 8, run, [&](std::size_t begin, std::size_t end) {
    std::vector<Complex> column(rows);
    for (std::size_t x = begin; x < end; ++x) {
      for (std::size_t r = 0; r < rows; ++r) {
        const auto first = kernel.values.begin() + static_cast<std::ptrdiff_t>(r) * kernel.columns;
        column[r] = response_of(std::vector<double>(first, first + kernel.columns), frequency(x));
      }
      for (std::size_t y = 0; y < side; ++y) result[y * side + x] = length(response_of(column, frequency(y)));
    }
  });
  return result;
}

}  // namespace

extern const Operation kKernelResponse;

KernelResponse kernel_response(const KernelResponseOptions& options, const Run& run) {
  kKernelResponse.check(&options);
  const KernelFile given = chosen_kernel(options.kernel, KernelResponseOptions{}.kernel, options.file);
  const NumberGrid& kernel = given.kernel;
  const KernelSum total = kernel_sum(kernel.values);
  const bool divided = options.normalize && !total.is(0);
  const double scale = divided ? 1 / std::fabs(total.sum) : 1 / static_cast<double>(given.full);

  // Along an axis only the sums across it count.
  std::vector<double> across(static_cast<std::size_t>(kernel.columns), 0.0);
  std::vector<double> down(static_cast<std::size_t>(kernel.rows), 0.0);
  for (int r = 0; r < kernel.rows; ++r) {
    for (int c = 0; c < kernel.columns; ++c) {
      across[static_cast<std::size_t>(c)] += static_cast<double>(kernel(r, c)) * scale;
      down[static_cast<std::size_t>(r)] += static_cast<double>(kernel(r, c)) * scale;
    }
  }
  KernelResponse response;
  response.at_zero = total.is(0) ? 0 : std::fabs(total.sum) * scale;
  response.at_nyquist_x = length(response_of(across, kCycle / 2));
  response.at_nyquist_y = length(response_of(down, kCycle / 2));
  response.cutoff_x = cutoff_of(across, total.magnitude * scale);
  response.cutoff_y = cutoff_of(down, total.magnitude * scale);
  response.separable = kernel.rows == 1 || kernel.columns == 1 || kernel_factors(kernel).has_value();

  const std::vector<double> values = magnitudes(kernel, options.size, run);
  const double most = *std::max_element(values.begin(), values.end());
  response.largest = most * scale;
  ImageInfo info{options.size, options.size, 1};
  info.color = ColorState::Data;
  response.picture = Image(info, run.limits);
  const auto pixels = response.picture.view<std::uint8_t>();
  for (int y = 0; y < options.size; ++y) {
    for (int x = 0; x < options.size; ++x) {
      const double value =
          values[static_cast<std::size_t>(y) * static_cast<std::size_t>(options.size) + static_cast<std::size_t>(x)];
      pixels(x, y) = static_cast<std::uint8_t>(most > 0 ? 255 * (value / most) + 0.5 : 0);
    }
  }
  return response;
}

Json to_json(const KernelResponse& response) {
  const auto frequency = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  return Json::object()
      .set("at_zero", response.at_zero)
      .set("at_nyquist_x", response.at_nyquist_x)
      .set("at_nyquist_y", response.at_nyquist_y)
      .set("largest", response.largest)
      .set("cutoff_x", frequency(response.cutoff_x))
      .set("cutoff_y", frequency(response.cutoff_y))
      .set("separable", response.separable);
}

extern const Operation kKernelResponse = with_examples(
    value_operation<KernelResponseOptions>(
        "kernel_response", "Tells what a kernel does to each frequency.", {},
        {{"picture", "magnitude of the response, frequency 0 in the middle, Nyquist's at the edges"},
         {"report", "the response at 0 and Nyquist's frequency, cut-offs at −3 dB in cycles a pixel",
          ValueKind::Report}},
        {field("kernel", &KernelResponseOptions::kernel, {-1e6, 1e6}, "", "weights, up to 255 rows and columns"),
         field("file", &KernelResponseOptions::file, "text or an image of one channel that holds the weights instead"),
         field("normalize", &KernelResponseOptions::normalize, "weights are divided by their sum, unless that is 0"),
         field("size", &KernelResponseOptions::size, {16, 2048}, "px", "width and height of the picture")},
        [](std::span<const Value>, const KernelResponseOptions& options, const Run& run) {
          KernelResponse response = kernel_response(options, run);
          Report report{to_json(response)};
          return std::vector<Value>{Value(std::move(response.picture)), Value(std::move(report))};
        }),
    {{"kernel_response:kernel=1,1,1,1,1/1,1,1,1,1/1,1,1,1,1/1,1,1,1,1/1,1,1,1,1",
      "An average lets low frequencies through, and some of the high ones behind its zeros."},
     {"kernel_response:kernel=0,1,0/1,-4,1/0,1,0", "The Laplacian stops constants: black in the middle."}});

}  // namespace azulejo
