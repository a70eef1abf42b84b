#include "azulejo/imaging/fourier.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "azulejo/core/parallel.h"
#include "azulejo/imaging/fourier_kernels.h"
#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

constexpr std::size_t kLanes = FourierPlan::kLanes;

/// The factors of 5, 4, 3 and 2; empty if there are others.
std::vector<int> radices_of(int n) {
  std::vector<int> radices;
  for (; n % 5 == 0; n /= 5) radices.push_back(5);
  for (; n % 3 == 0; n /= 3) radices.push_back(3);
  for (; n % 4 == 0; n /= 4) radices.push_back(4);
  if (n % 2 == 0) {
    radices.push_back(2);
    n /= 2;
  }
  return n == 1 ? radices : std::vector<int>();
}

/// Memory of a worker: re, im and work, aligned.
class Lines {
 public:
  explicit Lines(const FourierPlan& plan)
      : size_(static_cast<std::size_t>(plan.size()) * kLanes), memory_(2 * size_ + plan.work_values()) {}
  float* re() { return memory_.data(); }
  float* im() { return memory_.data() + size_; }
  float* work() { return memory_.data() + 2 * size_; }

 private:
  std::size_t size_;
  std::vector<float> memory_;
};

}  // namespace

FourierPlan::FourierPlan(int n) : n_(n), radices_(radices_of(n)) {
  if (n == 1 || !radices_.empty()) {
    int rest = n;
    for (const int radix : radices_) {
      for (int p = 0; p < rest / radix; ++p) {
        for (int j = 1; j < radix; ++j) {
          const Turn turn = turn_of(std::int64_t{p} * j, rest);
          factors_.push_back(static_cast<float>(turn.cosine));
          factors_.push_back(static_cast<float>(-turn.sine));
        }
      }
      rest /= radix;
    }
    return;
  }
  padded_.emplace_back(fast_size(2 * n - 1));
  const auto m = static_cast<std::size_t>(padded_[0].size());
  std::vector<float> re(m * kLanes, 0.0F);
  std::vector<float> im(m * kLanes, 0.0F);
  for (int k = 0; k < n; ++k) {
    const Turn turn = turn_of(std::int64_t{k} * k % (2 * n), 2 * n);
    chirp_.push_back(static_cast<float>(turn.cosine));
    chirp_.push_back(static_cast<float>(-turn.sine));
    for (const std::size_t at : {static_cast<std::size_t>(k), (m - static_cast<std::size_t>(k)) % m}) {
      re[at * kLanes] = static_cast<float>(turn.cosine / static_cast<double>(m));
      im[at * kLanes] = static_cast<float>(turn.sine / static_cast<double>(m));
    }
  }
  std::vector<float> work(padded_[0].work_values());
  padded_[0].forward(re.data(), im.data(), work.data());
  for (std::size_t k = 0; k < m; ++k) {
    chirp_transform_.push_back(re[k * kLanes]);
    chirp_transform_.push_back(im[k * kLanes]);
  }
}

int FourierPlan::fast_size(int least) {
  int best = 1;
  while (best < least) best *= 2;
  for (const int odd : {3, 5, 9, 15}) {
    int size = odd;
    while (size < least) size *= 2;
    best = std::min(best, size);
  }
  return best;
}

std::size_t FourierPlan::work_values() const {
  if (padded_.empty()) return 2 * static_cast<std::size_t>(n_) * kLanes;
  return 2 * static_cast<std::size_t>(padded_[0].size()) * kLanes + padded_[0].work_values();
}

void FourierPlan::forward(float* re, float* im, float* work) const {
  if (padded_.empty()) return transform(re, im, work);
  transform_by_chirp(re, im, work);
}

