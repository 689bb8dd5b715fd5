#pragma once

#include "base/rows.h"
#include "tests/oracle/enlarge.h"

#include <cstdint>

namespace mfar::train {

struct Sensor {
    double noise = 0;  ///< standard deviation [grey levels]
    double blur = 0;   ///< weight of each of a pixel's two neighbours along an axis, [0, 1/3]
    unsigned seed = 1;
};

/// A picture as a video camera sees it, and the error of Keys' cubic when it enlarges this video.
class TrainingPair {
public:
    static constexpr int kMargin = 64;

    /// `sharp`: luma in grey levels, at least 64x64. The video has kScale times this size. A video
    /// pixel is the mean of `sharp` over the pixel's area, rounded to a whole grey level.
    TrainingPair(const twin::Grey& sharp, const Sensor& sensor);

    [[nodiscard]] Size size() const { return size_; }
    /// Pixels of a row [1/8 grey level]. Rows and columns outside the picture repeat its border.
    [[nodiscard]] const std::int16_t* row(int y) const;
    /// Error of Keys' cubic, which the filter should correct, at pixel (x, y) of the video enlarged
    /// by enlarge::kGrid [grey levels].
    [[nodiscard]] double target(int x, int y) const { return target_.at(x, y); }

    static constexpr double kScale = 9.0 / 32;

private:
    Size size_;
    AlignedRows<std::int16_t> luma_;
    twin::Grey target_;
};

}  // namespace mfar::train
