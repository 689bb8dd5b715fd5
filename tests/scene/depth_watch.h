#pragma once

#include "hal/virtual/synthetic_board.h"
#include "pipeline/pipeline.h"

#include <opencv2/core.hpp>

#include <optional>

namespace mfar::test {

/// Accuracy of a frame's depth in the silhouette of an object. Medians over every third pixel of
/// every third row.
struct DepthState {
    double absrel = 0;        ///< |z - true z| / true z where known; NaN: nowhere
    double completeness = 0;  ///< share of the pixels that are known
    double sigma = 0;         ///< what the pipeline takes for the error, as a share of rho
    /// Change of rho / true rho since the frame before, at the same point of the scene, where known
    /// in both; 0: nowhere.
    double change = 0;
};

/// Compares a pipeline's depth with the board's truth, frame by frame.
class DepthWatch {
public:
    /// `board` must outlive this.
    DepthWatch(const SyntheticBoard& board, const VirtualObject& object)
        : board_(board), object_(object) {}

    /// `time`: when the frame was taken.
    [[nodiscard]] DepthState look(const Pipeline& pipeline, Timestamp time);

private:
    [[nodiscard]] cv::Mat trueDepth(Timestamp time) const;
    [[nodiscard]] double ratioBefore(int x, int y, double rho, const RigidTransform& pose) const;

    const SyntheticBoard& board_;
    VirtualObject object_;
    cv::Mat ratio_;  // of the frame before: rho / true rho, 0 where it is not known
    std::optional<RigidTransform> pose_;
};

}  // namespace mfar::test
