#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/warp/warp_options.h"
#include "pipeline/warp/warp_step.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Totals since the start and values of the newest frame.
struct WarpCounters {
    std::uint64_t warped = 0;     ///< displayed frames that were warped
    std::uint64_t unmoved = 0;    ///< frames that show the traced picture unchanged
    std::uint64_t empty = 0;      ///< frames in which no virtual object is in view
    std::uint64_t requested = 0;  ///< pixels requested for individual rendering
    std::uint64_t answered = 0;   ///< pixels that were rendered and returned
    std::uint64_t rays = 0;       ///< number of samples of all requested pixels
    int openHoles = 0;            ///< pixels that no picture shows, in the frame last evaluated
    int cracks = 0;               ///< pixels in one-pixel-wide cracks, in the frame last evaluated
};

/// Image-based rendering of the virtual layer. It shows a finished picture, the traced picture,
/// from the camera's current pose. This takes two passes (paper, eq. 5): one for depth, and one in
/// which each pixel looks up its colour. The result is clipped to the silhouette of the models at
/// the current pose.
/// An engine's WarpStep processes the pixels. This class decides which pictures are shown and which
/// pixels are rendered individually.
class Warp {
public:
    /// `video` is the video camera's model at any resolution; the layer has size `output`. `engine`
    /// must outlive this object. Throws std::invalid_argument if an option is out of range. With
    /// the GLES engine, throws GlError if the GL implementation cannot draw into R32F.
    Warp(const CameraModel& video, Size output, Engine& engine, const WarpOptions& options = {});
    Warp(const Warp&) = delete;
    Warp& operator=(const Warp&) = delete;

    /// Sets the models. Discards the traced picture and all re-rendered pictures, because they
    /// belong to another scene.
    void setScene(const Scene& scene);
    /// Takes effect with the next run(). Replaces the traced picture. Re-rendered pictures
    /// stay valid, but a list of holes that is still being read back is discarded.
    void setTracedPicture(TracedPicture traced);
    void dropTracedPicture();

    /// See WarpStep::takesLight().
    [[nodiscard]] bool takesLight() const { return step_->takesLight(); }

    /// Returns the layer as seen from this pose. The picture is empty if there is no scene or no
    /// traced picture, or if the pose is not finite. It is valid until the next call of any member.
    LayerPicture& run(const RigidTransform& T_world_camera);

    /// Must be called once per frame, including frames that are not drawn because the camera rests.
    /// Never waits.
    /// Returns the pixels to render individually: the holes of a recent frame, or edge pixels if
    /// the camera rests. If there are more than mostRequested pixels, an evenly spread selection is
    /// returned. Empty if no pixels are known, or if an earlier request for the same scene was not
    /// answered yet.
    [[nodiscard]] std::optional<HoleRequest> takeRequest();
    /// Adds the pixels that takeRequest() requested; they are shown from the next run() on. Answers
    /// for another scene are ignored. Throws std::invalid_argument if the fields of the answer have
    /// different lengths, a pixel is outside the layer, or the pose is not finite.
    void answer(const HoleAnswer& answer);

    [[nodiscard]] const WarpCounters& counters() const { return counters_; }
    /// The camera, scaled to the layer's resolution.
    [[nodiscard]] const CameraModel& camera() const { return lens_.camera; }
    /// For tests: see WarpStep::state().
    [[nodiscard]] const Field<std::uint32_t>& state() const { return step_->state(); }

private:
    [[nodiscard]] bool isUnmoved(const RigidTransform& from, const RigidTransform& to) const;
    void dropRefused(std::vector<std::uint32_t>& pixels) const;
    void rested(const std::optional<RigidTransform>& T_world_camera);
    std::optional<HoleRequest> request(std::vector<std::uint32_t> pixels, bool edges,
                                       const RigidTransform& T_world_camera);
    std::optional<HoleRequest> takeHoles();
    std::optional<HoleRequest> takeEdges();

    LensProjection lens_;
    WarpOptions options_;
    std::unique_ptr<WarpStep> step_;
    std::optional<TracedPicture> traced_;
    std::uint64_t scene_ = 0;
    bool asked_ = false;  // whether a request was not answered yet
    HoleRequest lastRequest_;
    RigidTransform listPose_;                 // pose of the frame whose holes are being read back
    std::optional<RigidTransform> warpedTo_;  // pose of the displayed frame; empty: not warped
    int restFrames_ = 0;                      // frames since warpedTo_ was set
    WarpCounters counters_;
    LayerPicture nothing_;
};

}  // namespace mfar
