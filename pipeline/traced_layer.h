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
    /// Size of the layer; 0x0: half the output size, rounded up.
    Size size;
    TracedRendererOptions renderer{};
    WarpOptions warp{};
    bool operator==(const TracedLayerOptions&) const = default;
};

/// Counters of the path tracer and the warp, for the status and the summary.
struct TracedLayerCounters {
    RenderCounters render{};
    std::uint64_t warped = 0;     ///< frames drawn by warping
    std::uint64_t unmoved = 0;    ///< frames that showed a traced picture unchanged
    std::uint64_t requested = 0;  ///< pixels that were requested to be traced individually
    std::uint64_t answered = 0;   ///< requested pixels that were traced
    int openHoles = 0;            ///< pixels that no picture shows, in the last known frame
};

/// The path-traced virtual layer. Threads of low priority render traced pictures over many
/// frames, and these pictures are warped to each frame's pose. Pixels that the pictures do not show
/// are traced individually. No function waits for the threads.
class TracedLayer {
public:
    /// Whether this build has a path tracer. Builds for 32-bit ARM have no path tracer.
    [[nodiscard]] static bool isAvailable();

    /// `video` is the camera at any resolution. `warps` must outlive this object. Throws
    /// std::invalid_argument if an option is out of range, std::runtime_error if the build has no
    /// path tracer, and GlError if the set-up of GL fails.
    TracedLayer(const CameraModel& video, Engine& warps, const TracedLayerOptions& options);
    ~TracedLayer();
    TracedLayer(const TracedLayer&) = delete;
    TracedLayer& operator=(const TracedLayer&) = delete;

    /// Sets the scene, which must be valid. The present picture stays until there is a picture of
    /// the new scene.
    void setScene(std::shared_ptr<const Scene> scene);

    /// Begins a frame with the camera at this pose. Gives the threads a new budget of processor
    /// time, and takes finished results. Without this call the threads pause.
    void update(const RigidTransform& T_world_video, Timestamp time);
    /// Whether the next render() would differ from the last one even if the camera does not move.
    [[nodiscard]] bool isStale() const;

    /// Empty before the first picture. The result is valid until the next call of any member.
    LayerPicture& render(const RigidTransform& T_world_video);

    /// Whether the threads have finished the work that the last update() allows; for measurements.
    [[nodiscard]] bool rests() const;

    [[nodiscard]] TracedLayerCounters counters() const;
    /// The reason why a scene could not be used. It is returned once.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mfar
