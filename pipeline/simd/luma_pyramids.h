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

/// Luma pyramids for the flow: of the video frame, and of the still at the video's geometry
/// (rotation and both lenses applied, no parallax), smoothed in the same way. In host memory, in
/// the layout of the shaders (luma_layout.h), so that words() may be uploaded unchanged.
class LumaPyramids {
public:
    LumaPyramids(Size video, std::shared_ptr<Workers> workers);

    /// From the video frame.
    void buildVideo(const RgbPlanes& video);
    /// From the luma of a still of size rig.still.size, through the rig. Once per still.
    void buildStill(Rows<const std::uint8_t> luma, const StereoRig& rig);
    /// Second picture, from luma that already has the video's geometry (flow between two frames);
    /// takes the still's place.
    void buildSecond(Rows<const std::uint8_t> luma);
    /// First picture likewise; takes the video's place.
    void buildFirst(Rows<const std::uint8_t> luma);

    [[nodiscard]] const std::vector<LumaLevel>& video() const { return video_; }
    [[nodiscard]] const std::vector<LumaLevel>& still() const { return still_; }
    [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
    [[nodiscard]] std::span<std::uint32_t> words() { return words_; }

private:
    void smooth(Rows<const std::uint8_t> luma, const std::vector<LumaLevel>& levels);
    void buildCoarse(const std::vector<LumaLevel>& levels);
    void halve(const LumaLevel& fine, const LumaLevel& coarse, int first, int last);
    /// The first pixel of a row.
    [[nodiscard]] std::uint8_t* rowOf(const LumaLevel& level, int y);
    /// Repeats a row's border in its margins.
    void fillMargins(const LumaLevel& level, int y);
    void findStillPixels(const StillLens& lens);

    std::shared_ptr<Workers> workers_;
    std::vector<LumaLevel> video_, still_;
    std::vector<std::uint32_t> words_;
    std::optional<StillLens> lens_;       // lens for which stillX_, stillY_ were computed
    AlignedRows<float> stillX_, stillY_;  // still pixels of the video's pixels
};

}  // namespace mfar::simd
