#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/scene/scene.h"
#include "pipeline/slices/reference_options.h"
#include "pipeline/warp/warp_options.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar {

struct TracedLayerOptions {
    /// Of the layer; 0x0 = half the output's, rounded up.
    Size size;
    ReferenceOptions reference{};
    WarpOptions warp{};
    bool operator==(const TracedLayerOptions&) const = default;
};

/// What path tracing and warping did, for status and summary.
struct TracedLayerCounters {
    RenderCounters render{};
    std::uint64_t warped = 0;     ///< frames
    std::uint64_t unmoved = 0;    ///< frames that showed a reference picture as it is
    std::uint64_t requested = 0;  ///< pixels asked to be traced for themselves
    std::uint64_t answered = 0;   ///< of them, that came back
    int openHoles = 0;            ///< pixels that no picture shows, in the frame last known
};

/// The virtual layer, path traced: reference pictures that take many frames are made in threads of
/// low priority and warped to every frame's pose; what they do not show is traced for itself. Never
/// waits for the others.
class TracedLayer {
public:
    /// Whether this build has a path tracer: one for 32-bit ARM has none.
    [[nodiscard]] static bool isAvailable();

    /// `video`: any resolution of the camera. `warps` must outlive this. Throws
    /// std::invalid_argument for options out of range, std::runtime_error where there is no path
    /// tracer, GlError from set-up.
    TracedLayer(const CameraModel& video, Engine& warps, const TracedLayerOptions& options);
    ~TracedLayer();
    TracedLayer(const TracedLayer&) = delete;
    TracedLayer& operator=(const TracedLayer&) = delete;

    /// Must be sound. What is shown stays until there is a picture of it.
    void setScene(std::shared_ptr<const Scene> scene);

    /// A frame begins whose camera is there: gives the threads their next milliseconds and takes
    /// what they have finished. Without it they come to rest.
    void update(const RigidTransform& T_world_video, Timestamp time);
    /// The layer differs from the last render()'s also for a camera that has not moved.
    [[nodiscard]] bool isStale() const;

    /// Empty before the first picture. Valid until the next call of any member.
    LayerPicture& render(const RigidTransform& T_world_video);

    /// Whether the threads have done what the last update() allows; for measurements.
    [[nodiscard]] bool rests() const;

    [[nodiscard]] TracedLayerCounters counters() const;
    /// What was wrong with a scene that could not be used, once.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mfar
