#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <cstddef>

namespace mfar {

struct PredictionLimits {
    double seconds = 0.5;    ///< prediction time, at most; 0: no prediction
    double turnDegrees = 4;  ///< rotation of the camera, and angle of its translation as seen from
                             ///< the objects, at most
    bool operator==(const PredictionLimits&) const = default;
};

/// Predicts the pose of a camera that keeps its angular and linear velocity in its own frame, as
/// measured over the last tenth of a second. One thread at a time; no allocation.
class ViewPredictor {
public:
    /// Throws std::invalid_argument for limits that are negative or not finite.
    explicit ViewPredictor(const PredictionLimits& limits = {});

    /// Adds the pose at `time`, later than the last one. An earlier time or a gap above half a
    /// second restarts the measurement.
    void add(const RigidTransform& T_world_camera, Timestamp time);

    /// Pose `seconds` after the last one, as far as the limits allow. `distance`: to the objects
    /// [m]. The identity before the first pose.
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
