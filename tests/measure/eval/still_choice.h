#pragma once

#include "hal/virtual/recording.h"

#include <cstddef>
#include <optional>

namespace mfar::eval {

/// Index in `recording.stills` of the still for the video frame at `frame`: the nearest in time (of
/// two equally near, the earlier) among those that do not show the frame's own view. Empty if there
/// is no such still. See design.md, section 8.
[[nodiscard]] std::optional<std::size_t> referenceStill(const Recording& recording,
                                                        Timestamp frame);

/// The next-nearest still by the same rule.
[[nodiscard]] std::optional<std::size_t> secondStill(const Recording& recording, Timestamp frame);

/// Whether the still taken at `still` shows the same view as the video frame at `frame`: relative
/// pose [R|t] = T_still_world T_world_video below 1e-6 (radians, metres). At equal times the rig
/// alone decides, otherwise the recorded poses; without these, different times are different views.
[[nodiscard]] bool showsOwnView(const Recording& recording, Timestamp still, Timestamp frame);

}  // namespace mfar::eval
