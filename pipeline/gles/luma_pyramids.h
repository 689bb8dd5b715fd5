#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/flow/luma_layout.h"
#include "pipeline/gles/tone_texture.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar {

[[nodiscard]] params::Rig rigParams(const StereoRig& rig);

struct LumaOnGpu {
    const std::vector<LumaLevel>&video, &still;
    const gpu::Buffer& words;
};

/// Makes the luma pyramids of the video frame and of the still, which are the inputs of the flow
/// search. The still is resampled to the video's geometry (rotation and both lenses, but no
/// parallax). Both pyramids are in one storage buffer with four 8-bit pixels per word.
class LumaPyramids {
public:
    explicit LumaPyramids(Size video);

    /// `video` is an RGBA8 or R8 texture of the video's size.
    void buildVideo(const gpu::Texture& video);
    /// `still` is an RGBA8 or R8 texture with a linear filter. Must be called once for each new
    /// still. `light`: Guidance::light.
    void buildStill(const gpu::Texture& still, const ToneTexture& tone, const StereoRig& rig,
                    float light);
    /// Makes the still's pyramid from a picture in the video's geometry. Used for the flow between
    /// two frames.
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
