#pragma once

#include "hal/virtual/recorder.h"
#include "hal/virtual/synthetic_board.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace mfar {

struct SimOptions {
    std::filesystem::path out;
    double stillsHz = 1;  ///< trigger pulses per second of simulated time; 0: no stills
    /// Which ground truth is written: truth/highres, truth/inverse_depth, truth/flow.
    bool highRes = true;
    bool depth = true;
    bool flow = true;
};

struct SimCounts {
    int video = 0, stills = 0, flows = 0;
};

/// Runs a simulated board until its video ends, and writes a recording with ground truth. The
/// recording has the layout that recording.h describes, and also these files:
///   truth/highres/<t>.png         the video frame at time t, with the still's resolution
///   truth/inverse_depth/<t>.pfm   1 / z [1/m] of each video pixel; 0: there is no surface
///   truth/flow/<t0>_<t1>.flo      flow from the video frame at t0 to the next one at t1
///   truth/flow/<t0>_<s>.flo       flow from the video frame at t0 to the newest still, taken at s,
///                                 see SyntheticBoard::View::StillAtVideo
///   tags.toml                     the tags of the world, at their initial poses
/// `progress` is called after each video frame, with the number of frames so far. Throws
/// std::runtime_error.
[[nodiscard]] SimCounts writeSimulation(SyntheticBoard& board, const SimOptions& options,
                                        const std::function<void(int)>& progress);

}  // namespace mfar
