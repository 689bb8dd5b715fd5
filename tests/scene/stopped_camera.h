#pragma once

#include "hal/virtual/synthetic_board.h"

#include <cstddef>
#include <vector>

namespace mfar::test {

/// A camera at rest. It gives the same view with different noise each time.
class StoppedCamera {
public:
    /// `last`: the frame at which the board's camera stops. All later pictures have the noise of
    /// this frame, shifted by some pixels. So the noise is as strong as the board's everywhere.
    StoppedCamera(SyntheticBoard& board, const Frame& last);

    /// Returns the next picture, which is valid until the next call.
    [[nodiscard]] ImageView next();

private:
    StoredImage clean_, shown_;
    std::vector<int> noise_;
    std::size_t moves_ = 0;
};

}  // namespace mfar::test
