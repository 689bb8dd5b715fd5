#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/warp/warp_options.h"
#include "pipeline/warp/warp_step.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Counters. `openHoles` and `cracks` are of the last frame whose missing pixels were counted. All
/// others are totals since the start.
struct WarpCounters {
    std::uint64_t warped = 0;     ///< frames that were warped
    std::uint64_t unmoved = 0;    ///< frames that show the traced picture without a warp
    std::uint64_t empty = 0;      ///< frames for which run() returned an empty layer
    std::uint64_t requested = 0;  ///< pixels requested for individual rendering
    std::uint64_t answered = 0;   ///< requested pixels that were rendered
    std::uint64_t rays = 0;       ///< samples of the requested pixels
    int openHoles = 0;            ///< pixels of objects that no picture shows
    int cracks = 0;               ///< missing pixels at edges and in cracks one pixel wide
};

/// Image-based rendering of the virtual layer. It shows a finished picture (the traced picture)
/// from the camera's current pose. This takes two passes (eq. 5 of the paper, see docs/paper.md):
/// one for depth, and one in which each pixel looks up its colour. The result is clipped to the
/// models' silhouette at the current pose.
/// An engine's WarpStep processes the pixels. This class decides which pictures are shown and which
/// pixels are rendered individually.
class Warp {
public:
    /// `video` is the video camera at any resolution; the layer has size `output`. `engine` must
    /// outlive this object. Throws std::invalid_argument if an option is out of range. With the
    /// GLES engine, throws GlError if the GL implementation cannot draw into R32F.
    Warp(const CameraModel& video, Size output, Engine& engine, const WarpOptions& options = {});
    Warp(const Warp&) = delete;
    Warp& operator=(const Warp&) = delete;

    /// Sets the models. Discards the traced picture and all re-rendered pictures.
    void setScene(const Scene& scene);
    /// Replaces the traced picture from the next run() on. Re-rendered pictures stay valid, but a
    /// pending list of missing pixels is discarded.
    void setTracedPicture(TracedPicture traced);
    void dropTracedPicture();

    /// Returns the layer at this pose. It is empty without a scene or a traced picture, or if the
    /// pose is not finite. The result is valid until the next call of any member.
    /// If objects of the scene move, `poses` must be their present poses T_world_object, one for
    /// each object.
    LayerPicture& run(const RigidTransform& T_world_camera, std::vector<RigidTransform> poses = {});

    /// Returns the pixels to render individually: missing pixels of objects in a recent frame, or
    /// edge pixels if the camera rests and no object can move. At most mostRequested pixels are
    /// returned, evenly spread. Empty if no such pixels are known, or if an earlier request for
    /// this scene is not answered yet.
    /// Must be called once per frame, even if the frame is not drawn because the camera rests.
    /// Never waits.
    [[nodiscard]] std::optional<HoleRequest> takeRequest();
    /// Adds the rendered pixels of a request. They are shown from the next run() on. Answers for
    /// another scene are ignored, and so are edge pixels if the camera has moved since. Throws
    /// std::invalid_argument if the answer's vectors have different lengths (`light` may be empty),
    /// a pixel is outside the layer, or the pose is not finite.
    void answer(const HoleAnswer& answer);

    [[nodiscard]] const WarpCounters& counters() const { return counters_; }
    [[nodiscard]] const CameraModel& camera() const { return lens_.camera; }
    [[nodiscard]] const Field<std::uint32_t>& state() const { return step_->state(); }

private:
    [[nodiscard]] bool isUnmoved(const RigidTransform& from, const RigidTransform& to) const;
    [[nodiscard]] bool isOfRequested() const;
    void remember(const HoleRequest& request);
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
    bool asked_ = false;
    // The last requests for missing pixels, all for the same view. Keeps at most
    // RerenderedPictures::kPictures of them.
    struct {
        RigidTransform T_world_camera;
        std::vector<std::vector<std::uint32_t>> pixels;
    } requested_;
    RigidTransform listPose_;  // pose of the frame whose missing pixels are listed
    std::vector<RigidTransform> poses_, listPoses_;  // object poses: now, and with listPose_
    std::optional<RigidTransform> warpedTo_;  // pose of the displayed frame; empty: not warped
    int restFrames_ = 0;
    WarpCounters counters_;
    LayerPicture nothing_;
};

}  // namespace mfar
