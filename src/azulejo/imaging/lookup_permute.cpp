#include "azulejo/imaging/lookup_permute.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace azulejo::kernels {

#if defined(__x86_64__)

bool permutes_bytes() {
  static const bool can = __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vbmi");
  return can;
}

// Two permutations, of 128 bytes of the table each, and a choice by the highest bit.
__attribute__((target("avx512f,avx512bw,avx512vbmi"))) std::size_t lookup_by_permutation(
    const std::uint8_t* source, std::uint8_t* result, std::size_t count, const std::uint8_t* table, int period) {
  const __m512i a = _mm512_loadu_si512(table);
  const __m512i b = _mm512_loadu_si512(table + 64);
  const __m512i c = _mm512_loadu_si512(table + 128);
  const __m512i d = _mm512_loadu_si512(table + 192);
  const __mmask64 kept = period == 4 ? 0x8888888888888888U : period == 2 ? 0xAAAAAAAAAAAAAAAAU : 0;
  std::size_t i = 0;
  for (; i + 64 <= count; i += 64) {
    const __m512i v = _mm512_loadu_si512(source + i);
    const __m512i low = _mm512_permutex2var_epi8(a, v, b);
    const __m512i high = _mm512_permutex2var_epi8(c, v, d);
    const __m512i found = _mm512_mask_blend_epi8(_mm512_movepi8_mask(v), low, high);
    _mm512_storeu_si512(result + i, _mm512_mask_mov_epi8(found, kept, v));
  }
  return i;
}

#else

bool permutes_bytes() { return false; }

std::size_t lookup_by_permutation(const std::uint8_t*, std::uint8_t*, std::size_t, const std::uint8_t*, int) {
  return 0;
}

#endif

}  // namespace azulejo::kernels
