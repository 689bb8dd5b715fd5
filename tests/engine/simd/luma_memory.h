#pragma once

#include "base/geometry.h"
#include "pipeline/flow/luma_layout.h"
#include "tests/oracle/luma.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar::test {

/// The luma pyramids of video and still, with the margins that the pipeline's pyramids have.
class LumaMemory {
public:
    /// `video(x, y)`, `still(x, y)`: grey levels of the finest pyramid levels; the constructor
    /// rounds them.
    template <class Video, class Still>
    LumaMemory(Size size, Video video, Still still) {
        std::int32_t count = 0;
        videoLuma_ = lumaLayout(size, count);
        stillLuma_ = lumaLayout(size, count);
        words_.resize(static_cast<std::size_t>(count) + kLumaSpareWords);
        fill(videoLuma_, twin::greyOf(size, video), video_);
        fill(stillLuma_, twin::greyOf(size, still), still_);
    }

    [[nodiscard]] const std::vector<LumaLevel>& videoLuma() const { return videoLuma_; }
    [[nodiscard]] const std::vector<LumaLevel>& stillLuma() const { return stillLuma_; }
    [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
    [[nodiscard]] const twin::Grey& video(int level) const { return video_[level]; }
    [[nodiscard]] const twin::Grey& still(int level) const { return still_[level]; }

private:
    void fill(const std::vector<LumaLevel>& levels, twin::Grey grey,
              std::vector<twin::Grey>& levelsOf) {
        for (double& value : grey.values)
            value = std::clamp(std::round(value), 0.0, 255.0);
        for (const LumaLevel& level : levels) {
            write(level, grey);
            levelsOf.push_back(grey);
            grey = twin::halved(grey);
        }
    }
    void write(const LumaLevel& level, const twin::Grey& grey) {
        auto* bytes = reinterpret_cast<std::uint8_t*>(&words_[level.offset]);
        for (int y = 0; y < level.height; ++y)
            for (int i = 0; i < 4 * level.pitch; ++i)
                *bytes++ = static_cast<std::uint8_t>(grey.at(i - 4 * kLumaMarginWords, y));
    }

    std::vector<LumaLevel> videoLuma_, stillLuma_;
    std::vector<std::uint32_t> words_;
    std::vector<twin::Grey> video_, still_;
};

/// Two cameras, rotated against each other by 1.7 degrees. If `distort` is true, their lenses have
/// different distortion.
[[nodiscard]] inline StereoRig twoLenses(Size video, Size still, bool distort) {
    CameraModel v;
    v.size = video;
    v.fx = v.fy = video.width;
    v.cx = 0.5 * (video.width - 1);
    v.cy = 0.5 * (video.height - 1);
    StereoRig rig{v, v.scaledTo(still), {}};
    if (distort) {
        rig.video.distortion = {-0.12, 0.03, 0.001, -0.0005, 0.002};
        rig.still.distortion = {0.06, -0.02, -0.0008, 0.0006, -0.001};
    }
    rig.still.cx += 7.3;
    rig.still.cy -= 4.1;
    rig.T_still_video.rotation =
        Eigen::AngleAxisd(0.03, Eigen::Vector3d(0.3, -0.5, 0.8).normalized());
    return rig;
}

}  // namespace mfar::test
