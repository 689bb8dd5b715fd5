#pragma once

#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/warp_reference.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Individually rendered pixels, kept as points in space: sparse pictures, each with its own pose,
/// used for look-ups like the reference. The newest replaces the oldest.
class PatchPictures {
public:
    static constexpr int kPatches = 4;

    /// `fadeFrames`: number of frames until an answer is fully visible; 0: at once.
    PatchPictures(Size layer, int fadeFrames);

    /// Whole rows from `firstRow` on, to be stored as the patch `slot` until it is replaced.
    struct StoredRows {
        int slot, firstRow, lastRow;
        std::span<const std::array<std::uint8_t, 4>> colours;  ///< RGBA8
        std::span<const LightWords> lights;  ///< of objects; empty: colours alone are known
        std::span<const WarpSurface> surfaces;
    };
    /// Adds an answer of at least one pixel, all within the layer. Passes all rows that change to
    /// `store`: initially, a slot is empty.
    void add(const HoleAnswer& answer, const std::function<void(const StoredRows&)>& store);
    void clear();
    /// Call once per displayed frame.
    void age();

    /// A patch's pose and its share in the displayed colour; share 0: there is no patch.
    struct Patch {
        int slot = 0;  ///< where its pixels are stored
        RigidTransform T_world_camera;
        PixelRect bounds;  ///< bounds of its pixels; valid even if its share is 0
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
