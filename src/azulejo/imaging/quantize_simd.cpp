#include "azulejo/imaging/quantize_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/quantize_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/lookup.h"
#include "azulejo/imaging/stored_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
void QuantizeValues(const QuantizeRow<T>& row) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);  // a multiple of every period
  HWY_ALIGN float marks[HWY_MAX_BYTES / sizeof(float)];
  for (std::size_t k = 0; k < lanes; ++k) {
    marks[k] = row.period > 0 && (static_cast<int>(k) + 1) % row.period == 0 ? 1.0F : 0.0F;
  }
  const auto is_alpha = hn::Gt(hn::Load(d, marks), hn::Zero(d));
  const auto scale = hn::Set(d, row.last / full_range(kPixelTypeOf<T>));
  const auto top = hn::Set(d, full_range(kPixelTypeOf<T>));
  const auto last = hn::Set(d, row.last);
  const auto one = hn::Set(d, 1.0F);
  std::size_t i = 0;
  for (; i + lanes <= row.count; i += lanes) {
    const auto value = LoadStored(row.source + i);
    const auto place = hn::Mul(value, scale);
    const auto below = hn::Floor(place);
    const auto up = hn::Ge(hn::Sub(place, below), hn::LoadU(d, row.thresholds + i));
    const auto level = hn::Min(hn::Max(hn::Add(below, hn::IfThenElseZero(up, one)), hn::Zero(d)), last);
    auto result = hn::Div(hn::Mul(level, top), last);
    if constexpr (std::is_same_v<T, float>) result = hn::IfThenElse(hn::Eq(value, value), result, value);
    StoreRounded(hn::IfThenElse(is_alpha, value, result), row.result + i);
  }
  quantize_row_reference(row, i);
}

/// In place is allowed: blocks are looked up before they are written.
void ByByteTables(const ByteQuantizer& quantizer, const std::uint8_t* source, const std::uint8_t* thresholds,
                  std::size_t count, std::uint8_t* result) {
  const hn::ScalableTag<std::uint8_t> d;
  const std::size_t lanes = hn::Lanes(d);
  constexpr std::size_t kBlock = 2048;
  HWY_ALIGN std::uint8_t ranks[kBlock];
  HWY_ALIGN std::uint8_t lows[kBlock];
  HWY_ALIGN std::uint8_t highs[kBlock];
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count - begin);
    const std::uint8_t* rank = source + begin;
    if (!quantizer.binary) {
      lookup_bytes(source + begin, ranks, size, quantizer.rank);
      lookup_bytes(source + begin, lows, size, quantizer.low);
      lookup_bytes(source + begin, highs, size, quantizer.high);
      rank = ranks;
    }
    std::size_t i = 0;
    for (; i + lanes <= size; i += lanes) {
      const auto above = hn::Gt(hn::LoadU(d, rank + i), hn::LoadU(d, thresholds + begin + i));
      const auto marks = hn::VecFromMask(d, above);
      const auto chosen =
          quantizer.binary ? marks : hn::IfThenElse(above, hn::Load(d, highs + i), hn::Load(d, lows + i));
      hn::StoreU(chosen, d, result + begin + i);
    }
    for (; i < size; ++i) {
      const std::uint8_t value = source[begin + i];
      result[begin + i] = quantizer.rank[value] > thresholds[begin + i] ? quantizer.high[value] : quantizer.low[value];
    }
  }
}

void QuantizeBytes(const QuantizeRow<std::uint8_t>& row) { QuantizeValues(row); }
void QuantizeWords(const QuantizeRow<std::uint16_t>& row) { QuantizeValues(row); }
void QuantizeFloats(const QuantizeRow<float>& row) { QuantizeValues(row); }

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(QuantizeBytes);
HWY_EXPORT(ByByteTables);
HWY_EXPORT(QuantizeWords);
HWY_EXPORT(QuantizeFloats);

void quantize_bytes(const ByteQuantizer& quantizer, const std::uint8_t* source, const std::uint8_t* thresholds,
                    std::size_t count, std::uint8_t* result) {
  HWY_DYNAMIC_DISPATCH(ByByteTables)(quantizer, source, thresholds, count, result);
}
void quantize_row(const QuantizeRow<std::uint8_t>& row) { HWY_DYNAMIC_DISPATCH(QuantizeBytes)(row); }
void quantize_row(const QuantizeRow<std::uint16_t>& row) { HWY_DYNAMIC_DISPATCH(QuantizeWords)(row); }
void quantize_row(const QuantizeRow<float>& row) { HWY_DYNAMIC_DISPATCH(QuantizeFloats)(row); }

}  // namespace azulejo::kernels
#endif
