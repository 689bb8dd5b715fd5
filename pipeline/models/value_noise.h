#pragma once

#include <Eigen/Core>

namespace mfar {

/// Returns smooth noise in [-1, 1] with features of size 1. Equal points give equal noise. Source:
/// Perlin, An Image Synthesizer, SIGGRAPH 1985 (lattice noise, here with values instead of
/// gradients).
[[nodiscard]] float valueNoise(const Eigen::Vector3f& p);

/// Returns the sum of `octaves` octaves of valueNoise(), about in [-1, 1]. Each octave has half the
/// feature size and half the strength of the octave before.
[[nodiscard]] float fractalNoise(const Eigen::Vector3f& p, int octaves);

}  // namespace mfar
