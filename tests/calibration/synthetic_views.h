#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <cstdint>

namespace mfar::test {

/// Motion of the simulated board in front of the target.
struct Motion {
    double tilt = 0.5;       ///< [rad]
    double distance = 0.25;  ///< relative change of the distance
    double aside = 0.12;     ///< [m]
    double offset = 0;       ///< [s] still's time + offset = video's time
    double seconds = 12;
    double stillsHz = 2;
    bool rests = false;  ///< the board is at rest when stills are taken, and moves in between
    double noise = 0.1;  ///< of a corner's coordinate in both pictures [px]
    std::uint64_t seed = 1;
};

/// The synthetic board's two cameras, ground truth for all tests here.
[[nodiscard]] StereoRig trueRig();

struct BothViews {
    calibration::SensorViews video, still;
};

/// Corners of an AprilGrid in both pictures of trueRig(), exact but for the noise.
[[nodiscard]] BothViews makeViews(const calibration::Target& target, const Motion& motion);

}  // namespace mfar::test
