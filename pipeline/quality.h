#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

enum class SuperResMode {
    Off,     ///< video enlarged by bicubic interpolation
    Blend,   ///< the paper's method: warped still blended by confidence
    Detail,  ///< the still's fine detail, where the video confirms it
};

/// Settings that trade a frame's time against its error; they may change for each frame at no cost.
/// The defaults are the most accurate.
struct Quality {
    SuperResMode mode = SuperResMode::Detail;
    /// Enlarges with Keys' cubic; if false, and only in mode Off: linearly, from half the samples.
    bool cubic = true;
    /// Mode Detail enlarges by learned filters.
    bool learned = true;
    /// False: matches in both dimensions even though the poses are known.
    bool alongLines = true;
    Flow2dOptions flow2d{};      ///< only those that changed() in flow_options.h accepts
    EpipolarOptions epipolar{};  ///< likewise
    /// Upper limit of the share of tiles that are matched with the still; (0, 1]. Tiles with the
    /// least structure are only enlarged. Not in mode Blend, which blends the whole still.
    double detailShare = 1;
    /// Upper limit of the share of tiles that are matched with a second, older still because the
    /// newest does not show them; [0, 1], 0: no second still is kept. Only where learned filters
    /// enlarge tiles.
    double secondShare = 0.25;
    /// Real depth is measured in one of this number of frames and carried on in between; [1, 60].
    int depthEvery = 1;

    bool operator==(const Quality&) const = default;
};

/// Throws std::invalid_argument that names the first setting out of its range.
void validate(const Quality& quality);

}  // namespace mfar
