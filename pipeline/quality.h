#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

enum class SuperResMode {
    Off,     ///< bicubically upscaled video
    Blend,   ///< the paper's: warped still blended by confidence
    Detail,  ///< the still's fine detail, as far as the video confirms it
};

/// What trades the time of a frame against its error and may be another for each frame, at no cost
/// of changing it. The defaults are the most accurate.
struct Quality {
    SuperResMode mode = SuperResMode::Detail;
    /// Enlarges with Keys' cubic; false, and in mode Off alone: linearly, from half the samples.
    bool cubic = true;
    /// Mode Detail enlarges by learned filters.
    bool learned = true;
    /// Off: matched in both dimensions though the poses are known.
    bool alongLines = true;
    Flow2dOptions flow2d{};      ///< but for what changed() in flow_options.h leaves
    EpipolarOptions epipolar{};  ///< likewise
    /// Tiles that are matched with the still, at most, as a share of all; (0, 1]. Those with the
    /// least structure are enlarged alone. Not in mode Blend, which fades all of the still over.
    double detailShare = 1;
    /// Tiles that are matched with a second, older still, where the newest does not show them, at
    /// most, as a share of all; [0, 1], 0: none is kept. Where tiles are enlarged by learned
    /// filters alone.
    double secondShare = 0.25;
    /// Real depth is measured in one of so many frames, and carried on in between; [1, 60].
    int depthEvery = 1;

    bool operator==(const Quality&) const = default;
};

/// Throws std::invalid_argument that names the first setting out of its range.
void validate(const Quality& quality);

}  // namespace mfar
