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

/// Flow between a frame and the still, computed by the epipolar search, for users that work on
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
    /// As above, for the luma of a still.
    void setStill(const Rows<const std::uint8_t>& still, const Pose& pose);
    void dropStill();
    [[nodiscard]] bool hasStill() const { return stillPose_.has_value(); }

    /// Refines the relative pose and searches; needs a still. Afterwards forward(), occlusion() and
    /// search() hold the results of this frame. Only pixels in `where` [video px], and in a margin
    /// around it, are certainly searched; others may take the depth of the nearest searched pixel.
    /// `where` must not be empty.
    void run(const ImageView& video, const Pose& pose, const PixelRect& where);
    void run(const ImageView& video, const Pose& pose) {
        run(video, pose, {0, 0, rig_.video.size.width, rig_.video.size.height});
    }
    /// As above, for the frame's luma.
    void run(const Rows<const std::uint8_t>& video, const Pose& pose, const PixelRect& where);

    /// Flow from the video to the still: x, y [video px, with the still drawn through the video's
    /// lens]; the other two entries are unused.
    [[nodiscard]] const Cells& forward() const { return forward_; }
    /// Two-way error (eq. 2 of the paper) [px] in the first entry; the others are unused. A z-test
    /// determines the error: it is the parallax that a cell lacks, compared with the nearest
    /// surface that lands on the same cell of the still.
    [[nodiscard]] const Cells& occlusion() const { return hidden_; }
    /// Returns the inverse depth s of every cell, chosen so that its epipolar flow comes closest to
    /// `flow`. For example, `flow` may be forward() after refinement in both dimensions.
    [[nodiscard]] const std::vector<float>& inverseDepthOf(const Cells& flow);
    /// Returns the flow at every video pixel, x and y interleaved; far outside the picture where
    /// the still cannot see the pixel.
    [[nodiscard]] std::vector<float> flow() const;
    /// Distance of a flow at a pixel from the pixel's epipolar line [px]. Without parallax the line
    /// is a point; then this is the distance from that point.
    [[nodiscard]] float offLine(int x, int y, float flowX, float flowY) const;
    /// The search. Its unit of length is the distance between the cameras of the still and of the
    /// frame.
    [[nodiscard]] const EpipolarSearch& search() const { return search_; }
    /// The search's unit of length [unit of length of the poses].
    [[nodiscard]] double unit() const { return unit_; }
    /// See UnitPose::lengthError.
    [[nodiscard]] double lengthError() const { return lengthError_; }
    /// Rotates rays of the frame into the still camera's orientation.
    [[nodiscard]] const Eigen::Matrix3f& rotation() const { return rotation_; }
    /// Luma of the frame; valid as long as the input of run() is.
    [[nodiscard]] const Rows<const std::uint8_t>& luma() const { return frame_; }
    /// True if the last search only looked near the prediction from the frame before.
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
    LumaImage luma_;  // used if the input of run() has another format
    Rows<const std::uint8_t> frame_;
    Cells forward_, hidden_;
    std::vector<float> predicted_;
    std::vector<float> nearness_, aligned_,
        nearest_;  // s of each video cell; nearest s that lands on each still cell
    std::vector<std::int32_t> landing_;  // still cell on which each video cell lands
    // Rays through the middle of each cell's four central pixels.
    std::vector<float> middleRaysX_, middleRaysY_;
    std::vector<float> middlesX_, middlesY_;  // middle of each column and row of cells [px]
};

}  // namespace mfar
