#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <cstddef>

namespace mfar {

struct PredictionLimits {
    double seconds = 0.5;  ///< longest prediction time; 0: no prediction
    /// Upper limit of the angle [degrees] by which the camera is predicted to rotate. The angle by
    /// which its position moves, as seen from the objects, has the same limit.
    double turnDegrees = 4;
    bool operator==(const PredictionLimits&) const = default;
};

/// Predicts the pose of a camera that keeps its angular and linear velocity, both measured in the
/// camera's own frame over the last tenth of a second. One thread at a time may call it. It
/// allocates no memory.
class ViewPredictor {
public:
    /// Throws std::invalid_argument if a limit is negative or not finite.
    explicit ViewPredictor(const PredictionLimits& limits = {});

    /// Adds the pose at `time`. If `time` is not later than the last time, or more than half a
    /// second later, the measurement restarts.
    void add(const RigidTransform& T_world_camera, Timestamp time);

    /// Predicted pose `seconds` after the last pose, as far as the limits allow. `distance` is the
    /// distance from the camera to the objects [m]. Returns the identity before the first pose.
    [[nodiscard]] RigidTransform predict(double seconds, double distance) const;

private:
    struct Entry {
        Timestamp time;
        RigidTransform T_world_camera;
    };
    [[nodiscard]] const Entry& back(std::size_t steps) const;
    [[nodiscard]] Vector6 rate() const;

    const PredictionLimits limits_;
    std::array<Entry, 16> entries_{};  // ring buffer
    std::size_t added_ = 0;
};

}  // namespace mfar
