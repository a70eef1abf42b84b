#include "azulejo/imaging/spectrum.h"

#include <algorithm>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/fourier.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/imaging/spectrum_kernels.h"
#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

std::vector<float> window_of(int size, SpectrumWindow window) {
  std::vector<float> factors(static_cast<std::size_t>(size), 1.0F);
  if (window == SpectrumWindow::None) return factors;
  for (int i = 0; i < size; ++i) {
    factors[static_cast<std::size_t>(i)] = static_cast<float>(0.5 - 0.5 * turn_of(2 * i + 1, 2 * size).cosine);
  }
  return factors;
}

/// Of one channel: ln(1 + |F|) for all columns that HalfSpectrum has, in place of the real parts.
HalfSpectrum logarithms(const ConstAnyView& source, const RowFormat& format, int channel, SpectrumWindow window,
                        const Run& run) {
  HalfSpectrum spectrum(source.width(), source.height());
  const std::vector<float> across = window_of(source.width(), window);
  const std::vector<float> down = window_of(source.height(), window);
  const float unit = row_unit(format);
  fourier_rows(spectrum, run, [&](int y, float* values) {
    std::vector<float> row(format.values(source.width()));
    load_row(format, source.row(y), source.width(), row.data());
    const float* from = row.data() + channel;
    for (int x = 0; x < source.width(); ++x, from += format.channels) {
      const auto at = static_cast<std::size_t>(x);
      values[x] = *from / unit * (across[at] * down[static_cast<std::size_t>(y)]);
    }
  });
  fourier_columns(spectrum, run);
  parallel_for(static_cast<std::size_t>(spectrum.height), 16, run, [&](std::size_t begin, std::size_t end) {
    const std::size_t first = begin * spectrum.stride;
    kernels::log_magnitudes(&spectrum.re[first], &spectrum.im[first], (end - begin) * spectrum.stride);
  });
  return spectrum;
}

float largest(const HalfSpectrum& spectrum) {
  float most = 0;
  for (int v = 0; v < spectrum.height; ++v) {
    for (int u = 0; u < spectrum.columns; ++u) {
      most = std::max(most, spectrum.re[static_cast<std::size_t>(v) * spectrum.stride + static_cast<std::size_t>(u)]);
    }
  }
  return most;
}

ImageInfo result_info(ImageInfo info, const SpectrumOptions& options) {
  if (options.output == FilterOutput::F32) info.type = PixelType::F32;
  info.color = ColorState::Data;
  info.channels = info.color_channels();
  info.alpha = AlphaState::None;
  return info;
}

/// Frequency 0 goes to the middle; what the half spectrum leaves out is the same as opposite to it.
void place(const HalfSpectrum& spectrum, float scale, const AnyView& result, int channel, const Run& run) {
  const RowFormat format{result.info.type, 1};
  const int width = spectrum.width;
  const int height = spectrum.height;
  parallel_for(static_cast<std::size_t>(height), 16, run, [&](std::size_t begin, std::size_t end) {
    std::vector<float> row(static_cast<std::size_t>(width));
    std::vector<std::byte> stored(row.size() * size_of(format.type));
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      const int v = (y - height / 2 + height) % height;
      for (int x = 0; x < width; ++x) {
        const int u = (x - width / 2 + width) % width;
        const bool opposite = u >= spectrum.columns;
        const int from_v = opposite ? (height - v) % height : v;
        const int from_u = opposite ? width - u : u;
        row[static_cast<std::size_t>(x)] =
            spectrum.re[static_cast<std::size_t>(from_v) * spectrum.stride + static_cast<std::size_t>(from_u)] * scale;
      }
      store_row(format, row.data(), width, stored.data());
      visit(result, [&](auto view) {
        using T = std::remove_pointer_t<decltype(view.data)>;
        const T* const from = reinterpret_cast<const T*>(stored.data());
        for (int x = 0; x < width; ++x) view(x, y, channel) = from[x];
      });
    }
  });
}

void transform(const ConstAnyView& source, const AnyView& result, const SpectrumOptions& options, const Run& run) {
  const RowFormat format = row_format(source.info, options.light);
  std::vector<HalfSpectrum> channels;
  float most = 0;
  for (int c = 0; c < source.info.color_channels(); ++c) {
    channels.push_back(logarithms(source, format, c, options.window, run));
    most = std::max(most, largest(channels.back()));
  }
  const bool stretches = options.output == FilterOutput::Same && most > 0;
  const float scale = stretches ? full_range(result.info.type) / most : 1.0F;
  for (std::size_t c = 0; c < channels.size(); ++c) place(channels[c], scale, result, static_cast<int>(c), run);
}

Image transformed(const Image& source, const SpectrumOptions& options, const Run& run) {
  Image result(result_info(source.info(), options), run.limits);
  result.share_metadata(source);
  if (!source.empty()) transform(source.any(), result.any(), options, run);
  return result;
}

}  // namespace

extern const Operation kSpectrum = with_examples(
    value_operation<SpectrumOptions>(
        "spectrum", "Shows the magnitude of the Fourier transform.", {{"source", "the image"}},
        {{"spectrum", "logarithm of the magnitude, frequency 0 in the middle"}},
        {field("window", &SpectrumOptions::window, "what the image is multiplied by first"),
         field("output", &SpectrumOptions::output, "same: stretched to full range; f32: the logarithms themselves"),
         field("light", &SpectrumOptions::light, "what is transformed: stored values or linear light")},
        [](std::span<const Value> inputs, const SpectrumOptions& options, const Run& run) {
          return std::vector<Value>{Value(transformed(*inputs[0].image(), options, run))};
        }),
    {{"gray.png spectrum",
      "Most of a photograph is in low frequencies; the cross comes from edges that don't fit together."},
     {"gray.png spectrum:window=hann", "A window takes the cross away."}});

void spectrum(const ConstAnyView& source, const AnyView& result, const SpectrumOptions& options, const Run& run) {
  kSpectrum.check(&options);
  const ImageInfo expected = result_info(source.info, options);
  if (result.info.width != expected.width || result.info.height != expected.height ||
      result.info.channels != expected.channels || result.info.type != expected.type) {
    throw Error(Error::Argument, "spectrum: the result has another size, type or channels than the operation gives");
  }
  transform(source, result, options, run);
}

Image spectrum(const Image& source, const SpectrumOptions& options, const Run& run) {
  kSpectrum.check(&options);
  return transformed(source, options, run);
}

}  // namespace azulejo
