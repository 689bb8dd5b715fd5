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
    /// Size of the layer [px]. Pipeline::setScene() replaces 0x0 by half the output size, rounded
    /// up. VirtualView and TracedLayer need a size.
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
    std::uint64_t answered = 0;   ///< requested pixels that were traced
    /// Number of objects' pixels that no picture shows. They are not counted in every frame; this
    /// is the last count.
    int openHoles = 0;
};

/// The virtual layer, drawn by path tracing. Threads of low priority trace pictures over the time
/// of many frames. In each frame, the last finished picture is warped to the frame's pose, and
/// pixels of objects that no picture shows are traced individually. Only the destructor waits for
/// the threads; rests() may wait for a lock.
class TracedLayer {
public:
    /// False in builds without the library Embree, such as those for 32-bit ARM. They have no path
    /// tracer.
    [[nodiscard]] static bool isAvailable();

    /// `video` is the video camera at any resolution. `warps` creates the warp step and must
    /// outlive this object. Throws std::invalid_argument if an option is out of range,
    /// std::runtime_error if the build has no path tracer, and GlError if the set-up of GL fails.
    TracedLayer(const CameraModel& video, Engine& warps, const TracedLayerOptions& options);
    ~TracedLayer();
    TracedLayer(const TracedLayer&) = delete;
    TracedLayer& operator=(const TracedLayer&) = delete;

    /// Sets a valid scene. The last picture is shown until there is a picture of the new scene.
    void setScene(std::shared_ptr<const Scene> scene);

    /// Begins a frame with the camera at this pose. Takes over what the threads have finished, and
    /// allows them some more processor time. When that is spent, they pause until the next call.
    void update(const RigidTransform& T_world_video, Timestamp time);
    /// True if the next render() would give a different result even if the camera stays where it
    /// is. This is always so while a moving object is shown.
    [[nodiscard]] bool isStale() const;

    /// Draws the layer at this pose. Moving objects are drawn where they are at the time of the
    /// last update(). The layer is empty until the first traced picture is finished. The result is
    /// valid until the next call of any member function.
    LayerPicture& render(const RigidTransform& T_world_video);

    /// True if the threads have finished all work that the last update() allowed. For measurements.
    [[nodiscard]] bool rests() const;

    [[nodiscard]] TracedLayerCounters counters() const;
    /// Returns why a scene was rejected; empty if none was rejected since the last call.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mfar
