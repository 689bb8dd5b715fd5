#pragma once

#include "pipeline/scene/scene.h"

#include <Eigen/Core>

namespace mfar {

/// Linear RGBA in [0, 1] between the four nearest texels. Decodes sRGB colours before it
/// interpolates. `uv` finite.
[[nodiscard]] Eigen::Vector4f lookUp(const SurfaceTexture& texture, const Eigen::Vector2f& uv);

}  // namespace mfar
