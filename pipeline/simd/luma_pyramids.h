#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/flow/luma_layout.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/luma_kernels.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mfar::simd {

/// Luma pyramids of the video frame and of the still, for the flow search. The still is drawn as
/// the video camera would see it: rotation and both lenses are applied, but no parallax. Video and
/// still are blurred equally, by different filters (see lumaBoxWidening()). The pixels are stored
/// in the shaders' layout (luma_layout.h), so words() can be uploaded unchanged.
class LumaPyramids {
public:
    LumaPyramids(Size video, std::shared_ptr<Workers> workers);

    void buildVideo(const RgbPlanes& video);
    /// Builds the still's pyramid from its luma, of size rig.still.size. Needed once per still.
    /// `light`: Guidance::light.
    void buildStill(Rows<const std::uint8_t> luma, const StereoRig& rig, float light);
    /// For flow between two frames: builds the still's pyramid from the luma of the second frame.
    void buildSecond(Rows<const std::uint8_t> luma);
    /// Builds the video's pyramid from the luma of a frame, without its colours.
    void buildFirst(Rows<const std::uint8_t> luma);

    [[nodiscard]] const std::vector<LumaLevel>& video() const { return video_; }
    [[nodiscard]] const std::vector<LumaLevel>& still() const { return still_; }
    [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
    [[nodiscard]] std::span<std::uint32_t> words() { return words_; }

private:
    void smooth(Rows<const std::uint8_t> luma, const std::vector<LumaLevel>& levels);
    void buildCoarse(const std::vector<LumaLevel>& levels);
    void halve(const LumaLevel& fine, const LumaLevel& coarse, int first, int last);
    [[nodiscard]] std::uint8_t* rowOf(const LumaLevel& level, int y);
    void fillMargins(const LumaLevel& level, int y);
    void findStillPixels(const StillLens& lens);

    std::shared_ptr<Workers> workers_;
    std::vector<LumaLevel> video_, still_;
    std::vector<std::uint32_t> words_;
    std::optional<StillLens> lens_;
    AlignedRows<float> stillX_, stillY_;
};

}  // namespace mfar::simd
