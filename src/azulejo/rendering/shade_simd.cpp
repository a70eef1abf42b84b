#include "azulejo/rendering/shade.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/shade_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

struct Vec3 {
  V x, y, z;
};

HWY_INLINE V set(float value) { return hn::Set(D(), value); }
HWY_INLINE Vec3 set(const glm::vec3& v) { return {set(v.x), set(v.y), set(v.z)}; }
HWY_INLINE Vec3 load(const std::array<FragmentBatch::Column<float>, 3>& columns, std::size_t i) {
  const D d;
  return {hn::Load(d, &columns[0][i]), hn::Load(d, &columns[1][i]), hn::Load(d, &columns[2][i])};
}
HWY_INLINE void store(const Vec3& v, std::array<FragmentBatch::Column<float>, 3>& columns, std::size_t i) {
  const D d;
  hn::Store(v.x, d, &columns[0][i]);
  hn::Store(v.y, d, &columns[1][i]);
  hn::Store(v.z, d, &columns[2][i]);
}
HWY_INLINE V load(const Parameter& parameter, std::size_t i) {
  return parameter.varying != nullptr ? hn::Load(D(), parameter.varying + i) : set(parameter.uniform);
}
HWY_INLINE V dot(const Vec3& a, const Vec3& b) { return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z))); }
HWY_INLINE Vec3 sub(const Vec3& a, const Vec3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE Vec3 add(const Vec3& a, const Vec3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE Vec3 scale(const Vec3& a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
HWY_INLINE Vec3 mul(const Vec3& a, const Vec3& b) { return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)}; }
/// a + b · s
HWY_INLINE Vec3 mul_add(const Vec3& b, V s, const Vec3& a) {
  return {hn::MulAdd(b.x, s, a.x), hn::MulAdd(b.y, s, a.y), hn::MulAdd(b.z, s, a.z)};
}
HWY_INLINE V clamp01(V v) { return hn::Min(hn::Max(v, hn::Zero(D())), set(1.0F)); }
/// a + (b − a) t
HWY_INLINE V mix(V a, V b, V t) { return hn::MulAdd(hn::Sub(b, a), t, a); }
HWY_INLINE Vec3 mix(const Vec3& a, const Vec3& b, V t) {
  return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
}
/// Unit length; 0 stays 0.
HWY_INLINE Vec3 normalized(const Vec3& v) {
  const V square = hn::Max(dot(v, v), set(1e-37F));
  return scale(v, hn::Div(set(1.0F), hn::Sqrt(square)));
}
/// 2^p for |p| < 126, within 10⁻⁷, relatively: interpolated at Chebyshev's nodes.
HWY_INLINE V quick_exp2(V p) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V whole = hn::Round(p);
  const V f = hn::Sub(p, whole);
  V sum = set(0.00133908634F);
  sum = hn::MulAdd(sum, f, set(0.00967603192F));
  sum = hn::MulAdd(sum, f, set(0.0555035711F));
  sum = hn::MulAdd(sum, f, set(0.240221075F));
  sum = hn::MulAdd(sum, f, set(0.693147188F));
  sum = hn::MulAdd(sum, f, set(1.0F));
  const auto exponent = hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127));
  return hn::Mul(sum, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
}

/// log2(x) of normal x > 0, within 2·10⁻⁶ of its own size: log2(1 + t) ÷ t interpolated for 1 + t in [√½, √2).
HWY_INLINE V quick_log2(V x) {
  const D d;
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3F3504F3)));
  const V t = hn::Sub(hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent))), set(1.0F));
  V sum = set(0.168186591F);
  sum = hn::MulAdd(sum, t, set(-0.267963871F));
  sum = hn::MulAdd(sum, t, set(0.296119557F));
  sum = hn::MulAdd(sum, t, set(-0.359524455F));
  sum = hn::MulAdd(sum, t, set(0.480613125F));
  sum = hn::MulAdd(sum, t, set(-0.721360179F));
  sum = hn::MulAdd(sum, t, set(1.44269652F));
  return hn::MulAdd(sum, t, hn::ConvertTo(d, exponent));
}

