#pragma once

#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/traced_picture.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// The last kPictures re-rendered pictures. Each consists of the pixels of one HoleAnswer, which
/// were traced for the camera pose in the answer. The warp looks up colours of objects in
/// re-rendered pictures as in the traced picture. A new picture replaces the oldest.
class RerenderedPictures {
public:
    static constexpr int kPictures = 4;

    /// A new picture fades in over `fadeFrames` frames; 0: it is fully visible at once.
    RerenderedPictures(Size layer, int fadeFrames);

    /// Rows [firstRow, lastRow) of the picture with storage index `slot`. The receiver must keep a
    /// copy until other rows replace them.
    struct StoredRows {
        int slot, firstRow, lastRow;
        std::span<const std::array<std::uint8_t, 4>> colours;
        std::span<const LightWords> lights;  ///< light on objects; empty if only colours are known
        std::span<const WarpSurface> surfaces;
    };
    /// Adds an answer as the newest picture, unless no pixel shows an object. All pixels must be in
    /// the layer. Passes all changed rows to `store`. Storage that was never written counts as
    /// empty.
    void add(const HoleAnswer& answer, const std::function<void(const StoredRows&)>& store);
    void clear();
    /// Increases the weight of each picture that still fades in. Must be called once per displayed
    /// frame.
    void age();

    /// A stored picture: its camera pose, and its weight `share` in the displayed colour [0, 1]. If
    /// `share` is 0, there is no picture.
    struct Picture {
        int slot = 0;
        RigidTransform T_world_camera;
        PixelRect bounds;  ///< bounds of the stored pixels, also if `share` is 0
        double share = 0;
        std::vector<RigidTransform> poses{};  ///< T_world_object; empty if no object moves
    };
    [[nodiscard]] const std::array<Picture, kPictures>& pictures() const { return pictures_; }

private:
    [[nodiscard]] StoredRows rowsOf(int slot, int firstRow, int lastRow) const;

    Size layer_;
    int fadeFrames_;
    std::array<Picture, kPictures> pictures_;
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<LightWords> lights_;  // empty until add() gets an answer with light
    std::vector<WarpSurface> surfaces_;
};

}  // namespace mfar