void FourierPlan::transform(float* re, float* im, float* work) const {
  const std::size_t values = static_cast<std::size_t>(n_) * kLanes;
  float* from[2] = {re, im};
  float* to[2] = {work, work + values};
  const float* factors = factors_.data();
  int n = n_;
  int stride = 1;
  for (const int radix : radices_) {
    kernels::fourier_stage({radix, n, stride, factors}, from[0], from[1], to[0], to[1]);
    factors += 2 * (radix - 1) * (n / radix);
    n /= radix;
    stride *= radix;
    std::swap(from, to);
  }
  if (from[0] == re) return;
  std::memcpy(re, from[0], values * sizeof(float));
  std::memcpy(im, from[1], values * sizeof(float));
}

/// jk = (j² + k² − (k − j)²) / 2: a product with the chirp, a convolution with it, and again a product.
void FourierPlan::transform_by_chirp(float* re, float* im, float* work) const {
  const auto n = static_cast<std::size_t>(n_);
  const auto m = static_cast<std::size_t>(padded_[0].size());
  float* const a_re = work;
  float* const a_im = work + m * kLanes;
  float* const rest = a_im + m * kLanes;
  const auto multiply = [](const float* x_re, const float* x_im, const float* factor, float* to_re, float* to_im) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const float product = x_re[l] * factor[0] - x_im[l] * factor[1];
      to_im[l] = x_re[l] * factor[1] + x_im[l] * factor[0];
      to_re[l] = product;
    }
  };
  for (std::size_t k = 0; k < n; ++k) {
    multiply(re + k * kLanes, im + k * kLanes, &chirp_[2 * k], a_re + k * kLanes, a_im + k * kLanes);
  }
  std::fill(a_re + n * kLanes, a_re + m * kLanes, 0.0F);
  std::fill(a_im + n * kLanes, a_im + m * kLanes, 0.0F);
  padded_[0].forward(a_re, a_im, rest);
  for (std::size_t k = 0; k < m; ++k) {
    multiply(a_re + k * kLanes, a_im + k * kLanes, &chirp_transform_[2 * k], a_re + k * kLanes, a_im + k * kLanes);
  }
  padded_[0].inverse(a_re, a_im, rest);
  for (std::size_t k = 0; k < n; ++k) {
    multiply(a_re + k * kLanes, a_im + k * kLanes, &chirp_[2 * k], re + k * kLanes, im + k * kLanes);
  }
}

HalfSpectrum::HalfSpectrum(int width_of, int height_of)
    : width(width_of),
      height(height_of),
      columns(width_of / 2 + 1),
      stride((static_cast<std::size_t>(columns) + kLanes - 1) / kLanes * kLanes),
      re(stride * static_cast<std::size_t>(height_of)),
      im(stride * static_cast<std::size_t>(height_of)) {}

/// Two real rows are one sequence of complex numbers: the second its imaginary part.
void fourier_rows(HalfSpectrum& spectrum, const Run& run, const std::function<void(int y, float* row)>& read) {
  const FourierPlan plan(spectrum.width);
  const auto width = static_cast<std::size_t>(spectrum.width);
  const std::size_t batches = (static_cast<std::size_t>(spectrum.height) + 2 * kLanes - 1) / (2 * kLanes);
  parallel_for(batches, 1, run, [&](std::size_t batch, std::size_t) {
    Lines lines(plan);
    const std::size_t pitch = width + kLanes;  // no power of two: rows lie in different sets of the cache
    std::vector<float> rows(2 * kLanes * pitch, 0.0F);
    const int first = static_cast<int>(batch * 2 * kLanes);
    const int count = std::min(static_cast<int>(2 * kLanes), spectrum.height - first);
    for (int i = 0; i < count; ++i) read(first + i, rows.data() + static_cast<std::size_t>(i) * pitch);
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        lines.re()[x * kLanes + l] = rows[2 * l * pitch + x];
        lines.im()[x * kLanes + l] = rows[(2 * l + 1) * pitch + x];
      }
    }
    plan.forward(lines.re(), lines.im(), lines.work());
    // The even part of a + ib is a's, the odd one b's.
    const float* const re = lines.re();
    const float* const im = lines.im();
    for (std::size_t k = 0; k < static_cast<std::size_t>(spectrum.columns); ++k) {
      const std::size_t here = k * kLanes;
      const std::size_t there = (k == 0 ? 0 : width - k) * kLanes;
      for (int i = 0; i < count; ++i) {
        const auto l = static_cast<std::size_t>(i / 2);
        const std::size_t at = static_cast<std::size_t>(first + i) * spectrum.stride + k;
        const bool even = i % 2 == 0;
        spectrum.re[at] = 0.5F * (even ? re[here + l] + re[there + l] : im[here + l] + im[there + l]);
        spectrum.im[at] = 0.5F * (even ? im[here + l] - im[there + l] : re[there + l] - re[here + l]);
      }
    }
  });
}

