#pragma once

#include "pipeline/epipolar/epipolar_search.h"
#include "pipeline/epipolar/field_prediction.h"
#include "pipeline/epipolar/unit_pose.h"
#include "pipeline/simd/cell_flow_rows.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Computes the flow between a frame and the still by the epipolar search. There is one flow vector
/// per cell. s is an inverse depth, see EpipolarLens.
class EpipolarFlow {
public:
    using Cells = std::vector<simd::CellVector>;

    EpipolarFlow(const StereoRig& rig, std::shared_ptr<Workers> workers,
                 const EpipolarOptions& options = {});

    /// See EpipolarSearch::setOptions().
    void setOptions(const EpipolarOptions& options);

    /// Sets the still, at full size. `pose` is the pose of the video camera at the still's time.
    void setStill(const ImageView& still, const Pose& pose);
    void setStill(const Rows<const std::uint8_t>& still, const Pose& pose);
    void dropStill();
    /// True if a still is set and the motion between it and a frame with this pose is known.
    [[nodiscard]] bool matches(const Pose& frame) const {
        return stillPose_ && stillPose_->world == frame.world;
    }

    /// Refines the relative pose and matches the frame with the still. May be called only while
    /// there is a still. Matches the pixels in `where` [video px], which must not be empty, and in
    /// a margin around it. If s is predicted from the last frame, all pixels that were matched in
    /// the last frame are matched. The remaining pixels get the s of the nearest matched pixel.
    /// `rests`: true if the camera has not moved since the still was taken, see restingPose().
    void run(const ImageView& video, const Pose& pose, const PixelRect& where, bool rests = false);
    void run(const ImageView& video, const Pose& pose) {
        run(video, pose, {0, 0, rig_.video.size.width, rig_.video.size.height});
    }
    void run(const Rows<const std::uint8_t>& video, const Pose& pose, const PixelRect& where,
             bool rests = false);

    /// Flow from the video to the still, one entry per cell: x, y [video px], and two unused
    /// numbers. Positions in the still are those after resampling it with the video's lens.
    [[nodiscard]] const Cells& forward() const { return forward_; }
    /// Two-way error [px], one entry per cell: the error (eq. 2 of the paper, see docs/paper.md),
    /// and three zeros. Several cells can match the same cell of the still. The error of each is
    /// the difference between its parallax and that of the nearest of these cells, minus 1 px, and
    /// at least 0. (The parallaxes of cells of one slanted surface differ by up to 1 px.) If the
    /// flow ends outside the resampled still, which has the video's size, the error is 1e4.
    [[nodiscard]] const Cells& occlusion() const { return hidden_; }
    /// Converts flow vectors to inverse depths. For every cell, finds the point on its epipolar
    /// line that is nearest to the end of its vector in `flow`, and returns the s of this point.
    /// Near the epipole and without parallax, a cell keeps its s. `flow` is usually forward() after
    /// FlowStep::refine().
    [[nodiscard]] const std::vector<float>& sOf(const Cells& flow);
    /// Returns the flow at every video pixel [px], x and y interleaved. The flow of a point that
    /// the still camera cannot see ends far outside the picture.
    [[nodiscard]] std::vector<float> flow() const;
    /// Returns the distance of a flow vector's end from the pixel's epipolar line [px]. Near the
    /// epipole and without parallax, the line counts as a point.
    [[nodiscard]] float offLine(int x, int y, float flowX, float flowY) const;
    /// The epipolar search with its results. Its unit of length is the distance between the
    /// position of the video camera at the frame's time and that of the still camera at the still's
    /// time.
    [[nodiscard]] const EpipolarSearch& search() const { return search_; }
    /// See UnitPose::unit and UnitPose::lengthError.
    [[nodiscard]] double unit() const { return unit_; }
    [[nodiscard]] double lengthError() const { return lengthError_; }
    /// Rotates rays of the frame into the video camera's orientation at the time of the still.
    [[nodiscard]] const Eigen::Matrix3f& rotation() const { return rotation_; }
    /// Luma of the frame. Valid until the next run(), but not longer than the input of run().
    [[nodiscard]] const Rows<const std::uint8_t>& luma() const { return frame_; }
    /// True if the last frame was searched only around the values of s that were predicted from the
    /// frame before.
    [[nodiscard]] bool predicted() const { return predictedFrames_ > 0; }

private:
    [[nodiscard]] EpipolarLens::Point endOf(float rayX, float rayY, float s) const;
    [[nodiscard]] simd::FlowEnds flowEnds() const;
    [[nodiscard]] simd::CellRow cellRow(int j, const float* raysX, const float* raysY) const;
    void search(const UnitPose& relative, const PixelRect& where);
    [[nodiscard]] std::span<const float> ofArea(std::span<const float> cells);
    [[nodiscard]] float sAt(int x, int y) const;
    void fillForward();
    void fillDepths(int j);
    [[nodiscard]] float depthOf(int i, int j) const;
    void testDepth();

    StereoRig rig_;
    Size cells_;
    EpipolarSearch search_;
    std::shared_ptr<Workers> workers_;
    int mostPredicted_;
    FieldPrediction prediction_;
    int predictedFrames_ = 0;
    EpipolarLens lens_, cellRays_;
    Eigen::Matrix3f rotation_;
    double unit_ = 1, lengthError_ = 0;
    std::optional<Pose> stillPose_;
    LumaImage luma_;
    Rows<const std::uint8_t> frame_;
    Cells forward_, hidden_;
    std::vector<float> predicted_;
    // s_: s of each cell of the video, from the search. aligned_: result of sOf(). nearest_: for
    // each cell of the still, the largest s of the video's cells that match it.
    std::vector<float> s_, aligned_, nearest_;
    std::vector<std::int32_t> landing_;
    // Rays through the point between each cell's four central pixels.
    std::vector<float> middleRaysX_, middleRaysY_;
    std::vector<float> middlesX_, middlesY_;
};

}  // namespace mfar
