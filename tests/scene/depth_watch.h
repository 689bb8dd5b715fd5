#pragma once

#include "hal/virtual/synthetic_board.h"
#include "pipeline/pipeline.h"

#include <opencv2/core.hpp>

#include <optional>

namespace mfar::test {

/// Accuracy of the depth of a frame within an object's silhouette, at every third pixel of every
/// third row. Apart from the completeness, the values are medians.
struct DepthState {
    double absrel = 0;        ///< |z - true z| / true z where z is known; NaN: known nowhere
    double completeness = 0;  ///< share of the pixels with known depth
    /// Standard deviation of the inverse depth that the pipeline reports, as a share of the inverse
    /// depth.
    double sigma = 0;
    /// Change since the previous frame of the ratio (inverse depth / true inverse depth), at the
    /// same points of the scene. Only points with known depth in both frames count; 0 if there are
    /// none.
    double change = 0;
};

/// Compares the depth of a pipeline with the board's truth, frame by frame.
class DepthWatch {
public:
    /// `board` must outlive this object.
    DepthWatch(const SyntheticBoard& board, const VirtualObject& object)
        : board_(board), object_(object) {}

    [[nodiscard]] DepthState look(const Pipeline& pipeline, Timestamp time);

private:
    /// Returns the true inverse depth at the measured pixels; 0 elsewhere.
    [[nodiscard]] cv::Mat trueDepth(Timestamp time) const;
    [[nodiscard]] double ratioBefore(int x, int y, double inverseDepth,
                                     const RigidTransform& pose) const;

    const SyntheticBoard& board_;
    VirtualObject object_;
    cv::Mat ratio_;  // (inverse depth / true inverse depth) of the previous frame; 0: unknown
    std::optional<RigidTransform> pose_;
};

}  // namespace mfar::test
