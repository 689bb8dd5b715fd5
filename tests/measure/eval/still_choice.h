#pragma once

#include "hal/virtual/recording.h"

#include <cstddef>
#include <optional>

namespace mfar::eval {

/// Index in `recording.stills` of the reference of the video frame at time `frame`: the still
/// nearest in time, or the earlier of two equally near ones. Stills that show the frame's own view
/// (see showsOwnView()) are left out: such a still would be the frame's true picture. Empty if no
/// still is left.
[[nodiscard]] std::optional<std::size_t> referenceStill(const Recording& recording,
                                                        Timestamp frame);

/// Index of the still that referenceStill() would choose if the recording lacked the reference.
[[nodiscard]] std::optional<std::size_t> secondStill(const Recording& recording, Timestamp frame);

/// True if the still at time `still` was taken from the same viewpoint and direction as the video
/// frame at time `frame`: less than 1e-6 m and 1e-6 rad away. If the times are equal, this relative
/// pose is that of the rig. Otherwise it also depends on the recorded poses; without these, the
/// result is false.
[[nodiscard]] bool showsOwnView(const Recording& recording, Timestamp still, Timestamp frame);

}  // namespace mfar::eval
