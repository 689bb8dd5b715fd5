#pragma once

#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/warp_reference.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Individually rendered pixels, stored with their depths as sparse pictures (patches). Each patch
/// has its own pose, and colours are looked up in it like in the reference picture. The newest
/// patch replaces the oldest.
class PatchPictures {
public:
    static constexpr int kPatches = 4;

    /// `fadeFrames`: number of frames until a patch is fully visible; 0: it is fully visible at
    /// once.
    PatchPictures(Size layer, int fadeFrames);

    /// Whole rows [firstRow, lastRow) of the patch in `slot`. `store` must keep them until other
    /// rows replace them.
    struct StoredRows {
        int slot, firstRow, lastRow;
        std::span<const std::array<std::uint8_t, 4>> colours;  ///< RGBA8
        std::span<const LightWords> lights;  ///< light on objects; empty if only colours are known
        std::span<const WarpSurface> surfaces;
    };
    /// Adds an answer as the newest patch. The answer must have at least one pixel, and all pixels
    /// must be in the layer. Passes all rows that change to `store`; a slot that was never stored
    /// counts as empty.
    void add(const HoleAnswer& answer, const std::function<void(const StoredRows&)>& store);
    void clear();
    /// Must be called once per displayed frame; advances the fading.
    void age();

    /// Pose and share of a patch in the displayed colour. If the share is 0, there is no patch.
    struct Patch {
        int slot = 0;  ///< slot that stores the patch's pixels
        RigidTransform T_world_camera;
        PixelRect bounds;  ///< bounds of the patch's pixels; valid even if the share is 0
        double share = 0;
    };
    [[nodiscard]] const std::array<Patch, kPatches>& patches() const { return patches_; }

private:
    [[nodiscard]] StoredRows rowsOf(int slot, int firstRow, int lastRow) const;

    Size layer_;
    int fadeFrames_;
    std::array<Patch, kPatches> patches_;  // newest first
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<LightWords> lights_;     // empty until an answer with light
    std::vector<WarpSurface> surfaces_;  // all unknown between two calls of add()
};

}  // namespace mfar
