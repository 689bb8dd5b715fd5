#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/flow/luma_layout.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar {

[[nodiscard]] params::Rig rigParams(const StereoRig& rig);

/// Luma pyramids on the GPU, from either engine.
struct LumaOnGpu {
    const std::vector<LumaLevel>&video, &still;
    const gpu::Buffer& words;
};

/// Luma pyramids of the video frame and of the still in the video's geometry (rotation and both
/// lenses applied, no parallax), smoothed alike: 8 bits per pixel, four pixels per word, in one
/// storage buffer. They are the inputs of flow.
class LumaPyramids {
public:
    explicit LumaPyramids(Size video);

    /// From the video frame (RGBA8 texture of the video's size).
    void buildVideo(const gpu::Texture& video);
    /// From a still (RGBA8 texture, linear filter), through the rig. Called once per still.
    void buildStill(const gpu::Texture& still, const StereoRig& rig);
    /// From a picture that already has the video's geometry (flow between two frames).
    void buildSecond(const gpu::Texture& picture);

    [[nodiscard]] const std::vector<LumaLevel>& video() const { return video_; }
    [[nodiscard]] const std::vector<LumaLevel>& still() const { return still_; }
    [[nodiscard]] const gpu::Buffer& words() const { return words_; }
    [[nodiscard]] LumaOnGpu luma() const { return {video_, still_, words_}; }

private:
    void buildCoarse(const std::vector<LumaLevel>& levels);

    std::vector<LumaLevel> video_, still_;
    gpu::Buffer words_;
    gpu::ComputePass<params::LumaFromVideo> fromVideo_;
    gpu::ComputePass<params::LumaFromStill> fromStill_;
    gpu::ComputePass<params::LumaDown> down_;
};

}  // namespace mfar
