#include "azulejo/operations.h"

#include <array>

namespace azulejo {

// One line an operation, in the order of their names.
// clang-format off
#define AZULEJO_OPERATIONS(operation) \
  operation(kAdd)                     \
  operation(kAnnotate)                \
  operation(kBilateral)               \
  operation(kBlend)                   \
  operation(kBox)                     \
  operation(kBrightnessContrast)      \
  operation(kChannels)                \
  operation(kChart)                   \
  operation(kClahe)                   \
  operation(kClassifyPoints)          \
  operation(kClip)                    \
  operation(kColorBy)                 \
  operation(kColorSpace)              \
  operation(kCompare)                 \
  operation(kContrastStretch)         \
  operation(kConvert)                 \
  operation(kConvexHull)              \
  operation(kConvolve)                \
  operation(kCrop)                    \
  operation(kCurve)                   \
  operation(kDecimate)                \
  operation(kDifference)              \
  operation(kDistance)                \
  operation(kDivide)                  \
  operation(kDraw)                    \
  operation(kEqualize)                \
  operation(kExposure)                \
  operation(kFalseColor)              \
  operation(kFrequencyFilter)         \
  operation(kGamma)                   \
  operation(kGaussian)                \
  operation(kGlyphs)                  \
  operation(kGrayscale)               \
  operation(kHeightField)             \
  operation(kHighBoost)               \
  operation(kHighPass)                \
  operation(kHistogram)               \
  operation(kInvert)                  \
  operation(kKernelResponse)          \
  operation(kLaplacian)               \
  operation(kLevelSlice)              \
  operation(kLut)                     \
  operation(kMask)                    \
  operation(kMatchHistogram)          \
  operation(kMeasure)                 \
  operation(kMedian)                  \
  operation(kMultiply)                \
  operation(kNoise)                   \
  operation(kNormals)                 \
  operation(kOffset)                  \
  operation(kPad)                     \
  operation(kPathBoolean)             \
  operation(kPosterize)               \
  operation(kPrimitive)               \
  operation(kPseudoColor)             \
  operation(kQuantize)                \
  operation(kRender)                  \
  operation(kRepair)                  \
  operation(kResize)                  \
  operation(kSample)                  \
  operation(kSamplePoints)            \
  operation(kSmooth)                  \
  operation(kSobel)                   \
  operation(kSpectrum)                \
  operation(kStatistics)              \
  operation(kSubdivide)               \
  operation(kSubtract)                \
  operation(kSurface)                 \
  operation(kTangents)                \
  operation(kTessellate)              \
  operation(kTestPattern)             \
  operation(kThreshold)               \
  operation(kTimeSample)              \
  operation(kTopology)                \
  operation(kTransform)               \
  operation(kUnsharpMask)             \
  operation(kWeightedMedian)          \
  operation(kWeld)                    \
  operation(kWingedEdge)              \
  operation(kWireframe)               \
  operation(kWithin)
// clang-format on

#define AZULEJO_DECLARE(name) extern const Operation name;
AZULEJO_OPERATIONS(AZULEJO_DECLARE)

#define AZULEJO_ADDRESS(name) &(name),
std::span<const Operation* const> operations() {
  static constexpr std::array list{AZULEJO_OPERATIONS(AZULEJO_ADDRESS)};
  return list;
}

const Operation* find_operation(std::string_view name) {
  for (const Operation* each : operations()) {
    if (each->name == name) return each;
  }
  return nullptr;
}

}  // namespace azulejo
