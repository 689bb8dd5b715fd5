#pragma once

#include "hal/virtual/recording.h"

#include <cstddef>
#include <optional>

namespace mfar::eval {

/// Index in `recording.stills` of the reference of the video frame at time `frame`: the nearest
/// still in time that does not show the frame's own view, or the earlier of two equally near ones.
/// Empty if there is none.
[[nodiscard]] std::optional<std::size_t> referenceStill(const Recording& recording,
                                                        Timestamp frame);

/// Index of the still that referenceStill() would choose if its result were excluded.
[[nodiscard]] std::optional<std::size_t> secondStill(const Recording& recording, Timestamp frame);

/// True if the still at time `still` shows the same view as the video frame at time `frame`: their
/// relative pose is below 1e-6 (radians, metres). At equal times the rig gives this pose, otherwise
/// recorded poses do. Without recorded poses, views at different times count as different.
[[nodiscard]] bool showsOwnView(const Recording& recording, Timestamp still, Timestamp frame);

}  // namespace mfar::eval
