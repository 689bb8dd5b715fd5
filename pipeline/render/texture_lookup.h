#pragma once

#include "pipeline/scene/scene.h"

#include <Eigen/Core>

namespace mfar {

/// Linear RGBA in [0, 1], interpolated between the four nearest texels. sRGB colours are decoded
/// before the interpolation. `uv` must be finite.
[[nodiscard]] Eigen::Vector4f lookUp(const SurfaceTexture& texture, const Eigen::Vector2f& uv);

}  // namespace mfar
