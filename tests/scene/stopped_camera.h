#pragma once

#include "hal/virtual/synthetic_board.h"

#include <cstddef>
#include <vector>

namespace mfar::test {

/// A camera at rest. It gives the same view with different noise each time.
class StoppedCamera {
public:
    /// `last`: the frame at which the board's camera stops. Each later picture shows the view of
    /// this frame with the frame's noise, which is shifted by some pixels. So its noise is as
    /// strong as that of the board's pictures.
    StoppedCamera(SyntheticBoard& board, const Frame& last);

    /// Returns the next picture, which is valid until the next call.
    [[nodiscard]] ImageView next();

private:
    StoredImage clean_, shown_;
    std::vector<int> noise_;
    std::size_t moves_ = 0;
};

}  // namespace mfar::test
