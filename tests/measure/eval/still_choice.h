#pragma once

#include "hal/virtual/recording.h"

#include <cstddef>
#include <optional>

namespace mfar::eval {

/// Index in `recording.stills` of the still for the video frame at time `frame`: the nearest in
/// time among those that do not show the frame's own view; of two equally near ones, the earlier.
/// Empty if no such still exists.
[[nodiscard]] std::optional<std::size_t> referenceStill(const Recording& recording,
                                                        Timestamp frame);

/// Index of the still that referenceStill() would choose if its result were excluded.
[[nodiscard]] std::optional<std::size_t> secondStill(const Recording& recording, Timestamp frame);

/// True if the still taken at time `still` shows the same view as the video frame at time `frame`:
/// their relative pose [R|t] = T_still_world T_world_video is below 1e-6 (radians, metres). At
/// equal times the rig alone gives the relative pose, otherwise the recorded poses. Without
/// recorded poses, different times count as different views.
[[nodiscard]] bool showsOwnView(const Recording& recording, Timestamp still, Timestamp frame);

}  // namespace mfar::eval
