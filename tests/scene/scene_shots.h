#pragma once

#include "hal/virtual/synthetic_board.h"

#include <memory>
#include <vector>

namespace mfar::test {

/// A still and a later frame of a scene, as the board's sensors take them, with exact poses.
struct SceneShots {
    SceneShots(synthetic::Scene scene, synthetic::Path path, int framesLater);

    /// For every tile of 16x16 pixels: true if, for at least a quarter of it, the motion against
    /// the still differs by a pixel or more from the motion that the camera causes.
    [[nodiscard]] std::vector<bool> movingTiles() const;

    std::unique_ptr<SyntheticBoard> board;
    Frame still, frame;
};

}  // namespace mfar::test
