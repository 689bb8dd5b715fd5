#pragma once

#include "hal/virtual/synthetic_board.h"

#include <memory>
#include <vector>

namespace mfar::test {

/// A still and a later frame of a scene, as the board's sensors take them, with their exact poses.
struct SceneShots {
    SceneShots(synthetic::Scene scene, synthetic::Path path, int framesLater);

    /// For every tile of 16x16 pixels: does the motion of at least a quarter of it against the
    /// still differ by a pixel or more from the motion that the camera causes?
    [[nodiscard]] std::vector<bool> movingTiles() const;

    std::unique_ptr<SyntheticBoard> board;
    Frame still, frame;
};

}  // namespace mfar::test
