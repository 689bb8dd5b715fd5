#pragma once

#include "hal/virtual/synthetic_board.h"

#include <cstddef>
#include <vector>

namespace mfar::test {

/// A camera that has come to rest: one view again and again, each time with other noise.
class StoppedCamera {
public:
    /// `last`: a frame of the board, where the camera stops. Its noise, moved by some pixels, is
    /// that of all later pictures: as strong as the board's in every part of them.
    StoppedCamera(SyntheticBoard& board, const Frame& last);

    /// Valid until the next call.
    [[nodiscard]] ImageView next();

private:
    StoredImage clean_, shown_;
    std::vector<int> noise_;
    std::size_t moves_ = 0;
};

}  // namespace mfar::test
