#pragma once

#include "pipeline/simd/patch_flow.h"

namespace mfar::simd {

/// The flow of one pyramid level's cells, with margins that cleanUpCells() reads. Initially, all
/// values are zero.
class FlowField {
public:
    explicit FlowField(Size cells)
        : cells_(cells), x_(withMargins(cells)), y_(withMargins(cells)), cost_(withMargins(cells)),
          texture_(withMargins(cells)) {}

    [[nodiscard]] Size cells() const { return cells_; }
    [[nodiscard]] FlowPlanes planes() {
        return {first(x_),  first(y_),    first(cost_), first(texture_),
                x_.pitch(), cells_.width, cells_.height};
    }
    [[nodiscard]] static float* first(AlignedRows<float>& plane) {
        return plane[kCleanUpRadius] + kFieldMargin;
    }
    [[nodiscard]] static Size withMargins(Size cells) {
        return {cells.width + 2 * kFieldMargin, cells.height + 2 * kCleanUpRadius};
    }

private:
    Size cells_;
    AlignedRows<float> x_, y_, cost_, texture_;
};

}  // namespace mfar::simd
