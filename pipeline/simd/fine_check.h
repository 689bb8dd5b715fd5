#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/cell_plane.h"
#include "pipeline/simd/fine_rows.h"
#include "pipeline/simd/look_up_rows.h"
#include "pipeline/simd/pixel_spans.h"
#include "pipeline/simd/scratch_slots.h"

#include <cstdint>
#include <memory>

namespace mfar::simd {

/// Checks for each cell whether the still shows the finest detail of the video. CPU version of
/// superres_fine.comp and superres_confirm.comp. Allocates memory only in the constructor.
class FineCheck {
public:
    FineCheck(const StereoRig& stillRig, std::shared_ptr<Workers> workers);

    /// Returns one factor for the weight of each cell, [0, 1]; valid until the next run. Cells of
    /// unmatched tiles and incomplete cells are not measured; their neighbours determine their
    /// factor.
    Rows<const float> run(const RgbPlanes& video, const StillPairs& still,
                          Rows<const LookUpCell> lookUps, const TileWork& work,
                          const FineMatch& match);

private:
    static constexpr int kSamples = 2;  // samples of the still per video pixel, along each axis
    struct Scratch {
        Scratch(const FineCheck& check);
        LookUpRowCache lookUps;
        AlignedRows<std::int16_t> video, still;
        PixelSpans cells;
    };
    struct Frame {
        const RgbPlanes& video;
        const StillPairs& still;
        Rows<const LookUpCell> lookUps;
        const TileWork& work;
    };

    void sumTiles(const Frame& frame, Scratch& scratch, int tileRow);
    void sum(const Frame& frame, Scratch& scratch, int row);
    [[nodiscard]] FineSumsNear::Pair near(CellPlane& sums, int row) const;

    Size video_, cells_, sampled_;  // sampled_: like cells_, but only every kFineStep-th row
    std::shared_ptr<Workers> workers_;
    LookUpTaps taps_;
    CellPlane ofVideo_, ofBoth_, ofStill_;
    AlignedRows<float> shares_;
    ScratchSlots<Scratch> scratch_;
};

}  // namespace mfar::simd
