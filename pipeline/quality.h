#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

/// How the still is used. Off: not at all, the video is only enlarged. Blend: the warped still is
/// blended over the video with the confidence as opacity (the method of the paper in
/// docs/paper.md). Detail: the still's fine detail is added where the video confirms it.
enum class SuperResMode {
    Off,
    Blend,
    Detail,
};

/// Settings that trade time per frame for accuracy. The defaults are the most accurate. The
/// settings can be changed between frames without additional time, except for a change to mode
/// Blend.
struct Quality {
    SuperResMode mode = SuperResMode::Detail;
    /// How the video is enlarged in mode Off. True: with Keys' cubic (4x4 pixels). False: with
    /// bilinear interpolation (2x2 pixels), which is faster. Other modes ignore this.
    bool cubic = true;
    /// True: learned filters enlarge the video in mode Detail.
    bool learned = true;
    /// True: frames with known poses are matched along epipolar lines. False: all frames are
    /// matched in both dimensions.
    bool alongLines = true;
    /// Options of the searches. Flow2dOptions::levels, EpipolarOptions::levels and
    /// EpipolarOptions::longestParallax have no effect here: their values at construction stay.
    Flow2dOptions flow2d{};
    EpipolarOptions epipolar{};
    /// Largest share of a frame's tiles that are matched with the still, (0, 1]. If more tiles have
    /// structure, those with the least structure are not matched but only enlarged. Mode Blend
    /// ignores this.
    double detailShare = 1;
    /// Largest share of a frame's tiles that are matched with the second still, [0, 1]. The second
    /// still is older than the newest one and is used in tiles that the newest one does not show.
    /// It is used only while learned filters enlarge the video. 0: there is no second still.
    double secondShare = 0.25;
    /// Real depth is measured in every n-th frame, n in [1, 60]. In the other frames, the last
    /// depth is moved to the frame's pose.
    int depthEvery = 1;

    bool operator==(const Quality&) const = default;
};

/// Throws std::invalid_argument that names the first setting that is out of range.
void validate(const Quality& quality);

}  // namespace mfar
