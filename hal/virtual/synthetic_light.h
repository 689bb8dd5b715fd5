#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <vector>

namespace mfar::synthetic {

/// Light that arrives at every surface: soft shadow of the key light, ambient occlusion and one
/// bounce, ray traced once for the world at time 0.
struct LightMap {
    /// Irradiance / kFullScale per channel. Each primitive has 3 x 2 faces (axis, sign) side by
    /// side; moving objects cast no shadow here.
    cv::Mat4b texels;
    /// Per primitive, in texture coordinates: x, y of its first face, width and height of a face.
    std::vector<Eigen::Vector4f> faces;

    static constexpr double kFullScale = 1.6;
    /// Half a texel as a fraction of a face: keeps bilinear look-ups inside the face.
    [[nodiscard]] static double inset(int lightTexels) { return 0.5 / lightTexels; }
};

[[nodiscard]] LightMap bakeLight(const World& world);

}  // namespace mfar::synthetic
