#pragma once

#include <Eigen/Core>

namespace mfar {

/// Smooth noise in [-1, 1] with features of size 1: the same place always has the same value.
/// Source: Perlin, An Image Synthesizer, SIGGRAPH 1985 (lattice noise, here of values).
[[nodiscard]] float valueNoise(const Eigen::Vector3f& p);

/// Sum of `octaves` of it, each of half the size and strength; about [-1, 1].
[[nodiscard]] float fractalNoise(const Eigen::Vector3f& p, int octaves);

}  // namespace mfar
