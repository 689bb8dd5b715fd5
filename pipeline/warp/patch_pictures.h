#pragma once

#include "base/gl/texture.h"
#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/warp_reference.h"

#include <array>
#include <optional>
#include <vector>

namespace mfar {

/// Pixels rendered apart from a reference, kept as points in space: sparse pictures, each with its
/// own pose, that are looked up like the reference is. The newest replaces the oldest.
class PatchPictures {
public:
    static constexpr int kPatches = 4;

    /// `fadeFrames`: after so many frames an answer is shown in full; 0: at once.
    PatchPictures(Size layer, int fadeFrames);

    /// Of one pixel at least, all of them in the layer.
    void add(const HoleAnswer& answer);
    void clear();
    /// One more frame is shown.
    void age();

    /// From the newest to the oldest: the pose and its share in what is shown; share 0: none.
    struct Patch {
        int slot = 0;  ///< its rows in the textures begin at slot * layer height
        RigidTransform T_world_camera;
        PixelRect bounds;  ///< around its pixels, also where its share is 0
        double share = 0;
    };
    [[nodiscard]] const std::array<Patch, kPatches>& patches() const { return patches_; }
    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }  ///< RGBA8
    [[nodiscard]] const gpu::Texture& surface() const {
        return surface_;
    }  ///< Rgba32F, WarpSurface

private:
    void upload(int slot, int firstRow, int lastRow);

    Size layer_;
    int fadeFrames_;
    std::array<Patch, kPatches> patches_;  // newest first
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<WarpSurface> surfaces_;  // all unknown between two calls
    gpu::Texture colour_, surface_;
};

}  // namespace mfar
