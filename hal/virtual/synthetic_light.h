#pragma once

#include "hal/virtual/synthetic_scene.h"
#include "hal/virtual/synthetic_store.h"

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <vector>

namespace mfar::synthetic {

/// The light that arrives at every surface: the key light with soft shadows, the ambient light with
/// occlusion, and the light of one reflection. It is ray traced once, with every primitive in the
/// pose T_world_prim.
struct LightMap {
    /// Irradiance / kFullScale * 255, per channel. The 3 x 2 faces (axis, sign) of a primitive are
    /// side by side. Moving objects cast no shadow.
    cv::Mat4b texels;
    /// For each primitive, in texture coordinates: x and y of its first face, and width and height
    /// of one face.
    std::vector<Eigen::Vector4f> faces;

    static constexpr double kFullScale = 1.6;
    /// Returns half a texel as a fraction of a face's side. Bilinear look-ups that keep this margin
    /// stay inside the face.
    [[nodiscard]] static double inset(int lightTexels) { return 0.5 / lightTexels; }
};

[[nodiscard]] LightMap bakeLight(const World& world, const TexelStore& store);

}  // namespace mfar::synthetic
