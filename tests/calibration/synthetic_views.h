#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <cstdint>

namespace mfar::test {

struct Motion {
    double tilt = 0.5;       ///< greatest tilt [rad]
    double distance = 0.25;  ///< largest relative change of the distance to the target
    double aside = 0.12;     ///< greatest sideways motion of the target [m]
    double offset = 0;       ///< clock of the video minus clock of the stills [s]
    double seconds = 12;
    double stillsHz = 2;
    bool rests = false;  ///< true: the target rests while a still is taken
    double noise = 0.1;  ///< standard deviation of the noise of corner coordinates [px]
    std::uint64_t seed = 1;
};

[[nodiscard]] StereoRig trueRig();
/// A rig like trueRig(), but the still camera has 4608x2592 pixels and a wide lens. Without its
/// distortion, the lens would show 95 degrees horizontally.
[[nodiscard]] StereoRig wideRig();

struct BothViews {
    calibration::SensorViews video, still;
};

[[nodiscard]] BothViews makeViews(const calibration::Target& target, const Motion& motion,
                                  const StereoRig& rig = trueRig());

}  // namespace mfar::test
