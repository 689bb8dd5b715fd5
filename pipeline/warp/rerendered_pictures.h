#pragma once

#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/traced_picture.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Pixels that were traced one by one for a camera pose, with their depths. Each re-rendered
/// picture has only the pixels of one HoleAnswer, and its own pose. Colours are looked up in it
/// like in the traced picture. The newest re-rendered picture replaces the oldest.
class RerenderedPictures {
public:
    static constexpr int kPictures = 4;

    /// `fadeFrames`: number of frames until a picture is fully visible; 0: it is fully visible at
    /// once.
    RerenderedPictures(Size layer, int fadeFrames);

    /// Whole rows [firstRow, lastRow) of the picture in `slot`. `store` must keep them until other
    /// rows replace them.
    struct StoredRows {
        int slot, firstRow, lastRow;
        std::span<const std::array<std::uint8_t, 4>> colours;  ///< RGBA8
        std::span<const LightWords> lights;  ///< light on objects; empty if only colours are known
        std::span<const WarpSurface> surfaces;
    };
    /// Adds an answer as the newest picture. The answer must have at least one pixel, and all
    /// pixels must be in the layer. Passes all rows that change to `store`; a slot that was never
    /// stored counts as empty.
    void add(const HoleAnswer& answer, const std::function<void(const StoredRows&)>& store);
    void clear();
    /// Must be called once per displayed frame; advances the fading.
    void age();

    /// Pose of a picture, and its share in the displayed colour. If the share is 0, the slot has no
    /// picture.
    struct Picture {
        int slot = 0;  ///< slot that stores the pixels
        RigidTransform T_world_camera;
        PixelRect bounds;  ///< bounds of the pixels; valid even if the share is 0
        double share = 0;
    };
    [[nodiscard]] const std::array<Picture, kPictures>& pictures() const { return pictures_; }

private:
    [[nodiscard]] StoredRows rowsOf(int slot, int firstRow, int lastRow) const;

    Size layer_;
    int fadeFrames_;
    std::array<Picture, kPictures> pictures_;  // newest first
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<LightWords> lights_;     // empty until an answer with light
    std::vector<WarpSurface> surfaces_;  // all unknown between two calls of add()
};

}  // namespace mfar
