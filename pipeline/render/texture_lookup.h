#pragma once

#include "pipeline/scene/scene.h"

#include <Eigen/Core>

namespace mfar {

/// Returns linear RGBA in [0, 1], interpolated between the four nearest texels. sRGB colours are
/// decoded first. `uv` must be finite.
[[nodiscard]] Eigen::Vector4f lookUp(const SurfaceTexture& texture, const Eigen::Vector2f& uv);

}  // namespace mfar
