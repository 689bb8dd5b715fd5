#pragma once

#include "base/image_view.h"
#include "daemon/tools/calibrate/target.h"

#include <string>
#include <vector>

namespace mfar::calibration {

/// How the found corners are distributed over the picture. They are counted in a grid of cells.
class Coverage {
public:
    static constexpr int kColumns = 16, kRows = 12;

    explicit Coverage(Size picture);
    void add(const std::vector<Corner>& corners);

    /// Returns the share of the cells that have a corner, [0, 1].
    [[nodiscard]] double share() const;
    /// Returns a text for the part of the picture with the fewest corners, such as "the top left".
    [[nodiscard]] std::string emptiest() const;
    /// Returns the grid as kRows lines of kColumns characters, from ' ' (no corners) to '#' (many).
    [[nodiscard]] std::vector<std::string> map() const;

private:
    Size picture_;
    std::vector<int> counts_;
};

}  // namespace mfar::calibration
