#include "azulejo/imaging/lookup.h"
#include "azulejo/imaging/lookup_permute.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/lookup_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Sixteen bytes of the table are looked up at a time; a lookup gives 0 where the index's highest bit is set. While v
// counts down in steps of 16, saturating, it is an index into all rows of the table up to its own: each row is stored
// as the difference (exclusive or) to the row before, and the sum of the differences up to a row is that row. Values
// from 128 do the same with their highest bit flipped, in the upper half of the table.
class ByteTable {
 public:
  using D = hn::ScalableTag<std::uint8_t>;
  using V = hn::Vec<D>;

  explicit ByteTable(const std::uint8_t* table) {
    for (int i = 0; i < 256; ++i) {
      rows_[i] = i % 128 < 16 ? table[i] : static_cast<std::uint8_t>(table[i] ^ table[i - 16]);
    }
  }

  HWY_INLINE V operator()(V v) const {
    const D d;
    const hn::RebindToSigned<D> di;
    const auto step = hn::Set(di, 16);
    auto low = hn::BitCast(di, v);
    auto high = hn::Xor(low, hn::Set(di, -128));
    auto sum = hn::Zero(d);
    for (int row = 0; row < 8; ++row) {
      const auto lower = hn::TableLookupBytesOr0(hn::LoadDup128(d, rows_ + 16 * row), hn::BitCast(d, low));
      const auto upper = hn::TableLookupBytesOr0(hn::LoadDup128(d, rows_ + 128 + 16 * row), hn::BitCast(d, high));
      sum = hn::Xor(sum, hn::Xor(lower, upper));
      low = hn::SaturatedSub(low, step);
      high = hn::SaturatedSub(high, step);
    }
    return sum;
  }

 private:
  HWY_ALIGN std::uint8_t rows_[256];
};

void LookupBytes(const std::uint8_t* source, std::uint8_t* result, std::size_t count, const std::uint8_t* table,
                 int period) {
  const hn::ScalableTag<std::uint8_t> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto copied = [period](std::size_t place) {
    return period > 0 && (place + 1) % static_cast<std::size_t>(period) == 0;
  };
  std::size_t i = 0;
  if (HWY_TARGET <= HWY_AVX3 && permutes_bytes()) {
    i = lookup_by_permutation(source, result, count, table, period);
  } else {
    const ByteTable lookup(table);
    HWY_ALIGN std::uint8_t pattern[HWY_MAX_BYTES];
    for (std::size_t k = 0; k < lanes; ++k) pattern[k] = copied(k) ? 1 : 0;
    const auto kept = hn::Ne(hn::Load(d, pattern), hn::Zero(d));
    for (; i + lanes <= count; i += lanes) {
      const auto v = hn::LoadU(d, source + i);
      hn::StoreU(hn::IfThenElse(kept, v, lookup(v)), d, result + i);
    }
  }
  for (; i < count; ++i) result[i] = copied(i) ? source[i] : table[source[i]];
}

/// kChannels tables; a null one copies.
template <std::size_t kChannels>
void lookup_interleaved(const std::uint8_t* source, std::uint8_t* result, std::size_t pixels,
                        const std::uint8_t* const* tables) {
  const ByteTable::D d;
  const std::size_t lanes = hn::Lanes(d);
  std::array<std::uint8_t, 256> same;
  for (std::size_t i = 0; i < 256; ++i) same[i] = static_cast<std::uint8_t>(i);
  const auto table = [&](std::size_t c) { return c >= kChannels || tables[c] == nullptr ? same.data() : tables[c]; };
  const ByteTable lookups[] = {ByteTable(table(0)), ByteTable(table(1)), ByteTable(table(2)), ByteTable(table(3))};
  const auto mapped = [&](ByteTable::V v, std::size_t c) HWY_ATTR { return tables[c] == nullptr ? v : lookups[c](v); };
  std::size_t x = 0;
  for (; x + lanes <= pixels; x += lanes, source += kChannels * lanes, result += kChannels * lanes) {
    ByteTable::V a, b, c, e;
    if constexpr (kChannels == 2) {
      hn::LoadInterleaved2(d, source, a, b);
      hn::StoreInterleaved2(mapped(a, 0), mapped(b, 1), d, result);
    } else if constexpr (kChannels == 3) {
      hn::LoadInterleaved3(d, source, a, b, c);
      hn::StoreInterleaved3(mapped(a, 0), mapped(b, 1), mapped(c, 2), d, result);
    } else {
      hn::LoadInterleaved4(d, source, a, b, c, e);
      hn::StoreInterleaved4(mapped(a, 0), mapped(b, 1), mapped(c, 2), mapped(e, 3), d, result);
    }
  }
  for (; x < pixels; ++x, source += kChannels, result += kChannels) {
    for (std::size_t c = 0; c < kChannels; ++c) result[c] = table(c)[source[c]];
  }
}

void LookupChannels(const std::uint8_t* source, std::uint8_t* result, std::size_t pixels,
                    std::span<const std::uint8_t* const> tables) {
  switch (tables.size()) {
    case 2: return lookup_interleaved<2>(source, result, pixels, tables.data());
    case 3: return lookup_interleaved<3>(source, result, pixels, tables.data());
    case 4: return lookup_interleaved<4>(source, result, pixels, tables.data());
    default: break;
  }
  if (tables[0] != nullptr) return LookupBytes(source, result, pixels, tables[0], 0);
  if (source != result) std::memcpy(result, source, pixels);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(LookupBytes);
HWY_EXPORT(LookupChannels);

void lookup_bytes(const std::uint8_t* source, std::uint8_t* result, std::size_t count, const std::uint8_t* table,
                  int period) {
  HWY_DYNAMIC_DISPATCH(LookupBytes)(source, result, count, table, period);
}

void lookup_channels(const std::uint8_t* source, std::uint8_t* result, std::size_t pixels,
                     std::span<const std::uint8_t* const> tables) {
  HWY_DYNAMIC_DISPATCH(LookupChannels)(source, result, pixels, tables);
}

}  // namespace azulejo::kernels
#endif
