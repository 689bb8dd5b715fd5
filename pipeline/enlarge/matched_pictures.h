#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/enlarge/still_tone.h"
#include "pipeline/plan/rgb_planes.h"

#include <cmath>
#include <cstdint>

namespace mfar {

/// A copy of a video frame and of the still that was matched with it, for learning. take()
/// allocates memory only if sizes change.
struct MatchedPictures {
    static constexpr int kMargin = 64;  ///< extra columns of `luma` on each side of the picture

    Size video;
    AlignedRows<std::int16_t> luma;  ///< video luma with replicated border [1/8 grey level]
    AlignedRows<std::uint8_t> still;
    AlignedRows<LookUpCell> lookUps;      ///< one entry per cell of 4x4 video pixels
    double scaleX = 1, scaleY = 1;        ///< look-up units (see LookedUp) per video px
    double stillPerX = 1, stillPerY = 1;  ///< px of `still` per look-up unit
    StillTone tone;                       ///< the tone curve that was applied to `still`

    /// The picture in whose pixels look-ups are measured: the still, or a reduced still.
    struct LookedUp {
        Size size;
        double scaleX, scaleY;
        StillTone tone{};
    };
    void take(const RgbPlanes& video, Rows<const std::uint8_t> still,
              Rows<const LookUpCell> lookUps, const LookedUp& lookedUp);
    /// Applies a tone curve to `still`. May be called only if no tone curve was applied before.
    void apply(const StillTone& curve);
    /// Returns row y of `luma`, beginning at the picture's first pixel. For y outside the picture,
    /// returns the nearest row of the picture.
    [[nodiscard]] const std::int16_t* row(int y) const;
};

/// True if a cell is matched well enough to learn filters, guidance and FineMatch from it.
[[nodiscard]] inline bool mayTeach(const LookUpCell& cell) {
    constexpr float kLeastWeight = 0.25F, kLeastConfidence = 0.8F;
    return std::isfinite(cell.x) && std::isfinite(cell.y) && cell.weight >= kLeastWeight &&
           cell.confidence() >= kLeastConfidence;
}

}  // namespace mfar
