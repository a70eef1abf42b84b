#pragma once

namespace azulejo::kernels {

/// One stage of Stockham's transform: sequences of length n · stride, `stride` of them interleaved, are split by radix.
/// Numbers count vectors of FourierPlan::kLanes lanes. With m = n / radix, for p < m, q < stride, j < radix:
/// to[q + stride · (radix · p + j)] = e^(−2πi pj/n) · Σ_k e^(−2πi jk/radix) · from[q + stride · (p + k · m)]
/// factors  cosine and −sine of 2π pj/n for j in 1 … radix − 1, p after p
struct FourierStage {
  int radix;
  int n;
  int stride;
  const float* factors;
};

void fourier_stage(const FourierStage& stage, const float* from_re, const float* from_im, float* to_re, float* to_im);

}  // namespace azulejo::kernels
