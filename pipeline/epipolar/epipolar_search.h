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

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mfar {

/// Returns the still camera, scaled down to the focal length [px] of the video camera. It is never
/// scaled up.
[[nodiscard]] CameraModel atScaleOf(const StereoRig& rig);

/// Matches every pixel of a video frame with a still of known relative pose. Searches along each
/// pixel's epipolar line, from coarse to fine, with a census cost and semi-global smoothness. Runs
/// on the CPU, without GL.
class EpipolarSearch {
public:
    /// Throws std::invalid_argument if an option is out of range.
    EpipolarSearch(const StereoRig& rig, std::shared_ptr<Workers> workers,
                   const EpipolarOptions& options = {});

    /// Sets the options that can change between frames (see changed() in flow_options.h) for the
    /// next run. Throws std::invalid_argument if an option is out of range.
    void setOptions(const EpipolarOptions& options) { options_ = changed(options_, options); }

    /// Sets the still as its sensor delivered it.
    void setStill(const ImageView& still);
    void setStill(const Rows<const std::uint8_t>& still);

    /// Sets the rectangle of video pixels to match. It is widened to a grid of a few pixels, see
    /// area(). Initially, the whole picture is matched.
    void setArea(const PixelRect& pixels);
    [[nodiscard]] const PixelRect& area() const { return area_; }
    [[nodiscard]] const EpipolarLens& videoLens() const { return lenses_.front(); }

    /// Matches the pixels of the area. `video` is the whole frame. `T_still_video` transforms video
    /// camera coordinates at the frame's time to still camera coordinates at the still's time, in
    /// any unit of length.
    ///
    /// `covariance` is the covariance of a small motion x in T_still_video * exp(x). If given, the
    /// pose is first refined from the pictures, otherwise it counts as exact. `predicted` is an
    /// approximate s of every cell in the area, row-major. If given, the coarser pyramid levels are
    /// skipped.
    /// Returns false and sets s() to zero if the pose is invalid (soundMotion()) or no
    /// part of the still can show the area.
    bool run(const Rows<const std::uint8_t>& video, const RigidTransform& T_still_video,
             const std::optional<Matrix6>& covariance = std::nullopt,
             std::span<const float> predicted = {});

    /// The relative pose T_still_video that the last run() used. If run() refined it, refinement()
    /// describes the difference from the argument of run().
    [[nodiscard]] const RigidTransform& pose() const { return pose_; }
    [[nodiscard]] const PoseRefinement& refinement() const { return refinement_; }
    /// Expected distance of matches from their epipolar lines [px]. At pyramid levels where it
    /// exceeds half a pixel, one pixel on both sides of each line is searched too.
    [[nodiscard]] double normalError() const { return normalError_; }

    /// s [1/unit of length] of each pixel of the area, see EpipolarLens. Noise or pose errors can
    /// make it negative, which is beyond infinity.
    [[nodiscard]] const std::vector<float>& s() const { return s_; }
    /// Largest motion of any pixel along its epipolar line [px] per unit of s. Zero if there is no
    /// parallax; then nothing was searched.
    [[nodiscard]] double pixelsPerUnit() const { return pixelsPerUnit_; }
    /// Translation of points from the frame's to the still's camera, in the frame's orientation.
    [[nodiscard]] const Eigen::Vector3f& translation() const { return translation_; }
    /// Number of labels (candidates of s) per pixel at the finest pyramid level. Zero if nothing
    /// was searched.
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
    /// Approximate labels (steps of s, see simd::LabelLines), either predicted or found at the next
    /// coarser pyramid level. `scale` converts them to labels of the finer level. Each value covers
    /// 2^shift pixels of the finer level along each axis.
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
