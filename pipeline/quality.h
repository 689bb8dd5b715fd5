#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

enum class SuperResMode {
    Off,     ///< the video is enlarged by bicubic interpolation
    Blend,   ///< the paper's method: the warped still is blended in by confidence
    Detail,  ///< the still's fine detail is added where the video confirms it
};

/// Settings that trade the time a frame takes against its error. Changing them between frames costs
/// no time. The defaults are the most accurate settings.
struct Quality {
    SuperResMode mode = SuperResMode::Detail;
    /// Whether Keys' cubic enlarges the video. If false, the video is enlarged linearly from half
    /// the samples; only possible in mode Off.
    bool cubic = true;
    /// Whether learned filters enlarge the video in mode Detail.
    bool learned = true;
    /// Whether frames are matched along epipolar lines if the poses are known. If false, they are
    /// matched in both dimensions.
    bool alongLines = true;
    Flow2dOptions flow2d{};      ///< only options that changed() in flow_options.h accepts
    EpipolarOptions epipolar{};  ///< only options that changed() in flow_options.h accepts
    /// Largest share of a frame's tiles that are matched with the still; (0, 1]. Above this limit,
    /// the tiles with the least structure are only enlarged. The limit has no effect in mode Blend,
    /// which blends the whole still.
    double detailShare = 1;
    /// Largest share of a frame's tiles that are matched with a second, older still because the
    /// newest does not show them; [0, 1]. 0: no second still is kept. A second still is used only
    /// if learned filters enlarge tiles.
    double secondShare = 0.25;
    /// Real depth is measured in every n-th frame and carried on in the frames between; n is in [1,
    /// 60].
    int depthEvery = 1;

    bool operator==(const Quality&) const = default;
};

/// Throws std::invalid_argument whose message names the first setting that is out of range.
void validate(const Quality& quality);

}  // namespace mfar
