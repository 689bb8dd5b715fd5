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

/// Computes the flow between a frame and the still by the epipolar search, for steps that work on
/// cells of 4x4 video pixels.
class EpipolarFlow {
public:
    /// Row-major, one entry per cell of 4x4 video pixels.
    using Cells = std::vector<simd::CellVector>;

    EpipolarFlow(const StereoRig& rig, std::shared_ptr<Workers> workers,
                 const EpipolarOptions& options = {});

    /// See EpipolarSearch::setOptions().
    void setOptions(const EpipolarOptions& options);

    /// Sets a new still, as its sensor delivered it, and the pose of the video camera at that time.
    void setStill(const ImageView& still, const Pose& pose);
    /// Like the other setStill(), for the luma of a still.
    void setStill(const Rows<const std::uint8_t>& still, const Pose& pose);
    void dropStill();
    [[nodiscard]] bool hasStill() const { return stillPose_.has_value(); }

    /// Refines the relative pose and matches the frame with the still, which must have been set.
    /// Afterwards forward(), occlusion() and search() have the results of this frame. Only pixels
    /// in `where` [video px], and in a margin around it, are certainly matched; others may get the
    /// depth of the nearest matched pixel. `where` must not be empty.
    void run(const ImageView& video, const Pose& pose, const PixelRect& where);
    void run(const ImageView& video, const Pose& pose) {
        run(video, pose, {0, 0, rig_.video.size.width, rig_.video.size.height});
    }
    /// Like the other run(), for the luma of a frame.
    void run(const Rows<const std::uint8_t>& video, const Pose& pose, const PixelRect& where);

    /// Flow from the video to the still, drawn with the video's lens: x, y [video px]; the other
    /// two numbers of each entry are unused.
    [[nodiscard]] const Cells& forward() const { return forward_; }
    /// Two-way error of each cell (eq. 2 of the paper) [px] in the first number of its entry; the
    /// others are unused. A z-test determines the error: it is the difference between the parallax
    /// of the cell and that of the nearest surface that lands on the same cell of the still.
    [[nodiscard]] const Cells& occlusion() const { return hidden_; }
    /// Returns s for every cell: the value whose flow along the epipolar line is closest to `flow`.
    /// For example, `flow` is forward() after it was refined in both dimensions.
    [[nodiscard]] const std::vector<float>& inverseDepthOf(const Cells& flow);
    /// Returns the flow at every video pixel, x and y interleaved. Where the still camera cannot
    /// see the pixel, the flow leads far outside the picture.
    [[nodiscard]] std::vector<float> flow() const;
    /// Returns the distance from a pixel's epipolar line [px] of the point to which the flow leads.
    /// Without parallax the line is a point; then the distance is that from this point.
    [[nodiscard]] float offLine(int x, int y, float flowX, float flowY) const;
    /// The epipolar search with its results. Its unit of length is the distance between the cameras
    /// of the still and of the frame.
    [[nodiscard]] const EpipolarSearch& search() const { return search_; }
    /// The search's unit of length [unit of length of the poses].
    [[nodiscard]] double unit() const { return unit_; }
    /// See UnitPose::lengthError.
    [[nodiscard]] double lengthError() const { return lengthError_; }
    /// Rotates rays of the frame into the still camera's orientation.
    [[nodiscard]] const Eigen::Matrix3f& rotation() const { return rotation_; }
    /// Luma of the frame. Valid as long as the input of run() is valid.
    [[nodiscard]] const Rows<const std::uint8_t>& luma() const { return frame_; }
    /// True if the last frame was searched only around the prediction from the frame before it.
    [[nodiscard]] bool predicted() const { return predictedFrames_ > 0; }

private:
    [[nodiscard]] EpipolarLens::Point endOf(float rayX, float rayY, float s) const;
    [[nodiscard]] simd::FlowEnds flowEnds() const;
    [[nodiscard]] simd::CellRow cellRow(int j, const float* raysX, const float* raysY) const;
    void search(const UnitPose& relative, const PixelRect& where);
    [[nodiscard]] std::span<const float> ofArea(std::span<const float> cells);
    [[nodiscard]] float nearnessAt(int x, int y) const;
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
    int predictedFrames_ = 0;  // number of frames since the last search from coarse to fine
    EpipolarLens lens_, cellRays_;
    Eigen::Matrix3f rotation_;
    double unit_ = 1, lengthError_ = 0;
    std::optional<Pose> stillPose_;
    LumaImage luma_;  // luma of the frame, if run() got another format
    Rows<const std::uint8_t> frame_;
    Cells forward_, hidden_;
    std::vector<float> predicted_;
    // nearness_, aligned_: s of each video cell; nearest_: largest s that lands on each still cell.
    std::vector<float> nearness_, aligned_, nearest_;
    std::vector<std::int32_t> landing_;  // index of the still cell on which each video cell lands
    // Rays through the middle of each cell's four central pixels.
    std::vector<float> middleRaysX_, middleRaysY_;
    std::vector<float> middlesX_, middlesY_;  // middle of each column and row of cells [px]
};

}  // namespace mfar
