#include "azulejo/imaging/affine.h"

#include <opencv2/imgproc.hpp>
#include <string>

#include "azulejo/math/transform2d.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

struct Peer {
  AffineFilter filter;
  int interpolation;  ///< of OpenCV
};

/// OpenCV looks up positions in steps of 1/32 pixel, and weights of 15 bits: `tolerance` is what that costs on the edges
/// of the picture; and that it mixes the colors of RGBA whatever their alpha.
void beside_opencv(Bench& bench, const std::string& name, const glm::dmat3& m, const Peer& peer, PixelType type,
                   int channels, double tolerance, double aim) {
  bench.image_row(
      {.name = name,
       .source = photo(type, channels, kFullHd),
       .ours =
           [m, peer](const ConstAnyView& source, const AnyView& result, const Run& run) {
             affine(source, result,
                    {.target_from_source = m, .filter = peer.filter, .light = Light::Encoded, .border = Border::Mirror},
                    run);
           },
       .peer =
           [m, peer](const ConstAnyView& source, const AnyView& result) {
             // Their pixel centers are whole numbers.
             const glm::dmat3 t = Translation2d{{-0.5, -0.5}}.matrix() * m * Translation2d{{0.5, 0.5}}.matrix();
             const cv::Matx23d matrix(t[0].x, t[1].x, t[2].x, t[0].y, t[1].y, t[2].y);
             cv::Mat to = mat(result);
             cv::warpAffine(mat(source), to, matrix, to.size(), peer.interpolation, cv::BORDER_REFLECT_101);
           },
       .tolerance = tolerance,
       .aim = aim});
}

const Rows kRows([](Bench& bench) {
  const glm::dvec2 center{960, 540};
  const glm::dmat3 turn = Rotation2d(0.3, center).matrix();
  const Peer bilinear{AffineFilter::Bilinear, cv::INTER_LINEAR};
  const Peer bicubic{AffineFilter::Bicubic, cv::INTER_CUBIC};
  for (const int channels : {1, 3, 4})
    beside_opencv(bench, "affine bilinear", turn, bilinear, PixelType::U8, channels, channels == 4 ? 32 : 16, 2);
  beside_opencv(bench, "affine bilinear", turn, bilinear, PixelType::F32, 3, 0.06, 2);
  for (const int channels : {1, 3})
    beside_opencv(bench, "affine bicubic", turn, bicubic, PixelType::U8, channels, 40, 2);
});

}  // namespace
}  // namespace azulejo::bench
