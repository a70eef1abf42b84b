#include "azulejo/imaging/convert_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/convert_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/rows_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

struct VectorRescale : Rescale {
  using Rescale::Rescale;
  HWY_INLINE V operator()(V value) const {
    return to_float ? hn::Div(value, hn::Set(D(), from_full)) : hn::Mul(value, hn::Set(D(), factor));
  }
};

template <class From, class To>
void rescale_row(const VectorRescale& rescale, const From* source, To* result, std::size_t count) {
  ForVectors(source, result, count,
             [&](const From* from, To* to) HWY_ATTR { StoreRounded(rescale(LoadStored(from)), to); });
}

template <class From, class To>
void stretch_row(const Stretch& stretch, const VectorRescale& rescale, const From* source, To* result,
                 std::size_t count) {
  const V low = hn::Set(D(), stretch.low);
  const V scale = hn::Set(D(), stretch.scale);
  const V from_full = hn::Set(D(), rescale.from_full);
  const V to_full = hn::Set(D(), rescale.to_full);
  ForVectors(source, result, count, [&](const From* from, To* to) HWY_ATTR {
    const V intensity = hn::Div(LoadStored(from), from_full);
    StoreRounded(hn::Mul(hn::Mul(hn::Sub(intensity, low), scale), to_full), to);
  });
}

template <int kChannels, class From, class To>
void stretch_alpha_row(const Stretch& stretch, const VectorRescale& rescale, bool premultiplied, const From* source,
                       To* result, std::size_t count) {
  const AlphaOf<kChannels> alpha_of;
  const V low = hn::Set(D(), stretch.low);
  const V scale = hn::Set(D(), stretch.scale);
  const V from_full = hn::Set(D(), rescale.from_full);
  const V to_full = hn::Set(D(), rescale.to_full);
  ForVectors(source, result, count, [&](const From* from, To* to) HWY_ATTR {
    const V stored = LoadStored(from);
    const V alpha = premultiplied ? alpha_of(stored) : from_full;
    const V whole = premultiplied ? rescale(alpha) : to_full;
    const V stretched = hn::Mul(hn::Mul(hn::Sub(hn::Div(stored, alpha), low), scale), whole);
    const V color = hn::IfThenZeroElse(hn::Eq(alpha, hn::Zero(D())), stretched);
    StoreRounded(hn::IfThenElse(alpha_of.is_alpha, rescale(stored), color), to);
  });
}

void Convert(const ConstAnyView& source, const AnyView& result, const Stretch& stretch) {
  const ImageInfo& info = source.info;
  const VectorRescale rescale(info.type, result.info.type);
  const std::size_t count = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.channels);
  const bool premultiplied = info.alpha == AlphaState::Premultiplied;
  visit_type(info.type, [&](auto from_zero) HWY_ATTR {
    visit_type(result.info.type, [&](auto to_zero) HWY_ATTR {
      using From = decltype(from_zero);
      using To = decltype(to_zero);
      for (int y = 0; y < info.height; ++y) {
        const From* const from = source.as<From>().row(y);
        To* const to = result.as<To>().row(y);
        if (!stretch.any) {
          rescale_row(rescale, from, to, count);
        } else if (info.alpha == AlphaState::None) {
          stretch_row(stretch, rescale, from, to, count);
        } else if (info.channels == 2) {
          stretch_alpha_row<2>(stretch, rescale, premultiplied, from, to, count);
        } else {
          stretch_alpha_row<4>(stretch, rescale, premultiplied, from, to, count);
        }
      }
    });
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Convert);

void convert(const ConstAnyView& source, const AnyView& result, const Stretch& stretch) {
  HWY_DYNAMIC_DISPATCH(Convert)(source, result, stretch);
}

}  // namespace azulejo::kernels
#endif
