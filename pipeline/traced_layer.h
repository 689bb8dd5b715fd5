#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/scene/scene.h"
#include "pipeline/slices/traced_renderer_options.h"
#include "pipeline/warp/warp_options.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

struct TracedLayerOptions {
    /// Size of the layer [px]; 0x0 means half the output size, rounded up.
    Size size;
    TracedRendererOptions renderer{};
    WarpOptions warp{};
    bool operator==(const TracedLayerOptions&) const = default;
};

/// Counters of the path tracer and the warp, for the status and the summary.
struct TracedLayerCounters {
    RenderCounters render{};
    std::uint64_t warped = 0;
    std::uint64_t unmoved = 0;    ///< frames that showed a traced picture without warping it
    std::uint64_t requested = 0;  ///< pixels requested to be traced individually
    std::uint64_t answered = 0;
    /// Number of the layer's pixels that no picture shows, in the last frame in which they were
    /// counted.
    int openHoles = 0;
};

/// The path-traced virtual layer. Threads of low priority render traced pictures over many frames,
/// and these are warped to each frame's pose. Pixels that no picture shows are traced individually.
/// No function waits for the threads.
class TracedLayer {
public:
    /// False in builds for 32-bit ARM, which have no path tracer.
    [[nodiscard]] static bool isAvailable();

    /// `video` is the video camera at any resolution. `warps` creates the warp step and must
    /// outlive this object. Throws std::invalid_argument if an option is out of range,
    /// std::runtime_error if the build has no path tracer, and GlError if the set-up of GL fails.
    TracedLayer(const CameraModel& video, Engine& warps, const TracedLayerOptions& options);
    ~TracedLayer();
    TracedLayer(const TracedLayer&) = delete;
    TracedLayer& operator=(const TracedLayer&) = delete;

    /// Sets a valid scene. The present picture stays until there is a picture of the new scene.
    void setScene(std::shared_ptr<const Scene> scene);

    /// Begins a frame with the camera at this pose. Uses the finished results of the threads and
    /// allows them some more processor time. Without further calls, they pause.
    void update(const RigidTransform& T_world_video, Timestamp time);
    /// True if the next render() would give a different result even if the camera does not move.
    /// Always true while a moving object is shown.
    [[nodiscard]] bool isStale() const;

    /// Draws the layer at this pose, with moving objects at the time of the last update(). The
    /// layer is empty before the first traced picture is finished. The result is valid until the
    /// next call of any member function.
    LayerPicture& render(const RigidTransform& T_world_video);

    /// True if the threads have done all work that the last update() allowed; for measurements.
    [[nodiscard]] bool rests() const;

    [[nodiscard]] TracedLayerCounters counters() const;
    [[nodiscard]] std::optional<std::string> takeError();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mfar
