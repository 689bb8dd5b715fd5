#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/warp/warp_options.h"
#include "pipeline/warp/warp_step.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Totals since the start, and the most recent counts.
struct WarpCounters {
    std::uint64_t warped = 0;     ///< frames
    std::uint64_t unmoved = 0;    ///< frames that show the reference unchanged
    std::uint64_t empty = 0;      ///< frames with nothing in view
    std::uint64_t requested = 0;  ///< pixels requested for individual rendering
    std::uint64_t answered = 0;   ///< pixels that came back
    std::uint64_t rays = 0;       ///< samples of the requested pixels
    int openHoles = 0;            ///< pixels that no picture shows, in the frame last read
    int cracks = 0;               ///< in the same frame
};

/// Image-based rendering of the virtual layer: shows a finished picture as the camera sees it from
/// its current pose, in two passes (paper, eq. 5; depth, then inverse look-up of colour). The
/// result is clipped to the silhouette of the models at the current pose. An engine's step
/// processes the pixels; this class decides what is shown and which pixels are rendered
/// individually.
class Warp {
public:
    /// `video`: any resolution of the camera; the layer has size `output`. `engine` must outlive
    /// this. Throws std::invalid_argument for an option out of range, and GlError for a GL that
    /// does not draw into R32F.
    Warp(const CameraModel& video, Size output, Engine& engine, const WarpOptions& options = {});
    Warp(const Warp&) = delete;
    Warp& operator=(const Warp&) = delete;

    /// Sets the models. Drops the reference and all rendered holes, which belong to another scene.
    void setScene(const Scene& scene);
    /// Takes effect with the next run(); replaces the previous reference and the holes rendered for
    /// it.
    void setReference(WarpReference reference);
    void dropReference();

    /// As of WarpStep.
    [[nodiscard]] bool takesLight() const { return step_->takesLight(); }

    /// Nothing is shown without a scene, a reference, or at a pose that is not finite. Valid until
    /// the next call of any member.
    LayerPicture& run(const RigidTransform& T_world_camera);

    /// Call once per frame, including frames that are not drawn because the camera rests.
    /// Returns the pixels to render individually: the holes of a recent frame, or edges once the
    /// camera rests. At most mostRequested pixels, evenly spread if there are more. Empty if none
    /// are known. After a request, returns nothing until that request is answered or a new
    /// reference is set. Never waits.
    [[nodiscard]] std::optional<HoleRequest> takeRequest();
    /// Takes effect with the next run(). Answers for another scene are ignored. Throws
    /// std::invalid_argument for fields of unequal length or a pixel outside the layer.
    void answer(const HoleAnswer& answer);

    [[nodiscard]] const WarpCounters& counters() const { return counters_; }
    /// The layer's camera at the layer's resolution.
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
    std::optional<WarpReference> reference_;
    std::uint64_t scene_ = 0;
    bool asked_ = false;  // a request is not answered yet
    HoleRequest lastRequest_;
    RigidTransform listPose_;                 // of the frame whose holes are in transfer
    std::optional<RigidTransform> warpedTo_;  // of the displayed frame; empty: not warped
    int restFrames_ = 0;                      // since warpedTo_ was set
    WarpCounters counters_;
    LayerPicture nothing_;
};

}  // namespace mfar
