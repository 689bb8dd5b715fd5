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
    /// A pixel of the video is the mean over its area, so that fine structure aliases. `light`
    /// selects the kind of mean: 0 of grey levels, 1 of their squares, see Guidance::light.
    SeenStill(const StereoRig& cameras, const std::function<double(const Eigen::Vector2d&)>& luma,
              const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& flow, double light = 0);

    // The views are valid as long as this object exists.
    [[nodiscard]] simd::StillPairs pairs() const {
        return {words_.data(), rig.still.size.width, rig.still.size};
    }
    [[nodiscard]] ImageView videoView() const {
        return {pixels_.data(), rig.video.size, 4UL * rig.video.size.width, PixelFormat::Rgba8};
    }
    [[nodiscard]] ImageView stillView() const {
        return {bytes_.data(), rig.still.size, static_cast<std::size_t>(rig.still.size.width),
                PixelFormat::Gray8};
    }
    [[nodiscard]] gpu::Texture stillTexture() const;
    [[nodiscard]] gpu::Texture videoTexture() const;

    StereoRig rig;
    twin::Grey still, grey;  ///< grey: luma of the video
    RgbPlanes video;

private:
    std::vector<std::uint8_t> bytes_, pixels_;  // of the still (grey) and of the video (RGBA8)
    std::vector<std::uint16_t> words_;
};

}  // namespace mfar
