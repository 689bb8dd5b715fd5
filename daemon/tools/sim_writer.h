#pragma once

#include "hal/virtual/recorder.h"
#include "hal/virtual/synthetic_board.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace mfar {

struct SimOptions {
    std::filesystem::path out;
    double stillsHz = 1;  ///< pulses per second of simulated time, 0: no stills
    bool highRes = true;  ///< write truth/highres
    bool depth = true;    ///< write truth/inverse_depth
    bool flow = true;     ///< write truth/flow
};

/// Numbers of files of a finished run.
struct SimCounts {
    int video = 0, stills = 0, flows = 0;
};

/// Runs a board until its video ends and writes a recording with ground truth. The layout is that
/// of recording.h, and in addition
///   truth/highres/<t>.png          the video frame at t as seen at the still's resolution
///   truth/inverse_depth/<t>.pfm    1 / z [1/m] per video pixel, 0 = no surface
///   truth/flow/<t0>_<t1>.flo       video frame t0 to the next video frame t1
///   truth/flow/<t0>_<s>.flo        video frame t0 to the newest still s before it, as the still
///   would
///                                  look with the video's orientation, lens and resolution
///   tags.toml                      the initial tags of the world
/// `progress` is called after every video frame with the number of frames written.
/// Throws std::runtime_error.
[[nodiscard]] SimCounts writeSimulation(SyntheticBoard& board, const SimOptions& options,
                                        const std::function<void(int)>& progress);

}  // namespace mfar
