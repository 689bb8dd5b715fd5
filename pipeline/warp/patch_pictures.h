#pragma once

#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/warp_reference.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Pixels rendered apart from a reference, kept as points in space: sparse pictures, each with its
/// own pose, that are looked up like the reference is. The newest replaces the oldest.
class PatchPictures {
public:
    static constexpr int kPatches = 4;

    /// `fadeFrames`: after so many frames an answer is shown in full; 0: at once.
    PatchPictures(Size layer, int fadeFrames);

    /// Whole rows from `firstRow` on, to be kept as the patch `slot` until it is replaced.
    struct StoredRows {
        int slot, firstRow, lastRow;
        std::span<const std::array<std::uint8_t, 4>> colours;  ///< RGBA8
        std::span<const LightWords> lights;  ///< of objects; empty: colours alone are known
        std::span<const WarpSurface> surfaces;
    };
    /// Of one pixel at least, all of them in the layer. Gives `store` all rows that change: a slot
    /// is empty at first.
    void add(const HoleAnswer& answer, const std::function<void(const StoredRows&)>& store);
    void clear();
    /// One more frame is shown.
    void age();

    /// From the newest to the oldest: the pose and its share in what is shown; share 0: none.
    struct Patch {
        int slot = 0;  ///< where its pixels are stored
        RigidTransform T_world_camera;
        PixelRect bounds;  ///< around its pixels, also where its share is 0
        double share = 0;
    };
    [[nodiscard]] const std::array<Patch, kPatches>& patches() const { return patches_; }

private:
    [[nodiscard]] StoredRows rowsOf(int slot, int firstRow, int lastRow) const;

    Size layer_;
    int fadeFrames_;
    std::array<Patch, kPatches> patches_;  // newest first
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<LightWords> lights_;     // empty before the first that is known
    std::vector<WarpSurface> surfaces_;  // all unknown between two calls
};

}  // namespace mfar