/// base^exponent for base in [0, 1]; 0 for 0.
HWY_INLINE V power(V base, V exponent) {
  const V small = set(1e-12F);
  const V log = quick_log2(hn::Max(base, small));
  const V value = quick_exp2(hn::Max(hn::Mul(exponent, log), set(-125.0F)));
  return hn::IfThenElseZero(hn::Gt(base, small), value);
}

void InterpolateWeights(FragmentBatch& batch, bool derivatives) {
  const D d;
  const V zero = hn::Zero(d);
  const V one = set(1.0F);
  for (std::size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    V x[3], y[3], z[3], inverse_w[3];
    for (int k = 0; k < 3; ++k) {
      hn::LoadInterleaved4(d, &batch.corners[static_cast<std::size_t>(k)][i].x, x[k], y[k], z[k], inverse_w[k]);
    }
    const V px = hn::Load(d, &batch.x[i]);
    const V py = hn::Load(d, &batch.y[i]);
    // Twice the areas opposite to the corners, each with the sign that it has inside.
    V dx[3], dy[3], area[3];
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3;
      const int b = (k + 2) % 3;
      dx[k] = hn::Sub(y[b], y[a]);
      dy[k] = hn::Sub(x[a], x[b]);
      area[k] = hn::MulAdd(dx[k], hn::Sub(px, x[a]), hn::Mul(dy[k], hn::Sub(py, y[a])));
    }
    const V whole = hn::MulAdd(hn::Sub(x[2], x[0]), hn::Sub(y[1], y[0]),
                               hn::Neg(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0]))));
    const auto back = hn::Lt(whole, zero);
    const V sign = hn::IfThenElse(back, set(-1.0F), one);
    hn::Store(sign, d, &batch.facing[i]);
    V weight[3], sum_area = zero, sum = zero;
    for (int k = 0; k < 3; ++k) {
      area[k] = hn::Max(hn::Mul(area[k], sign), zero);
      weight[k] = hn::Mul(area[k], inverse_w[k]);
      sum_area = hn::Add(sum_area, area[k]);
      sum = hn::Add(sum, weight[k]);
    }
    // Lines, points, and triangles thinner than a subpixel: along the longest side from the first corner.
    const V ex = hn::Sub(x[1], x[0]);
    const V ey = hn::Sub(y[1], y[0]);
    const V along = hn::MulAdd(ex, hn::Sub(px, x[0]), hn::Mul(ey, hn::Sub(py, y[0])));
    const V length = hn::MulAdd(ex, ex, hn::Mul(ey, ey));
    const V t = hn::IfThenElse(hn::Gt(length, zero), clamp01(hn::Div(along, hn::Max(length, set(1e-30F)))), zero);
    const auto thin = hn::Not(hn::Gt(sum_area, set(1e-20F)));
    area[0] = hn::IfThenElse(thin, hn::Sub(one, t), area[0]);
    area[1] = hn::IfThenElse(thin, t, area[1]);
    area[2] = hn::IfThenElse(thin, zero, area[2]);
    for (int k = 0; k < 3; ++k) weight[k] = hn::IfThenElse(thin, hn::Mul(area[k], inverse_w[k]), weight[k]);
    sum_area = hn::IfThenElse(thin, one, sum_area);
    sum = hn::IfThenElse(thin, hn::Add(weight[0], weight[1]), sum);

    const V inverse = hn::Div(one, sum);
    hn::Store(hn::Mul(sum_area, inverse), d, &batch.w[i]);
    const V depth = hn::MulAdd(area[0], z[0], hn::MulAdd(area[1], z[1], hn::Mul(area[2], z[2])));
    hn::Store(hn::Div(depth, sum_area), d, &batch.z[i]);
    for (int k = 0; k < 3; ++k) {
      weight[k] = hn::Mul(weight[k], inverse);
      hn::Store(weight[k], d, &batch.weights[static_cast<std::size_t>(k)][i]);
    }
    if (!derivatives) continue;
    V along_x[3], along_y[3], sum_x = zero, sum_y = zero;
    for (int k = 0; k < 3; ++k) {
      const V factor = hn::IfThenZeroElse(thin, hn::Mul(sign, inverse_w[k]));
      along_x[k] = hn::Mul(dx[k], factor);
      along_y[k] = hn::Mul(dy[k], factor);
      sum_x = hn::Add(sum_x, along_x[k]);
      sum_y = hn::Add(sum_y, along_y[k]);
    }
    for (std::size_t k = 1; k < 3; ++k) {
      hn::Store(hn::Mul(hn::NegMulAdd(weight[k], sum_x, along_x[k]), inverse), d, &batch.weights_dx[k - 1][i]);
      hn::Store(hn::Mul(hn::NegMulAdd(weight[k], sum_y, along_y[k]), inverse), d, &batch.weights_dy[k - 1][i]);
    }
  }
}

