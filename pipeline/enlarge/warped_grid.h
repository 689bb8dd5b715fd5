#pragma once

#include "base/rows.h"
#include "pipeline/enlarge/class_sums.h"
#include "pipeline/enlarge/matched_pictures.h"

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

namespace mfar::enlarge {

/// The grey levels of a still at the sub-pixels of a video frame, and their means over each pixel.
class WarpedGrid {
public:
    explicit WarpedGrid(Size video);

    /// Samples the still for all pixels in known cells, at the positions in `lookUps`. Other pixels
    /// keep their values. `known` is 1 for cells with a valid look-up, else 0. If `stop` is
    /// requested, the call returns soon.
    void warp(const MatchedPictures& pictures, const AlignedRows<LookUpCell>& lookUps,
              const AlignedRows<std::uint8_t>& known, const std::stop_token& stop);

    [[nodiscard]] float at(int x, int y, int phase) const {
        const int row = kGrid * y + phase / kGrid, column = kGrid * x + phase % kGrid;
        return static_cast<float>(grid_[row][column]) / kScale;
    }
    [[nodiscard]] float mean(int x, int y) const {
        return mean_[static_cast<std::size_t>(y) * video_.width + x];
    }

    /// Returns the difference a - b for the sub-pixels of a pixel, where a is the root of their
    /// mean square and b is their mean. It is never negative, and 0 if all are equal.
    [[nodiscard]] float rootAboveMean(int x, int y) const;

private:
    static constexpr int kScale = 64;

    Size video_;
    AlignedRows<std::int16_t> grid_;
    std::vector<float> mean_;
};

/// Returns offset and weight at (px, py) [video px], interpolated between cells as in the detail
/// step, see params::kJump.
[[nodiscard]] LookUpCell lookUpAt(const AlignedRows<LookUpCell>& cells, double px, double py);

/// Returns the weights at the sub-pixels of a pixel, see lookUpAt().
[[nodiscard]] Phases weightsAt(const AlignedRows<LookUpCell>& cells, int x, int y);

/// Returns the weights of FilterBank::cubic() for each tap.
[[nodiscard]] const std::array<Phases, kTaps>& cubicWeights();

/// Returns Keys' cubic enlargement of a picture at the sub-pixels of a pixel. `valueAt` returns the
/// picture's value at (x, y).
template <class ValueAt>
[[nodiscard]] Phases cubicOf(int x, int y, const ValueAt& valueAt) {
    const std::array<Phases, kTaps>& weights = cubicWeights();
    const double here = valueAt(x, y);
    Phases out = Phases::Constant(here);
    for (int tap = 0; tap < kTaps; ++tap) {
        const Offset of = kTapAt[tap];
        out += (valueAt(x + of.x, y + of.y) - here) * weights[tap];
    }
    return out;
}

}  // namespace mfar::enlarge
