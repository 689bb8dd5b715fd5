#pragma once

#include "hal/virtual/synthetic_board.h"

#include <memory>
#include <vector>

namespace mfar::test {

/// A still and a later frame that the sensors of `board` took of a scene.
struct SceneShots {
    SceneShots(synthetic::Scene scene, synthetic::Path path, int framesLater);

    /// For each tile, true if a quarter of its pixels or more move by themselves: their motion
    /// since the still differs by more than a pixel from that caused by the camera.
    [[nodiscard]] std::vector<bool> movingTiles() const;

    std::unique_ptr<SyntheticBoard> board;
    Frame still, frame;
};

}  // namespace mfar::test
