#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace azulejo::kernels {

/// transform_point of `count` points of two or three numbers each; `target` may be `source`.
void transform_affine2(const glm::mat3& m, const float* source, float* target, std::size_t count);
void transform_projective2(const glm::mat3& m, const float* source, float* target, std::size_t count);
void transform_affine3(const glm::mat4& m, const float* source, float* target, std::size_t count);
void transform_projective3(const glm::mat4& m, const float* source, float* target, std::size_t count);

}  // namespace azulejo::kernels