void inverse_fourier_rows(const HalfSpectrum& spectrum, const Run& run, int rows,
                          const std::function<void(int y, const float* row)>& write) {
  const FourierPlan plan(spectrum.width);
  const auto width = static_cast<std::size_t>(spectrum.width);
  const std::size_t batches = (static_cast<std::size_t>(rows) + 2 * kLanes - 1) / (2 * kLanes);
  parallel_for(batches, 1, run, [&](std::size_t batch, std::size_t) {
    Lines lines(plan);
    const std::size_t pitch = width + kLanes;
    std::vector<float> values(2 * kLanes * pitch);
    const int first = static_cast<int>(batch * 2 * kLanes);
    const int count = std::min(static_cast<int>(2 * kLanes), rows - first);
    const auto part = [&](const std::vector<float>& of, int i, std::size_t k) {
      return i < count ? of[static_cast<std::size_t>(first + i) * spectrum.stride + k] : 0.0F;
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(spectrum.columns); ++k) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        const int i = static_cast<int>(2 * l);
        const float a_re = part(spectrum.re, i, k);
        const float a_im = part(spectrum.im, i, k);
        const float b_re = part(spectrum.re, i + 1, k);
        const float b_im = part(spectrum.im, i + 1, k);
        // The spectrum of a + ib; behind the middle the conjugates of a and b.
        if (k != 0) {
          lines.re()[(width - k) * kLanes + l] = a_re + b_im;
          lines.im()[(width - k) * kLanes + l] = b_re - a_im;
        }
        lines.re()[k * kLanes + l] = a_re - b_im;
        lines.im()[k * kLanes + l] = a_im + b_re;
      }
    }
    plan.inverse(lines.re(), lines.im(), lines.work());
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        values[2 * l * pitch + x] = lines.re()[x * kLanes + l];
        values[(2 * l + 1) * pitch + x] = lines.im()[x * kLanes + l];
      }
    }
    for (int i = 0; i < count; ++i) write(first + i, values.data() + static_cast<std::size_t>(i) * pitch);
  });
}

void fourier_columns(HalfSpectrum& spectrum, const Run& run,
                     const std::function<void(int v, int u, float* re, float* im)>& change) {
  const FourierPlan plan(spectrum.height);
  parallel_for(spectrum.stride / kLanes, 1, run, [&](std::size_t panel, std::size_t) {
    Lines lines(plan);
    const std::size_t u = panel * kLanes;
    const auto height = static_cast<std::size_t>(spectrum.height);
    for (std::size_t v = 0; v < height; ++v) {
      std::copy_n(&spectrum.re[v * spectrum.stride + u], kLanes, lines.re() + v * kLanes);
      std::copy_n(&spectrum.im[v * spectrum.stride + u], kLanes, lines.im() + v * kLanes);
    }
    plan.forward(lines.re(), lines.im(), lines.work());
    if (change) {
      for (std::size_t v = 0; v < height; ++v) {
        change(static_cast<int>(v), static_cast<int>(u), lines.re() + v * kLanes, lines.im() + v * kLanes);
      }
      plan.inverse(lines.re(), lines.im(), lines.work());
    }
    for (std::size_t v = 0; v < height; ++v) {
      std::copy_n(lines.re() + v * kLanes, kLanes, &spectrum.re[v * spectrum.stride + u]);
      std::copy_n(lines.im() + v * kLanes, kLanes, &spectrum.im[v * spectrum.stride + u]);
    }
  });
}

}  // namespace azulejo
