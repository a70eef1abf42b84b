#include "azulejo/imaging/lookup.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/lookup_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Sixteen bytes of the table are looked up at a time; a lookup gives 0 where the index's highest bit is set. While v
// counts down in steps of 16, saturating, it is an index into all rows of the table up to its own: each row is stored
// as the difference (exclusive or) to the row before, and the sum of the differences up to a row is that row. Values
// from 128 do the same with their highest bit flipped, in the upper half of the table.
void LookupBytes(const std::uint8_t* source, std::uint8_t* result, std::size_t count, const std::uint8_t* table) {
  const hn::ScalableTag<std::uint8_t> d;
  const hn::RebindToSigned<decltype(d)> di;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN std::uint8_t rows[256];
  for (int i = 0; i < 256; ++i) rows[i] = i % 128 < 16 ? table[i] : static_cast<std::uint8_t>(table[i] ^ table[i - 16]);
  const auto step = hn::Set(di, 16);
  const auto lookup = [&](auto v) HWY_ATTR {
    auto low = hn::BitCast(di, v);
    auto high = hn::Xor(low, hn::Set(di, -128));
    auto sum = hn::Zero(d);
    for (int row = 0; row < 8; ++row) {
      const auto lower = hn::TableLookupBytesOr0(hn::LoadDup128(d, rows + 16 * row), hn::BitCast(d, low));
      const auto upper = hn::TableLookupBytesOr0(hn::LoadDup128(d, rows + 128 + 16 * row), hn::BitCast(d, high));
      sum = hn::Xor(sum, hn::Xor(lower, upper));
      low = hn::SaturatedSub(low, step);
      high = hn::SaturatedSub(high, step);
    }
    return sum;
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(lookup(hn::LoadU(d, source + i)), d, result + i);
  for (; i < count; ++i) result[i] = table[source[i]];
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(LookupBytes);

void lookup_bytes(const std::uint8_t* source, std::uint8_t* result, std::size_t count, const std::uint8_t* table) {
  HWY_DYNAMIC_DISPATCH(LookupBytes)(source, result, count, table);
}

}  // namespace azulejo::kernels
#endif
