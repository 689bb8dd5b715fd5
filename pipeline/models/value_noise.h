#pragma once

#include <Eigen/Core>

namespace mfar {

/// Smooth noise in [-1, 1] with features of size 1; a fixed function of the point. Source: Perlin,
/// An Image Synthesizer, SIGGRAPH 1985 (lattice noise, here with values instead of gradients).
[[nodiscard]] float valueNoise(const Eigen::Vector3f& p);

/// Sum of `octaves` of valueNoise(), each with half the size and strength of the one before; about
/// [-1, 1].
[[nodiscard]] float fractalNoise(const Eigen::Vector3f& p, int octaves);

}  // namespace mfar
