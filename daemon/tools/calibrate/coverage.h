#pragma once

#include "base/image_view.h"
#include "daemon/tools/calibrate/target.h"

#include <string>
#include <vector>

namespace mfar::calibration {

/// Counts the found corners in a grid of cells over the picture.
class Coverage {
public:
    static constexpr int kColumns = 16, kRows = 12;

    explicit Coverage(Size picture);
    void add(const std::vector<Corner>& corners);

    [[nodiscard]] double share() const;
    [[nodiscard]] std::string emptiest() const;
    /// Returns the grid as kRows lines of kColumns characters, from ' ' (no corners) to '#' (many).
    [[nodiscard]] std::vector<std::string> map() const;

private:
    Size picture_;
    std::vector<int> counts_;
};

}  // namespace mfar::calibration
