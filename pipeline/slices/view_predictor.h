#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <cstddef>

namespace mfar {

struct PredictionLimits {
    double seconds = 0.5;    ///< ahead, at most; 0: no prediction
    double turnDegrees = 4;  ///< of the camera, and of its way as seen from the objects, at most
    bool operator==(const PredictionLimits&) const = default;
};

/// Where a camera will be that keeps turning and moving at its rate in its own frame, as measured
/// over its last tenth of a second. One thread at a time; no allocation.
class ViewPredictor {
public:
    /// Throws std::invalid_argument for limits that are negative or not finite.
    explicit ViewPredictor(const PredictionLimits& limits = {});

    /// Where it was at `time`, later than before; an earlier time or a gap of more than half a
    /// second is a new start.
    void add(const RigidTransform& T_world_camera, Timestamp time);

    /// `seconds` after the last pose, as far as the limits let. `distance`: to the objects [m]. The
    /// identity before the first pose.
    [[nodiscard]] RigidTransform predict(double seconds, double distance) const;

private:
    struct Entry {
        Timestamp time;
        RigidTransform T_world_camera;
    };
    [[nodiscard]] const Entry& back(std::size_t steps) const;
    [[nodiscard]] Vector6 rate() const;

    const PredictionLimits limits_;
    std::array<Entry, 16> entries_{};  // a ring
    std::size_t added_ = 0;
};

}  // namespace mfar
