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

/// Flow between a frame and the still from the epipolar search, for users that work on cells of 4x4
/// video pixels.
class EpipolarFlow {
public:
    /// Row-major, one entry per cell of 4x4 video pixels.
    using Cells = std::vector<simd::CellVector>;

    EpipolarFlow(const StereoRig& rig, std::shared_ptr<Workers> workers,
                 const EpipolarOptions& options = {});

    /// See EpipolarSearch::setOptions().
    void setOptions(const EpipolarOptions& options);

    /// Sets the new reference as its sensor took it, and the video camera's pose at that time.
    void setStill(const ImageView& still, const Pose& pose);
    /// As above, for luma.
    void setStill(const Rows<const std::uint8_t>& still, const Pose& pose);
    void dropStill();
    [[nodiscard]] bool hasStill() const { return stillPose_.has_value(); }

    /// Refines the relative pose and searches; needs a still. Afterwards forward(), hidden() and
    /// search() hold the results of this frame. Pixels outside `where` [video px] and a margin
    /// around it may not be searched: they take the depth of the nearest searched pixel. `where`
    /// must not be empty.
    void run(const ImageView& video, const Pose& pose, const PixelRect& where);
    void run(const ImageView& video, const Pose& pose) {
        run(video, pose, {0, 0, rig_.video.size.width, rig_.video.size.height});
    }
    /// As above, for the frame's luma.
    void run(const Rows<const std::uint8_t>& video, const Pose& pose, const PixelRect& where);

    /// Video -> still: flow x, y [video px at the video's geometry], -, -.
    [[nodiscard]] const Cells& forward() const { return forward_; }
    /// The two-way error of eq. 2 [px], -, -, -. It comes from a z-test: by how much less parallax
    /// a cell has than the nearest surface that lands on the same cell of the still.
    [[nodiscard]] const Cells& hidden() const { return hidden_; }
    /// Inverse depth s of every cell whose epipolar flow comes closest to `flow`, for example
    /// forward() after its refinement in both dimensions.
    [[nodiscard]] const std::vector<float>& inverseDepthOf(const Cells& flow);
    /// Flow at every video pixel, x, y interleaved; far outside where the still cannot see it.
    [[nodiscard]] std::vector<float> flow() const;
    /// Distance of a flow at a pixel from the pixel's epipolar line [px]. Without parallax the line
    /// is a point: the distance from that point.
    [[nodiscard]] float offLine(int x, int y, float flowX, float flowY) const;
    /// The search's unit of length is the distance between the still's camera and the frame's.
    [[nodiscard]] const EpipolarSearch& search() const { return search_; }
    /// The search's unit of length [unit of length of the poses].
    [[nodiscard]] double unit() const { return unit_; }
    /// See UnitPose::lengthError.
    [[nodiscard]] double lengthError() const { return lengthError_; }
    /// Rotates the frame's rays into the still at the video's geometry.
    [[nodiscard]] const Eigen::Matrix3f& rotation() const { return rotation_; }
    /// Luma of the frame; valid as long as the input of run().
    [[nodiscard]] const Rows<const std::uint8_t>& luma() const { return frame_; }
    /// True when the last frame was searched around the prediction from the frame before it.
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
    int predictedFrames_ = 0;  // since the last search from coarse to fine
    EpipolarLens lens_, cellRays_;
    Eigen::Matrix3f rotation_;
    double unit_ = 1, lengthError_ = 0;
    std::optional<Pose> stillPose_;
    LumaImage luma_;  // filled when the input of run() has another format
    Rows<const std::uint8_t> frame_;
    Cells forward_, hidden_;
    std::vector<float> predicted_;
    std::vector<float> nearness_, aligned_,
        nearest_;  // s per cell of the video; nearest s that landed on each cell of the still
    std::vector<std::int32_t> landing_;  // cell of the still
    // Rays of the four middle pixels of each cell.
    std::vector<float> middleRaysX_, middleRaysY_;
    std::vector<float> middlesX_, middlesY_;  // [px], by column and by row
};

}  // namespace mfar
