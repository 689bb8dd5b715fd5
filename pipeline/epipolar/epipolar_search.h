#pragma once

#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/epipolar/field_filters.h"
#include "pipeline/epipolar/pose_patches.h"
#include "pipeline/epipolar/relative_pose.h"
#include "pipeline/epipolar/semi_global.h"
#include "pipeline/epipolar/turned_picture.h"
#include "pipeline/flow/flow_options.h"
#include "pipeline/simd/label_lines.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mfar {

/// Returns the still camera, reduced to the focal length [px] of the video camera. If the still
/// camera has the shorter focal length, it stays unchanged.
[[nodiscard]] CameraModel atScaleOf(const StereoRig& rig);

/// Matches every pixel of a video frame with a still whose relative pose is known. The search
/// follows each pixel's epipolar line, from coarse to fine. Matching costs come from the census
/// transform and are smoothed by semi-global matching. Runs on the CPU, without GL.
class EpipolarSearch {
public:
    /// Throws std::invalid_argument if an option is out of range.
    EpipolarSearch(const StereoRig& rig, std::shared_ptr<Workers> workers,
                   const EpipolarOptions& options = {});

    /// Sets options for the next run. Only options that can change between frames are used, see
    /// changed() in flow_options.h. Throws std::invalid_argument if an option is out of range.
    void setOptions(const EpipolarOptions& options) { options_ = changed(options_, options); }

    /// Sets the still. It is given at full size and is reduced here, see atScaleOf().
    void setStill(const ImageView& still);
    void setStill(const Rows<const std::uint8_t>& still);

    /// Sets the rectangle of video pixels to match. It is widened to multiples of a few pixels;
    /// area() returns the result. Before the first call, the area is the whole picture.
    void setArea(const PixelRect& pixels);
    [[nodiscard]] const PixelRect& area() const { return area_; }
    [[nodiscard]] const EpipolarLens& videoLens() const { return lenses_.front(); }

    /// Matches the pixels of the area. `video` is the whole frame. `T_still_video` transforms video
    /// camera coordinates at the frame's time to still camera coordinates at the still's time, in
    /// any unit of length.
    ///
    /// `covariance` is the covariance of a small motion x in T_still_video * exp(x). With it, the
    /// pose is first refined from the pictures. Without it, the pose counts as exact. `predicted`
    /// is empty or contains an approximate s of every cell in the area, row-major. With it, the
    /// coarser pyramid levels are not searched.
    /// Returns false and sets s() to zero if the pose is invalid (soundMotion()) or if the
    /// resampled still (see TurnedPicture::place()) is less than 16 px wide or high.
    bool run(const Rows<const std::uint8_t>& video, const RigidTransform& T_still_video,
             const std::optional<Matrix6>& covariance = std::nullopt,
             std::span<const float> predicted = {});

    /// The relative pose T_still_video with which the last run() searched. If run() refined the
    /// pose that it was given, refinement() describes the difference.
    [[nodiscard]] const RigidTransform& pose() const { return pose_; }
    [[nodiscard]] const PoseRefinement& refinement() const { return refinement_; }
    /// Expected distance of matches from their epipolar lines [px]. At pyramid levels where it
    /// exceeds half a pixel, one pixel on each side of a line is searched, too.
    [[nodiscard]] double normalError() const { return normalError_; }

    /// s [1/unit of length] of each pixel of the area, see EpipolarLens. Noise or pose errors can
    /// make it negative; such a point would be beyond infinity.
    [[nodiscard]] const std::vector<float>& s() const { return s_; }
    /// Finds out which points the still shows. The points lie on the rays of the frame's pixels
    /// from (x, y) to the right, and `s` are their values of s. If the still does not show a point,
    /// because the point is outside of its picture, sets `landing` of that point to -1. Threads may
    /// call it at the same time.
    void dropUnseen(int x, int y, std::span<const float> s, std::span<std::int32_t> landing) const;
    /// Largest motion of any pixel along its epipolar line [px] per unit of s. If there is no
    /// parallax, it is zero, and nothing was searched.
    [[nodiscard]] double pixelsPerUnit() const { return pixelsPerUnit_; }
    /// The translation t in q = p + t. p is a point in coordinates of the frame's camera. q is the
    /// same point in coordinates of the still camera, after the still camera was rotated into the
    /// orientation of the frame's camera.
    [[nodiscard]] const Eigen::Vector3f& translation() const { return translation_; }
    /// Largest searched label (candidate of s, counted in steps) at full size. It is equal to the
    /// longest searched parallax [px]. If nothing was searched, it is zero.
    [[nodiscard]] int labels() const { return labels_; }

private:
    struct Level {
        EpipolarLens lens;
        PixelOffset origin;
        LumaImage video, still, smoothVideo, smoothStill;
        std::vector<std::uint8_t> seen;
        std::vector<std::uint32_t> videoCensus, stillCensus;
        std::vector<std::int16_t> base;
        std::vector<float> labels;

        [[nodiscard]] TurnedPair pair() const { return {lens, origin, video, still, seen}; }
    };

    [[nodiscard]] bool place(const RigidTransform& T_still_video, int levels);
    [[nodiscard]] bool turnStill(const Eigen::Matrix3d& R_still_video, int levels);
    [[nodiscard]] bool matchAll(const std::optional<Matrix6>& covariance,
                                std::span<const float> predicted, int levels);
    void measureParallax();
    void searchCoarsest();
    void searchFiner();
    [[nodiscard]] int finestLevel() const;
    void readInverseDepth();
    void searchAround(std::span<const float> predicted);
    void refine(const Matrix6& covariance, std::span<const float> predicted);
    void prepare(int index);
    /// Approximate labels, which were either predicted or found at the next coarser pyramid level.
    /// A label is an inverse depth, counted in steps (see simd::LabelLines). `scale` converts the
    /// labels to those of the finer level. Each label belongs to 2^shift pixels of the finer level
    /// along each axis.
    struct Coarser {
        const std::vector<float>& labels;
        Size size;
        float scale;
        int shift;
    };
    void centreWindows(const Coarser& coarse, Level& fine);
    void match(int index, int vectors);
    [[nodiscard]] simd::LabelLines linesOf(int index) const;
    void costRow(int index, int vectors, int y, std::uint8_t* out) const;
    [[nodiscard]] bool hasSlack(int index) const;
    void placeLabels(int index);

    EpipolarOptions options_;
    CameraModel whole_, video_, still_;  // video_: camera of the area; still_: see atScaleOf()
    PixelRect area_;
    std::vector<EpipolarLens> lenses_;
    std::shared_ptr<Workers> workers_;
    TurnedPicture turned_;
    std::vector<Level> levels_;
    LumaImage picture_;
    SemiGlobal matcher_;
    std::vector<Valley> valleys_;
    RigidTransform pose_;
    PoseRefinement refinement_;
    double stillNoise_ = 0, videoNoise_ = 0, normalError_ = 0;
    Eigen::Vector3f translation_ = Eigen::Vector3f::Zero();
    double pixelsPerUnit_ = 0;
    int labels_ = 0;
    std::vector<float> s_, scratch_, predicted_;
    LocalRange range_;
};

}  // namespace mfar
