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
    /// Size of the layer; 0x0 = half the output's, rounded up.
    Size size;
    ReferenceOptions reference{};
    WarpOptions warp{};
    bool operator==(const TracedLayerOptions&) const = default;
};

/// Counters of path tracing and warping, for status and summary.
struct TracedLayerCounters {
    RenderCounters render{};
    std::uint64_t warped = 0;     ///< frames drawn by warping
    std::uint64_t unmoved = 0;    ///< frames that showed a reference picture unchanged
    std::uint64_t requested = 0;  ///< pixels requested to be traced singly
    std::uint64_t answered = 0;   ///< requested pixels that were traced
    int openHoles = 0;            ///< pixels that no picture shows, in the last known frame
};

/// The virtual layer, path traced: threads of low priority render reference pictures over many
/// frames, which are warped to each frame's pose; pixels that they do not show are traced singly.
/// Never waits for these threads.
class TracedLayer {
public:
    /// True if this build has a path tracer; builds for 32-bit ARM have none.
    [[nodiscard]] static bool isAvailable();

    /// `video`: any resolution of the camera. `warps` must outlive this. Throws
    /// std::invalid_argument for options out of range, std::runtime_error without a path tracer,
    /// GlError from set-up.
    TracedLayer(const CameraModel& video, Engine& warps, const TracedLayerOptions& options);
    ~TracedLayer();
    TracedLayer(const TracedLayer&) = delete;
    TracedLayer& operator=(const TracedLayer&) = delete;

    /// The scene must be valid. The shown picture stays until there is a picture of the new scene.
    void setScene(std::shared_ptr<const Scene> scene);

    /// Begins a frame with the camera at this pose: gives the threads their next milliseconds and
    /// takes finished results. Without this call the threads pause.
    void update(const RigidTransform& T_world_video, Timestamp time);
    /// True if the layer differs from the last render()'s even for a camera that has not moved.
    [[nodiscard]] bool isStale() const;

    /// Empty before the first picture. Valid until the next call of any member.
    LayerPicture& render(const RigidTransform& T_world_video);

    /// True if the threads have done what the last update() allows; for measurements.
    [[nodiscard]] bool rests() const;

    [[nodiscard]] TracedLayerCounters counters() const;
    /// Why a scene could not be used; returned once.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mfar
