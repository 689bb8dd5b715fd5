#pragma once

#include "hal/virtual/recording.h"

#include <cstddef>
#include <optional>

namespace mfar::eval {

/// The index in `recording.stills` of the reference for the video frame at `frame`: the nearest in
/// time (the earlier of two equally near) among those that do not show the frame's very own view.
/// Nothing when no other still exists. See design.md, section 8.
[[nodiscard]] std::optional<std::size_t> referenceStill(const Recording& recording,
                                                        Timestamp frame);

/// The still that comes next to that one, by the same rule.
[[nodiscard]] std::optional<std::size_t> secondStill(const Recording& recording, Timestamp frame);

/// Whether the still taken at `still` shows the very view of the video frame at `frame`: relative
/// pose [R|t] = T_still_world T_world_video below 1e-6 (radians, metres). Known from the rig alone
/// at equal times, from the recorded poses otherwise; without them different times are different
/// views.
[[nodiscard]] bool showsOwnView(const Recording& recording, Timestamp still, Timestamp frame);

}  // namespace mfar::eval
