#pragma once

#include "base/gl/texture.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/detail_kernels.h"
#include "tests/oracle/luma.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace mfar {

/// A still, and a video that shows the same surface with a given flow.
struct SeenStill {
    /// `luma`: grey level at a position in the still. `flow`: true flow at a position in the video.
    /// Pixels of the video are means over their area, so that fine structure aliases.
    SeenStill(const StereoRig& cameras, const std::function<double(const Eigen::Vector2d&)>& luma,
              const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& flow);

    /// Valid as long as this object.
    [[nodiscard]] simd::StillPairs pairs() const {
        return {words.data(), rig.still.size.width, rig.still.size};
    }
    [[nodiscard]] gpu::Texture stillTexture() const;
    [[nodiscard]] gpu::Texture videoTexture() const;

    StereoRig rig;
    twin::Grey still, grey;  ///< grey: luma of the video
    RgbPlanes video;

private:
    std::vector<std::uint8_t> pixels;  // RGBA8
    std::vector<std::uint16_t> words;
};

}  // namespace mfar