void InterpolatePositions(FragmentBatch& batch, const ShadingView& view) {
  const D d;
  const Vec3 base = set(view.base);
  const Vec3 at_zero = set(view.at_zero);
  const Vec3 per_x = set(view.per_x);
  const Vec3 per_y = set(view.per_y);
  const Vec3 per_z = set(view.per_z);
  for (std::size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    const V s = view.perspective ? hn::Load(d, &batch.w[i]) : set(1.0F);
    const Vec3 ray = mul_add(per_y, hn::Load(d, &batch.y[i]), mul_add(per_x, hn::Load(d, &batch.x[i]), at_zero));
    store(mul_add(ray, s, mul_add(per_z, hn::Load(d, &batch.z[i]), base)), batch.position, i);
  }
}

void InterpolateNormals(FragmentBatch& batch) {
  const D d;
  const glm::mat3& m = batch.instance->world_from_normal;
  for (std::size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    Vec3 sum{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 n;
      V unused;
      hn::LoadInterleaved4(d, &batch.corner_normals[k][i].x, n.x, n.y, n.z, unused);
      sum = mul_add(n, hn::Load(d, &batch.weights[k][i]), sum);
    }
    Vec3 world = scale(set(m[0]), sum.x);
    world = mul_add(set(m[1]), sum.y, world);
    world = normalized(mul_add(set(m[2]), sum.z, world));
    store(scale(world, hn::Load(d, &batch.facing[i])), batch.normal, i);
  }
}

/// A material at a vector of fragments.
struct Surface {
  Vec3 diffuse;
  Vec3 specular;
  V exponent;
};

/// A light as it falls on a vector of positions: toward it, and how much of it arrives.
struct Incoming {
  Vec3 direction;
  Vec3 amount;
};

HWY_INLINE Incoming incoming(const ShadingLight& light, const Vec3& position) {
  if (light.kind == LightKind::Directional) return {set(-light.direction), set(light.color)};
  const Vec3 to_light = sub(set(light.position), position);
  const V square = hn::Max(dot(to_light, to_light), set(1e-12F));
  const V inverse_square = hn::Div(set(1.0F), square);
  V amount = inverse_square;
  if (light.range > 0) {
    const V ratio = hn::Mul(square, set(1.0F / (light.range * light.range)));
    amount = hn::Mul(amount, clamp01(hn::NegMulAdd(ratio, ratio, set(1.0F))));
  }
  const Vec3 direction = scale(to_light, hn::Sqrt(inverse_square));
  if (light.kind == LightKind::Spot) {
    const V cosine = hn::Neg(dot(direction, set(light.direction)));
    const float width = std::max(light.cos_inner - light.cos_outer, 1e-4F);
    const V inside = clamp01(hn::Mul(hn::Sub(cosine, set(light.cos_outer)), set(1.0F / width)));
    amount = hn::Mul(amount, hn::Mul(inside, inside));
  }
  return {direction, scale(set(light.color), amount)};
}

