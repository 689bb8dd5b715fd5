#pragma once

#include <Eigen/Core>

namespace mfar {

/// Smooth noise in [-1, 1] with features of size 1. It depends only on the point. Source: Perlin,
/// An Image Synthesizer, SIGGRAPH 1985 (lattice noise, here with values instead of gradients).
[[nodiscard]] float valueNoise(const Eigen::Vector3f& p);

/// Sum of valueNoise() over `octaves`. Each octave has half the feature size and half the strength
/// of the octave before. The result is about in [-1, 1].
[[nodiscard]] float fractalNoise(const Eigen::Vector3f& p, int octaves);

}  // namespace mfar
