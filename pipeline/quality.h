#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

/// Use of the still. Off: the video is only enlarged. Blend (the method of the paper in
/// docs/paper.md): the warped still is blended in by confidence. Detail: the still's fine detail is
/// added where the video confirms it.
enum class SuperResMode {
    Off,
    Blend,
    Detail,
};

/// Settings that trade time per frame for accuracy. The defaults are the most accurate. Changing
/// them between frames costs no time.
struct Quality {
    SuperResMode mode = SuperResMode::Detail;
    /// True: the video is enlarged with Keys' cubic (4x4 pixels). False: with bilinear
    /// interpolation (2x2 pixels), which is faster. False has an effect only in mode Off.
    bool cubic = true;
    /// True: learned filters enlarge the video in mode Detail.
    bool learned = true;
    /// True: frames with known poses are matched along epipolar lines. False: all frames are
    /// matched in both dimensions.
    bool alongLines = true;
    /// Options of the searches. Flow2dOptions::levels, EpipolarOptions::levels and longestParallax
    /// are ignored here; the values given at construction stay.
    Flow2dOptions flow2d{};
    EpipolarOptions epipolar{};
    /// Largest share of a frame's tiles that are matched with the still, (0, 1]. If more tiles have
    /// structure, the tiles with the least structure are only enlarged. Without effect in mode
    /// Blend.
    double detailShare = 1;
    /// Largest share of a frame's tiles that are matched with a second, older still because the
    /// newest still does not show them, [0, 1]. 0: there is no second still. A second still is used
    /// only if learned filters enlarge tiles.
    double secondShare = 0.25;
    /// Real depth is measured in every n-th frame, n in [1, 60]. Frames between get the last depth,
    /// moved to their poses.
    int depthEvery = 1;

    bool operator==(const Quality&) const = default;
};

/// Throws std::invalid_argument that names the first setting that is out of range.
void validate(const Quality& quality);

}  // namespace mfar
