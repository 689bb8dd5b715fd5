#pragma once

#include "base/time.h"
#include "pipeline/plan/tile_measure.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Determines from the changes of the picture how long the camera has rested. Things may move in
/// front of a resting camera: changes count as a motion of the camera only if more than a quarter
/// of the tiles with structure changed within the last 64 frames.
class CameraRest {
public:
    /// Adds a frame. `tiles` are its measurements, see WorkPlan::measured(). A tile has structure
    /// if its TileMeasure::structure exceeds `leastStructure`. `renewedShare`: share of the tiles
    /// that were drawn although they had not changed. The next frame is compared with the newly
    /// drawn tiles, so a slow motion does not add up to a change. Therefore, if this share exceeds
    /// a quarter in more than about three frames per second, the camera counts as moving.
    void add(const std::vector<TileMeasure>& tiles, double leastStructure, double renewedShare,
             Timestamp time);
    /// True if the camera rested at time `t` and has rested since then: frames before and after `t`
    /// show the same view. False if the picture has too little structure to show a motion.
    [[nodiscard]] bool restedSince(Timestamp t) const {
        return since_ && *since_ < t && t <= last_;
    }

private:
    long frame_ = 0;
    // Number of frames whose `renewedShare` exceeded a quarter. Older frames count less.
    double renewals_ = 0;
    std::vector<long> changed_;       // for each tile: the last frame in which it changed
    std::optional<Timestamp> since_;  // time from which on the camera has rested, if it is known
    Timestamp last_;                  // time of the last frame
};

}  // namespace mfar
