#pragma once

#include "pipeline/engine/steps.h"
#include "pipeline/scene/scene.h"
#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/warp_reference.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Pixels that a frame's look-up did not find in the reference.
struct WarpHoles {
    std::vector<std::uint32_t> open;  ///< row-major indices; no picture shows them; ascending
    int cracks = 0;                   ///< number of pixels, not listed
    int fading = 0;                   ///< pixels from patches not yet fully visible
};

/// The pixel processing of a warp, implemented by each engine; Warp decides when it runs. The
/// picture depends only on the inputs, whatever the number of threads.
class WarpStep {
public:
    virtual ~WarpStep() = default;

    /// Sets the models. Forgets all patches, which belong to another scene.
    virtual void setScene(const Scene& scene) = 0;
    /// Bounds of all models [layer px]; the whole layer for a model that crosses the near plane.
    [[nodiscard]] virtual PixelRect bounds(const RigidTransform& T_world_camera) const = 0;

    /// Borrowed until the next call. Must be called before run().
    virtual void setReference(const WarpReference& reference) = 0;
    /// Whether run() takes the light of objects alone from references, and looks their paint up;
    /// otherwise it takes colours.
    [[nodiscard]] virtual bool takesLight() const = 0;
    /// The reference as it was rendered.
    [[nodiscard]] virtual LayerPicture& reference() = 0;

    struct Frame {
        RigidTransform T_world_camera;
        PixelRect bounds;   ///< layer pixels, not empty
        bool lists = true;  ///< this frame's holes will be read
    };
    /// Valid until the next run().
    [[nodiscard]] virtual LayerPicture& run(const Frame& frame) = 0;

    /// The holes of the listed frame, once it is finished. Never waits.
    [[nodiscard]] virtual std::optional<WarpHoles> takeHoles() = 0;
    [[nodiscard]] virtual bool holesPending() const = 0;
    virtual void dropHoles() = 0;
    /// Adds individually rendered pixels, visible from the next run() on. Must be valid and not
    /// empty.
    virtual void addPatch(const HoleAnswer& answer) = 0;

    /// Discards the previous list and answer, then lists the pixels with the most contrast in the
    /// last run()'s picture, which the look-up has blurred.
    virtual void listEdges() = 0;
    /// Row-major pixel indices, ascending, once they are known. Never waits.
    [[nodiscard]] virtual std::optional<std::vector<std::uint32_t>> takeEdges() = 0;
    /// Replaces pixels of that list, with a share that grows with each run() of the same pose.
    virtual void answerEdges(const HoleAnswer& answer) = 0;
    virtual void dropEdges() = 0;

    /// For tests: RGBA8: number of the missing surface, its share of the pixel, 255 where no
    /// picture shows it, number of the surface that fills the pixel alone.
    [[nodiscard]] virtual const Field<std::uint32_t>& state() const = 0;
};

}  // namespace mfar
