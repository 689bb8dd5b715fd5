#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <cstddef>

namespace mfar {

struct PredictionLimits {
    double seconds = 0.5;  ///< longest prediction time; 0: no prediction
    /// Upper limit of the predicted rotation of the camera [degrees]. The predicted translation is
    /// limited, too: its two ends, seen from the objects, are at most this angle apart.
    double turnDegrees = 4;
    bool operator==(const PredictionLimits&) const = default;
};

/// Predicts the pose of a camera that keeps its angular and linear velocity. Both velocities are
/// measured in the camera's frame, over the last tenth of a second, but over at least two and at
/// most 16 poses. One thread at a time may call this class. It allocates no memory.
class ViewPredictor {
public:
    explicit ViewPredictor(const PredictionLimits& limits = {});

    /// Adds the pose at `time`. If `time` is not later than that of the last pose, or half a second
    /// or more later, all earlier poses are forgotten.
    void add(const RigidTransform& T_world_camera, Timestamp time);

    /// Predicts the pose `seconds` after the last pose, within the limits. `distance` is the
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
    std::array<Entry, 16> entries_{};
    std::size_t added_ = 0;
};

}  // namespace mfar
