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

/// Checks for each cell whether the still shows the finest detail of the video: superres_fine.comp
/// and superres_confirm.comp on the CPU. Allocates in the constructor.
class FineCheck {
public:
    /// `stillRig`: StillPreparation::rig().
    FineCheck(const StereoRig& stillRig, std::shared_ptr<Workers> workers);

    /// Share of its weight that each cell keeps, [0, 1]; valid until the next run. Unmatched tiles
    /// and incomplete cells contribute nothing; their neighbours decide.
    Rows<const float> run(const RgbPlanes& video, const StillPairs& still,
                          Rows<const LookUpCell> lookUps, const TileWork& work,
                          const FineMatch& match);

private:
    static constexpr int kSamples = 2;  // samples of the still per video pixel in each direction
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

    Size video_, cells_, sampled_;  // sampled_: cells in rows that are sampled
    std::shared_ptr<Workers> workers_;
    LookUpTaps taps_;
    CellPlane ofVideo_, ofBoth_, ofStill_;  // for the sampled rows
    AlignedRows<float> shares_;
    ScratchSlots<Scratch> scratch_;
};

}  // namespace mfar::simd
