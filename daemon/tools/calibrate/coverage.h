#pragma once

#include "base/image_view.h"
#include "daemon/tools/calibrate/target.h"

#include <string>
#include <vector>

namespace mfar::calibration {

/// Distribution of found corners over the picture, in a grid of cells.
class Coverage {
public:
    static constexpr int kColumns = 16, kRows = 12;

    explicit Coverage(Size picture);
    void add(const std::vector<Corner>& corners);

    /// Share of the cells with a corner, [0, 1].
    [[nodiscard]] double share() const;
    /// The part of the picture with the fewest corners, in words: "the top left".
    [[nodiscard]] std::string emptiest() const;
    /// kRows lines of kColumns characters, from ' ' (none) to '#' (many).
    [[nodiscard]] std::vector<std::string> map() const;

private:
    Size picture_;
    std::vector<int> counts_;
};

}  // namespace mfar::calibration
