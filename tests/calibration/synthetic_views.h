#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <cstdint>

namespace mfar::test {

/// Motion of the simulated board in front of the target.
struct Motion {
    double tilt = 0.5;       ///< greatest tilt [rad]
    double distance = 0.25;  ///< largest relative change of the distance to the target
    double aside = 0.12;     ///< greatest sideways motion [m]
    double offset = 0;       ///< added to a still's time, gives the video's time [s]
    double seconds = 12;
    double stillsHz = 2;
    bool rests = false;  ///< the board rests while stills are taken and moves in between
    double noise = 0.1;  ///< standard deviation of corner coordinates [px]
    std::uint64_t seed = 1;
};

/// Calibration of the synthetic board's two cameras: the ground truth of all tests here.
[[nodiscard]] StereoRig trueRig();

struct BothViews {
    calibration::SensorViews video, still;
};

/// Corners of an AprilGrid in both pictures of trueRig(): exact, plus the noise.
[[nodiscard]] BothViews makeViews(const calibration::Target& target, const Motion& motion);

}  // namespace mfar::test
