#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"

#include <cmath>
#include <cstdint>

namespace mfar {

/// A video frame and the still that was matched to it, copied to learn from. take() allocates for
/// other sizes only.
struct MatchedPictures {
    static constexpr int kMargin = 64;  ///< columns of `luma` on both sides of the picture

    Size video;
    AlignedRows<std::int16_t> luma;       ///< of the video [1/8 grey level]; repeats its border
    AlignedRows<std::uint8_t> still;      ///< luma of the whole still
    AlignedRows<LookUpCell> lookUps;      ///< one per 4x4 pixels of the video
    double scaleX = 1, scaleY = 1;        ///< px that look-ups count in, per video px
    double stillPerX = 1, stillPerY = 1;  ///< px of `still` per px that look-ups count in

    /// What look-ups count in: the still camera with maybe fewer pixels than the still.
    struct LookedUp {
        Size size;
        double scaleX, scaleY;  ///< px per video px
    };
    void take(const RgbPlanes& video, Rows<const std::uint8_t> still,
              Rows<const LookUpCell> lookUps, const LookedUp& lookedUp);
    /// Row of `luma`, from the picture's first pixel on; rows beyond the border repeat it.
    [[nodiscard]] const std::int16_t* row(int y) const;
};

/// Is a cell matched well enough to learn from it?
[[nodiscard]] inline bool mayTeach(const LookUpCell& cell) {
    constexpr float kLeastWeight = 0.25F, kLeastConfidence = 0.8F;
    return std::isfinite(cell.x) && std::isfinite(cell.y) && cell.weight >= kLeastWeight &&
           cell.confidence >= kLeastConfidence;
}

}  // namespace mfar
