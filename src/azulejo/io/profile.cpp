#include "azulejo/io/profile.h"

#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

/// Half a step of 8 bits: profiles that differ less are the same.
constexpr float kSameColor = 0.5F / 255;

struct ContextDeleter {
  void operator()(cmsContext context) const { cmsDeleteContext(context); }
};
struct ProfileDeleter {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
struct TransformDeleter {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
using Context = std::unique_ptr<std::remove_pointer_t<cmsContext>, ContextDeleter>;
using Profile = std::unique_ptr<void, ProfileDeleter>;
using Transform = std::unique_ptr<void, TransformDeleter>;

/// A context of our own: the default one is the whole process's, and another library may make it print.
Context make_context() { return Context(cmsCreateContext(nullptr, nullptr)); }

Profile open_profile(const Context& context, std::span<const std::uint8_t> icc) {
  return Profile(cmsOpenProfileFromMemTHR(context.get(), icc.data(), static_cast<cmsUInt32Number>(icc.size())));
}

cmsUInt32Number pixel_format(PixelType type, unsigned space, unsigned colors, bool alpha) {
  const unsigned bytes = static_cast<unsigned>(size_of(type));
  return FLOAT_SH(type == PixelType::F32 ? 1U : 0U) | COLORSPACE_SH(space) | CHANNELS_SH(colors) | BYTES_SH(bytes) |
         EXTRA_SH(alpha ? 1U : 0U);
}

/// sRGB for colours, its curve on neutral gray for gray.
Profile srgb_profile(const Context& context, bool gray) {
  Profile rgb(cmsCreate_sRGBProfileTHR(context.get()));
  if (!gray || !rgb) return rgb;
  const auto* const curve = static_cast<const cmsToneCurve*>(cmsReadTag(rgb.get(), cmsSigGreenTRCTag));
  return Profile(cmsCreateGrayProfileTHR(context.get(), cmsD50_xyY(), curve));
}

struct Formats {
  cmsUInt32Number from = 0;
  cmsUInt32Number to = 0;
};

Transform make_transform(const Context& context, const Profile& from, const Profile& to, const Formats& formats) {
  return Transform(cmsCreateTransformTHR(context.get(), from.get(), formats.from, to.get(), formats.to,
                                         INTENT_RELATIVE_COLORIMETRIC,
                                         cmsFLAGS_NOCACHE | cmsFLAGS_COPY_ALPHA | cmsFLAGS_BLACKPOINTCOMPENSATION));
}

/// Whether colours spread over the whole range stay where they are.
bool changes_nothing(const Context& context, const Profile& from, const Profile& to, bool gray) {
  const unsigned space = gray ? PT_GRAY : PT_RGB;
  const unsigned colors = gray ? 1 : 3;
  const cmsUInt32Number format = pixel_format(PixelType::F32, space, colors, false);
  const Transform transform = make_transform(context, from, to, {format, format});
  if (!transform) return false;
  constexpr std::array<float, 7> kLevels = {0, 0.05F, 0.2F, 0.4F, 0.6F, 0.8F, 1};
  std::vector<float> probes;
  for (const float red : kLevels) {
    for (const float green : kLevels) {
      for (const float blue : kLevels) probes.insert(probes.end(), {red, green, blue});
    }
  }
  std::vector<float> moved(probes.size());
  cmsDoTransform(transform.get(), probes.data(), moved.data(), static_cast<cmsUInt32Number>(probes.size() / colors));
  return std::equal(probes.begin(), probes.end(), moved.begin(),
                    [](float a, float b) { return std::abs(a - b) <= kSameColor; });
}

class ProfileTransform final : public ColorTransform {
 public:
  ProfileTransform(Context context, Transform transform, bool percent)
      : context_(std::move(context)), transform_(std::move(transform)), percent_(percent) {}

  void apply(const ConstAnyView& source, const AnyView& result) const override {
    const auto width = static_cast<cmsUInt32Number>(source.width());
    std::vector<float> scaled;
    for (int y = 0; y < source.height(); ++y) {
      const void* row = source.row(y);
      if (percent_) {  // Little CMS counts floating ink from 0 to 100
        const float* const inks = source.as<float>().row(y);
        scaled.resize(std::size_t{width} * 4);
        std::transform(inks, inks + scaled.size(), scaled.begin(), [](float ink) { return ink * 100; });
        row = scaled.data();
      }
      cmsDoTransform(transform_.get(), row, result.row(y), width);
    }
  }

 private:
  Context context_;
  Transform transform_;
  bool percent_;
};

class InkTransform final : public ColorTransform {
 public:
  void apply(const ConstAnyView& source, const AnyView& result) const override {
    visit(source, [&](auto inks) {
      using T = std::remove_const_t<std::remove_pointer_t<decltype(inks.data)>>;
      const auto colors = result.as<T>();
      for (int y = 0; y < inks.height; ++y) {
        const auto* in = inks.row(y);
        T* out = colors.row(y);
        for (int x = 0; x < inks.width; ++x, in += 4, out += 3) {
          for (int c = 0; c < 3; ++c) out[c] = remaining<T>(in[c], in[3]);
        }
      }
    });
  }

