#pragma once

#include "pipeline/engine/steps.h"
#include "pipeline/scene/scene.h"
#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/traced_picture.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mfar {

struct WarpHoles {
    std::vector<std::uint32_t> open;  ///< pixels of objects that no picture shows, ascending
    /// Number of missing pixels at edges and in cracks one pixel wide. They are not in `open`.
    int cracks = 0;
};

/// Processes the pixels of a warp. Each engine implements it; Warp decides when it runs. The result
/// does not depend on the number of threads.
class WarpStep {
public:
    virtual ~WarpStep() = default;

    virtual void setScene(const Scene& scene) = 0;
    /// Moves the scene's objects for later calls. `T_world_objects` has one pose for each object.
    virtual void setPoses(std::span<const RigidTransform> T_world_objects) = 0;
    /// Bounds of all models [layer px]. They are the whole layer if a model crosses the near plane.
    [[nodiscard]] virtual PixelRect bounds(const RigidTransform& T_world_camera) const = 0;

    /// Must be called before run(). `traced` must stay valid until the next setTracedPicture().
    virtual void setTracedPicture(const TracedPicture& traced) = 0;
    [[nodiscard]] virtual LayerPicture& traced() = 0;

    struct Frame {
        RigidTransform T_world_camera;
        PixelRect bounds;   ///< [layer px], not empty
        bool lists = true;  ///< true if takeHoles() will be called for this frame
    };
    /// The result is valid until the next run().
    [[nodiscard]] virtual LayerPicture& run(const Frame& frame) = 0;

    /// Returns the missing pixels of the last frame whose Frame::lists was true. Empty until that
    /// frame is finished. Never waits.
    [[nodiscard]] virtual std::optional<WarpHoles> takeHoles() = 0;
    [[nodiscard]] virtual bool holesPending() const = 0;
    virtual void dropHoles() = 0;
    /// Adds individually rendered pixels, visible from the next run() on. `answer` must be valid
    /// and not empty.
    virtual void addRerendered(const HoleAnswer& answer) = 0;

    /// Lists those edge pixels of the last run() that have the most contrast, because the warp
    /// blurs edges. Discards the previous list and its rendered colours.
    virtual void listEdges() = 0;
    /// Row-major indices of the listed pixels, ascending. Empty until the list is known. Never
    /// waits.
    [[nodiscard]] virtual std::optional<std::vector<std::uint32_t>> takeEdges() = 0;
    /// Sets the rendered colours of listed pixels. With each run() at the same pose, these colours
    /// replace more of the warped colours.
    virtual void answerEdges(const HoleAnswer& answer) = 0;
    virtual void dropEdges() = 0;

    /// State of each pixel as RGBA8, for tests. R: number of the surface whose colour is unknown.
    /// G: share of the pixel whose colour is unknown. B: 255 if an object fills the pixel, and no
    /// picture shows this point of the object; R is then the object's number. A: number of the
    /// surface that fills the pixel, if the whole colour is known.
    [[nodiscard]] virtual const Field<std::uint32_t>& state() const = 0;
};

}  // namespace mfar
