#pragma once

#include "base/time.h"
#include "pipeline/plan/tile_measure.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Finds out from the changes of the picture since when the camera has rested. Things may move in
/// front of a resting camera: the camera counts as moving only if more than a quarter of the tiles
/// with structure changed within the last 64 frames.
class CameraRest {
public:
    /// Adds a frame. `tiles` are its measurements, see WorkPlan::measured(). A tile has structure
    /// if its TileMeasure::structure exceeds `leastStructure`. `renewedShare`: share of the tiles
    /// that were drawn although they had not changed. The next frame is compared with them, so a
    /// slow motion does not accumulate. If more than a quarter of the tiles is drawn in many
    /// frames, nothing shows that the camera rests.
    void add(const std::vector<TileMeasure>& tiles, double leastStructure, double renewedShare,
             Timestamp time);
    /// True if the camera rested at time `t` and has rested since then: frames before and after `t`
    /// show the same view. False if the picture has too little structure to show a motion.
    [[nodiscard]] bool restedSince(Timestamp t) const {
        return since_ && *since_ < t && t <= last_;
    }

private:
    long frame_ = 0;
    double renewals_ = 0;             // number of recent frames that drew a quarter of the tiles
    std::vector<long> changed_;       // for each tile: the last frame in which it changed
    std::optional<Timestamp> since_;  // time of the first frame since which the camera rests
    Timestamp last_;                  // time of the last frame
};

}  // namespace mfar
