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

/// Computes factors that reduce the weight of cells in which the still does not show the video's
/// finest detail, see params::kFineRoom. CPU version of superres_fine.comp and
/// superres_confirm.comp. Allocates memory only in the constructor.
class FineCheck {
public:
    FineCheck(const StereoRig& stillRig, std::shared_ptr<Workers> workers);

    /// Returns for each cell the factor of its weight, [0, 1]. The result is valid until the next
    /// call. Cells of unmatched tiles and incomplete cells at the border are not measured. Their
    /// factor depends only on the neighbouring cells. `surface`: see WeighStep::surface().
    Rows<const float> run(const RgbPlanes& video, const StillPairs& still,
                          Rows<const LookUpCell> lookUps, const SurfaceCells& surface,
                          const TileWork& work, const FineMatch& match);

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
    /// Number of pixels in a row of `cells` cells from the frame's left border on, plus one for the
    /// next pixel, if the frame has one.
    [[nodiscard]] int pixelsOf(int cells) const;

    Size video_, cells_;
    std::shared_ptr<Workers> workers_;
    LookUpTaps taps_;
    CellPlane ofVideo_, ofBoth_, ofStill_;
    AlignedRows<float> shares_;
    ScratchSlots<Scratch> scratch_;
};

}  // namespace mfar::simd