/// Light from everywhere as it comes from a direction; the horizon is `sharpness` times narrower than for a rough surface.
HWY_INLINE Vec3 surroundings(const Lighting& lighting, const Vec3& direction, V sharpness) {
  const V up = hn::Mul(dot(direction, set(lighting.up)), sharpness);
  return mix(set(lighting.ground), set(lighting.sky), clamp01(hn::MulAdd(up, set(0.5F), set(0.5F))));
}

/// I = k_a I_a + Σ I_l (k_d N·L + k_s (V·R)^n), products clamped at 0.
HWY_INLINE Vec3 phong(const Surface& s, const Vec3& ambient, const Vec3& n, const Vec3& v, const Vec3& p,
                      const Lighting& lighting) {
  const D d;
  const V zero = hn::Zero(d);
  Vec3 sum = mul(ambient, surroundings(lighting, n, set(1.0F)));
  for (const ShadingLight& each : lighting.lights) {
    const Incoming light = incoming(each, p);
    const V nl = dot(n, light.direction);
    if (hn::AllFalse(d, hn::Gt(nl, zero))) continue;
    const V lit = hn::Max(nl, zero);
    // R = 2 (N·L) N − L
    const Vec3 r = sub(scale(n, hn::Add(nl, nl)), light.direction);
    const V highlight = hn::IfThenElseZero(hn::Gt(nl, zero), power(clamp01(dot(v, r)), s.exponent));
    sum = add(sum, mul(light.amount, mul_add(s.specular, highlight, scale(s.diffuse, lit))));
  }
  return sum;
}

/// Metal-rough as energy-keeping Blinn–Phong: exponent 2 ÷ α² − 2, factor (n + 2) ÷ 8, Fresnel by Schlick.
HWY_INLINE Vec3 metal_rough(const Surface& s, V roughness, V occlusion, const Vec3& n, const Vec3& v, const Vec3& p,
                            const Lighting& lighting) {
  const D d;
  const V zero = hn::Zero(d);
  const V one = set(1.0F);
  const V nv = clamp01(dot(n, v));
  const V factor = hn::Mul(hn::Add(s.exponent, set(2.0F)), set(0.125F));
  Vec3 sum{zero, zero, zero};
  for (const ShadingLight& each : lighting.lights) {
    const Incoming light = incoming(each, p);
    const V nl = hn::Max(dot(n, light.direction), zero);
    if (hn::AllFalse(d, hn::Gt(nl, zero))) continue;
    const Vec3 h = normalized(add(light.direction, v));
    const V miss = hn::Sub(one, clamp01(dot(v, h)));
    const V square = hn::Mul(miss, miss);
    const V fresnel = hn::Mul(hn::Mul(square, square), miss);
    const V lobe = hn::Mul(factor, power(clamp01(dot(n, h)), s.exponent));
    const Vec3 reflected = scale(mix(s.specular, {one, one, one}, fresnel), lobe);
    sum = add(sum, mul(light.amount, scale(add(s.diffuse, reflected), nl)));
  }
  // What comes from everywhere: diffusely by the normal, mirrored by the reflected ray, of which the surface sends back
  // F0 · a + b. Source: Lazarov, Getting more physical in Call of Duty: Black Ops II, 2013, as refitted by Karis, 2014.
  const V r0 = hn::Sub(one, roughness);
  const V r1 = hn::MulAdd(roughness, set(-0.0275F), set(0.0425F));
  const V a004 = hn::MulAdd(hn::Min(hn::Mul(r0, r0), quick_exp2(hn::Mul(nv, set(-9.28F)))), r0, r1);
  const V a = hn::MulAdd(a004, set(-1.04F), hn::MulAdd(roughness, set(-0.572F), set(1.04F)));
  const V b = hn::MulAdd(a004, set(1.04F), hn::MulAdd(roughness, set(0.022F), set(-0.04F)));
  const Vec3 mirror = sub(scale(n, hn::Mul(set(2.0F), dot(n, v))), v);
  const V sharpness = hn::Div(one, hn::MulAdd(roughness, set(0.8F), set(0.2F)));
  const Vec3 seen = mix(surroundings(lighting, mirror, sharpness), surroundings(lighting, n, one), roughness);
  const Vec3 sent_back = mul(seen, mul_add(s.specular, a, {b, b, b}));
  const Vec3 everywhere = add(mul(s.diffuse, surroundings(lighting, n, set(1.0F))), sent_back);
  return mul_add(everywhere, occlusion, sum);
}

