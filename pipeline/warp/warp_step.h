#pragma once

#include "pipeline/engine/steps.h"
#include "pipeline/scene/scene.h"
#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/warp_reference.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// What a frame's look-up did not find in the reference.
struct WarpHoles {
    std::vector<std::uint32_t> open;  ///< row-major index of those known nowhere, ascending
    int cracks = 0;                   ///< counted, not listed
    int fading = 0;                   ///< known from patches, not yet shown in full
};

/// The work on pixels of a warp, whichever engine does it; Warp decides when it is done. The
/// picture depends on nothing but the inputs, on any number of threads.
class WarpStep {
public:
    virtual ~WarpStep() = default;

    /// Takes the models. Forgets all patches, which were of another scene.
    virtual void setScene(const Scene& scene) = 0;
    /// Layer pixels around all models; of one that reaches before the near plane and beyond it, all
    /// of them.
    [[nodiscard]] virtual PixelRect bounds(const RigidTransform& T_world_camera) const = 0;

    /// Borrowed until the next call. run() needs one.
    virtual void setReference(const WarpReference& reference) = 0;
    /// Whether run() takes the light of objects alone from references, and looks their paint up;
    /// otherwise it takes colours.
    [[nodiscard]] virtual bool takesLight() const = 0;
    /// The reference as it was rendered.
    [[nodiscard]] virtual LayerPicture& reference() = 0;

    struct Frame {
        RigidTransform T_world_camera;
        PixelRect bounds;   ///< layer pixels, not empty
        bool lists = true;  ///< its holes are to be known
    };
    /// Valid until the next run().
    [[nodiscard]] virtual LayerPicture& run(const Frame& frame) = 0;

    /// Of the frame whose holes were listed, once it is finished: never waits.
    [[nodiscard]] virtual std::optional<WarpHoles> takeHoles() = 0;
    [[nodiscard]] virtual bool holesPending() const = 0;
    virtual void dropHoles() = 0;
    /// Pixels rendered for themselves, shown from the next run() on. Sound and not empty.
    virtual void addPatch(const HoleAnswer& answer) = 0;

    /// Lists the pixels with the most contrast of the last run()'s picture, which the look-up has
    /// blurred; forgets the list and the answer before.
    virtual void listEdges() = 0;
    /// Row-major indices, ascending, once they are known: never waits.
    [[nodiscard]] virtual std::optional<std::vector<std::uint32_t>> takeEdges() = 0;
    /// Replaces pixels of that list, a little more with each run() of the same pose.
    virtual void answerEdges(const HoleAnswer& answer) = 0;
    virtual void dropEdges() = 0;

    /// For tests: RGBA8, number of what is missing, its share of the pixel, 255 where it is known
    /// nowhere, number of what fills the pixel alone.
    [[nodiscard]] virtual const Field<std::uint32_t>& state() const = 0;
};

}  // namespace mfar
