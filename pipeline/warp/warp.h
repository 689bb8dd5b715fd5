#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/warp/warp_options.h"
#include "pipeline/warp/warp_step.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Totals since the start, and what was last known.
struct WarpCounters {
    std::uint64_t warped = 0;     ///< frames
    std::uint64_t unmoved = 0;    ///< frames that show the reference as it is
    std::uint64_t empty = 0;      ///< frames with nothing in view
    std::uint64_t requested = 0;  ///< pixels asked to be rendered for themselves
    std::uint64_t answered = 0;   ///< pixels that came back
    std::uint64_t rays = 0;       ///< samples of the pixels asked for
    int openHoles = 0;            ///< pixels known nowhere, of the frame last read
    int cracks = 0;               ///< of the same frame
};

/// Image-based rendering of the virtual layer: a finished picture as the camera would see it from
/// where it is now, in two passes (paper, eq. 5; depth, then inverse look-up of colour). Everything
/// is clipped to the silhouette of the models at the current pose. An engine's step works on the
/// pixels; this decides what is shown and what is rendered for itself.
class Warp {
public:
    /// `video`: any resolution of the camera; the layer has size `output`. `engine` must outlive
    /// this. Throws std::invalid_argument for an option out of range and GlError for a GL that does
    /// not draw into R32F.
    Warp(const CameraModel& video, Size output, Engine& engine, const WarpOptions& options = {});
    Warp(const Warp&) = delete;
    Warp& operator=(const Warp&) = delete;

    /// Takes the models. Drops the reference and all rendered holes, which were of another scene.
    void setScene(const Scene& scene);
    /// Shown from the next run on, in place of the one before and of the holes rendered for it.
    void setReference(WarpReference reference);
    void dropReference();

    /// As of WarpStep.
    [[nodiscard]] bool takesLight() const { return step_->takesLight(); }

    /// Nothing is shown without a scene, a reference, or at a pose that is not finite. Valid until
    /// the next call of any member.
    LayerPicture& run(const RigidTransform& T_world_camera);

    /// To be called once a frame, also where none is drawn as the camera rests.
    /// Pixels to be rendered for themselves: of a frame or two ago, at most mostRequested of them,
    /// spread evenly where there are more; once the camera rests, those at edges. Nothing while
    /// none are known, and none again until the one taken is answered, or a new reference comes.
    /// Never waits.
    [[nodiscard]] std::optional<HoleRequest> takeRequest();
    /// Shown from the next run on. An answer of another scene is left out. Throws
    /// std::invalid_argument for fields of unequal length or a pixel outside of the layer.
    void answer(const HoleAnswer& answer);

    [[nodiscard]] const WarpCounters& counters() const { return counters_; }
    /// Of the layer, at its resolution.
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
    bool asked_ = false;  // a request waits for its answer
    HoleRequest lastRequest_;
    RigidTransform listPose_;                 // of the frame whose holes are under way
    std::optional<RigidTransform> warpedTo_;  // what is shown; none: not warped
    int restFrames_ = 0;                      // since then
    WarpCounters counters_;
    LayerPicture nothing_;
};

}  // namespace mfar