void Light(FragmentBatch& batch, const ShadingView& view, const Lighting& lighting) {
  const D d;
  const Material& material = batch.material->material;
  const V one = set(1.0F);
  for (std::size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    const Vec3 base{load(batch.base_color[0], i), load(batch.base_color[1], i), load(batch.base_color[2], i)};
    Vec3 color = base;
    if (material.model != MaterialModel::Unlit) {
      const Vec3 n = load(batch.normal, i);
      const Vec3 p = load(batch.position, i);
      const Vec3 v = view.perspective ? normalized(sub(set(view.eye), p)) : set(-view.forward);
      const Vec3 specular{load(batch.specular[0], i), load(batch.specular[1], i), load(batch.specular[2], i)};
      if (material.model == MaterialModel::Phong) {
        color = phong({base, specular, set(material.shininess)}, mul(base, set(material.ambient)), n, v, p, lighting);
      } else {
        const V metallic = clamp01(load(batch.metallic, i));
        const V roughness = hn::Min(hn::Max(load(batch.roughness, i), set(0.08F)), one);
        const V alpha = hn::Mul(roughness, roughness);
        const V exponent = hn::Sub(hn::Div(set(2.0F), hn::Mul(alpha, alpha)), set(2.0F));
        const V dielectric = set(0.04F);
        const Surface surface{scale(base, hn::Sub(one, metallic)),
                              mix({dielectric, dielectric, dielectric}, base, metallic), exponent};
        color = metal_rough(surface, roughness, load(batch.occlusion, i), n, v, p, lighting);
      }
      color = add(color, {load(batch.emissive[0], i), load(batch.emissive[1], i), load(batch.emissive[2], i)});
    }
    hn::Store(color.x, d, &batch.color[0][i]);
    hn::Store(color.y, d, &batch.color[1][i]);
    hn::Store(color.z, d, &batch.color[2][i]);
    hn::Store(clamp01(load(batch.base_color[3], i)), d, &batch.color[3][i]);
  }
}

void InterleaveColors(const FragmentBatch& batch, bool opaque, glm::vec4* result) {
  const D d;
  for (std::size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    hn::StoreInterleaved4(hn::Load(d, &batch.color[0][i]), hn::Load(d, &batch.color[1][i]),
                          hn::Load(d, &batch.color[2][i]), opaque ? set(1.0F) : hn::Load(d, &batch.color[3][i]), d,
                          &result[i].x);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(InterpolateWeights);
HWY_EXPORT(InterpolatePositions);
HWY_EXPORT(InterpolateNormals);
HWY_EXPORT(Light);
HWY_EXPORT(InterleaveColors);

void interpolate_weights(FragmentBatch& batch, bool derivatives) {
  HWY_DYNAMIC_DISPATCH(InterpolateWeights)(batch, derivatives);
}
void interpolate_positions(FragmentBatch& batch, const ShadingView& view) {
  HWY_DYNAMIC_DISPATCH(InterpolatePositions)(batch, view);
}
void interpolate_normals(FragmentBatch& batch) { HWY_DYNAMIC_DISPATCH(InterpolateNormals)(batch); }
void light(FragmentBatch& batch, const ShadingView& view, const Lighting& lighting) {
  HWY_DYNAMIC_DISPATCH(Light)(batch, view, lighting);
}

void interleave_colors(const FragmentBatch& batch, bool opaque, glm::vec4* result) {
  HWY_DYNAMIC_DISPATCH(InterleaveColors)(batch, opaque, result);
}

}  // namespace azulejo::kernels
#endif
