#pragma once

#include "pipeline/flow/epipolar_lens.h"
#include "pipeline/flow/field_filters.h"
#include "pipeline/flow/semi_global.h"
#include "pipeline/flow/turned_picture.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace mfar {

/// Dense matching of a video frame with a still whose relative pose is known: a search along each
/// pixel's epipolar line, coarse to fine, with a census cost and semi-global smoothness.
///
/// Everything is at the video's geometry: the still comes as the video camera would have seen it
/// from the still camera's place at the time of the still (see LumaPyramids). Runs on the host's
/// processor; no GL.
class EpipolarSearch {
public:
    EpipolarSearch(const CameraModel& video, std::shared_ptr<Workers> workers);

    /// The still at the video's geometry, luma. Size must be the camera's.
    void setStill(const LumaImage& still);

    /// `T_still_video`: video coordinates of the frame to those of the still at the video's
    /// geometry; its unit of length is free. Returns false, and no field, where no pixel of the
    /// frame can see the still.
    bool run(const LumaImage& video, const RigidTransform& T_still_video);

    /// Per pixel: s [1/unit of length], see EpipolarLens. Less than zero where the best match lies
    /// beyond infinity, as noise and errors of the pose make it.
    [[nodiscard]] const std::vector<float>& inverseDepth() const { return inverseDepth_; }
    /// Longest way of a pixel per unit of s [px]; zero: no parallax, nothing was searched.
    [[nodiscard]] double pixelsPerUnit() const { return pixelsPerUnit_; }
    /// Translation of points from the frame to the still, in the frame's orientation.
    [[nodiscard]] const Eigen::Vector3f& translation() const { return translation_; }
    [[nodiscard]] const Eigen::Matrix3f& rotation() const { return rotation_; }
    /// Labels compared at the finest level; zero when nothing was searched.
    [[nodiscard]] int labels() const { return labels_; }

private:
    struct Level {
        EpipolarLens lens;
        PixelOffset origin;  // of the still's canvas, in pixels of the lens
        LumaImage video, still, smoothVideo, smoothStill;
        std::vector<std::uint8_t> seen;
        std::vector<std::uint32_t> videoCensus, stillCensus;
        std::vector<std::int16_t> base;
        std::vector<float> labels;
    };

    [[nodiscard]] bool turnStill();
    void measureParallax();
    void prepare(Level& level);
    void search(int index);
    void centreWindows(const Level& coarse, Level& fine);
    void costRow(const Level& level, int index, int vectors, int y, std::uint8_t* out) const;

    CameraModel camera_;
    std::shared_ptr<Workers> workers_;
    TurnedPicture turned_;
    std::vector<Level> levels_;
    LumaImage still_;
    SemiGlobal matcher_;
    double stillNoise_ = 0, videoNoise_ = 0;
    Eigen::Matrix3f rotation_ = Eigen::Matrix3f::Identity();
    Eigen::Vector3f translation_ = Eigen::Vector3f::Zero();
    double pixelsPerUnit_ = 0;
    int labels_ = 0;
    std::vector<float> inverseDepth_, scratch_;
    LocalRange range_;
};

}  // namespace mfar