 private:
  template <class T>
  static T remaining(T ink, T black) {
    if constexpr (std::is_same_v<T, float>) {
      return (1 - ink) * (1 - black);
    } else {
      constexpr std::uint64_t kFull = std::is_same_v<T, std::uint8_t> ? 255 : 65535;
      return static_cast<T>(((kFull - ink) * (kFull - black) + kFull / 2) / kFull);
    }
  }
};

/// value to the power of `exponent`, for values of 0–1: the same on every machine.
float power(float value, float exponent) {
  constexpr float kSmallest = -120;  // 2 to it is nothing beside an integer's step
  if (value <= 0) return 0;
  const float bits = exponent * log2_deterministic(value);
  return bits < kSmallest ? 0.0F : exp2_deterministic(bits);
}

class TableTransform final : public ColorTransform {
 public:
  TableTransform(float exponent, const ImageInfo& source) {
    const auto full = static_cast<std::size_t>(full_range(source.type));
    table_.resize(full + 1);
    for (std::size_t i = 0; i <= full; ++i) {
      const float light = power(static_cast<float>(i) / static_cast<float>(full), 1 / exponent);
      table_[i] = static_cast<std::uint16_t>(linear_to_srgb(light) * static_cast<float>(full) + 0.5F);
    }
  }

  void apply(const ConstAnyView& source, const AnyView& result) const override {
    visit(source, [&](auto stored) {
      using T = std::remove_const_t<std::remove_pointer_t<decltype(stored.data)>>;
      if constexpr (!std::is_same_v<T, float>) {
        const auto channels = static_cast<std::size_t>(source.info.channels);
        const auto colors = static_cast<std::size_t>(source.info.color_channels());
        const auto samples = static_cast<std::size_t>(source.width()) * channels;
        for (int y = 0; y < source.height(); ++y) {
          const auto* const in = stored.row(y);
          T* const out = result.as<T>().row(y);
          for (std::size_t i = 0; i < samples; ++i) {
            out[i] = i % channels < colors ? static_cast<T>(table_[in[i]]) : in[i];
          }
        }
      }
    });
  }

 private:
  std::vector<std::uint16_t> table_;
};

}  // namespace

std::string profile_description(std::span<const std::uint8_t> icc) {
  const Context context = make_context();
  const Profile profile = open_profile(context, icc);
  if (!profile) return {};
  std::array<char, 256> text = {};
  cmsGetProfileInfoASCII(profile.get(), cmsInfoDescription, "en", "US", text.data(),
                         static_cast<cmsUInt32Number>(text.size() - 1));
  std::string result = text.data();
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
  return result;
}

ProfileConversion profile_to_srgb(std::span<const std::uint8_t> icc, const ImageInfo& source, bool cmyk,
                                  const std::string& name, const Run& run) {
  const auto left_out = [&](const char* why) {
    warn(run, fmt::format("{}: the embedded color profile {}, left out", name, why));
    return ProfileConversion{};
  };
  Context context = make_context();
  const Profile profile = open_profile(context, icc);
  if (!profile) return left_out("can't be read");
  const bool gray = source.color_channels() < 3;
  const cmsColorSpaceSignature wanted = cmyk ? cmsSigCmykData : gray ? cmsSigGrayData : cmsSigRgbData;
  if (cmsGetColorSpace(profile.get()) != wanted || (!cmyk && source.color_channels() % 2 == 0)) {
    return left_out("is for other channels than the image has");
  }
  const Profile srgb = srgb_profile(context, gray);
  if (!cmyk && changes_nothing(context, profile, srgb, gray)) return {.transform = nullptr, .understood = true};
  const bool alpha = !cmyk && source.alpha != AlphaState::None;
  const cmsUInt32Number result = pixel_format(source.type, gray ? PT_GRAY : PT_RGB, gray ? 1 : 3, alpha);
  const cmsUInt32Number stored = cmyk ? pixel_format(source.type, PT_CMYK, 4, false) : result;
  Transform transform = make_transform(context, profile, srgb, {stored, result});
  if (!transform) return left_out("can't be used");
  const bool percent = cmyk && source.type == PixelType::F32;
  return {std::make_unique<ProfileTransform>(std::move(context), std::move(transform), percent), true};
}

std::unique_ptr<ColorTransform> cmyk_to_srgb() { return std::make_unique<InkTransform>(); }

std::unique_ptr<ColorTransform> gamma_to_srgb(float exponent, const ImageInfo& source) {
  // 1 / 2.2 stands for sRGB in files that say no more: its writers mean the screen's curve.
  constexpr float kScreen = 1 / 2.2F;
  const bool usable = exponent > 0.01F && exponent < 100 && source.type != PixelType::F32;
  if (!usable || std::abs(exponent - kScreen) < 0.01F) return nullptr;
  return std::make_unique<TableTransform>(exponent, source);
}

}  // namespace azulejo
