#pragma once

#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/traced_picture.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Keeps the last kPictures re-rendered pictures. A re-rendered picture consists of the pixels of
/// one HoleAnswer: they were traced individually, for the camera pose of the answer, and have
/// depths. Colours are looked up in it as in the traced picture. A new re-rendered picture replaces
/// the oldest.
class RerenderedPictures {
public:
    static constexpr int kPictures = 4;

    /// `fadeFrames`: number of frames until a picture is fully visible; 0: it is fully visible at
    /// once.
    RerenderedPictures(Size layer, int fadeFrames);

    /// Whole rows [firstRow, lastRow) of the picture in `slot`. add() passes them to its `store`,
    /// which must copy them, and keep the copy until other rows replace them.
    struct StoredRows {
        int slot, firstRow, lastRow;
        std::span<const std::array<std::uint8_t, 4>> colours;  ///< RGBA8
        std::span<const LightWords> lights;  ///< light on objects; empty if only colours are known
        std::span<const WarpSurface> surfaces;
    };
    /// Adds an answer as the newest picture. The answer must have at least one pixel, and all
    /// pixels must be in the layer. Passes all rows that change in the picture's slot to `store`. A
    /// slot of which nothing was stored yet counts as empty.
    void add(const HoleAnswer& answer, const std::function<void(const StoredRows&)>& store);
    void clear();
    /// Must be called once per displayed frame. Increases the share of each picture that still
    /// fades in.
    void age();

    /// Pose of a picture, and its share in the displayed colour. If the share is 0, the slot has no
    /// picture.
    struct Picture {
        int slot = 0;  ///< slot that stores the pixels
        RigidTransform T_world_camera;
        PixelRect bounds;  ///< bounds of the stored pixels; valid even if the share is 0
        double share = 0;
    };
    [[nodiscard]] const std::array<Picture, kPictures>& pictures() const { return pictures_; }

private:
    [[nodiscard]] StoredRows rowsOf(int slot, int firstRow, int lastRow) const;

    Size layer_;
    int fadeFrames_;
    std::array<Picture, kPictures> pictures_;  // newest first
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<LightWords> lights_;     // empty until add() gets an answer with light
    std::vector<WarpSurface> surfaces_;  // between two calls of add(), all pixels are unknown
};

}  // namespace mfar
