#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/cell_plane.h"
#include "pipeline/simd/scratch_slots.h"
#include "pipeline/simd/subpixel_rows.h"

#include <array>
#include <cstdint>
#include <memory>

namespace mfar::simd {

/// Corrects the flow by a fraction of a pixel, see params::kSubpixelReach. CPU version of
/// flow_subpixel_sums.comp and flow_subpixel.comp. Allocates memory only in the constructor.
class SubpixelFlow {
public:
    /// The still camera of `stillRig` has the resolution of the still that is compared.
    SubpixelFlow(const StereoRig& stillRig, std::shared_ptr<Workers> workers);

    /// Changes the flow of the cells in matched tiles. `flow` and `errors` have one entry per cell.
    /// `errors`: may be null; otherwise, cells with an error of kNotShown or more are not compared.
    /// `light`: Guidance::light.
    void run(const RgbPlanes& video, const StillPairs& still, float light, const TileWork& work,
             FlowCell* flow, const ErrorCell* errors);

private:
    struct Frame {
        const RgbPlanes& video;
        const StillPairs& still;
        float light;
        const TileWork& work;
        FlowCell* flow;
        const ErrorCell* errors;
    };
    void take(const Frame& frame, int row);
    void makeSlopes(int row);
    void sum(const Frame& frame, AlignedRows<std::int16_t>& luma, int row);
    void takeLuma(const RgbPlanes& video, int row, int first, int last,
                  AlignedRows<std::int16_t>& to) const;
    void correct(const Frame& frame, int row);

    LookUpParams lookUp_;
    Size video_, cells_;
    std::shared_ptr<Workers> workers_;
    CellPlane flowX_, flowY_, compared_;
    CellPlane none_;  // one row of zeros (never written), instead of rows outside the picture
    std::array<CellPlane, 2> alongX_, alongY_, corrected_;
    std::array<CellPlane, kSubpixelSums> sums_;
    ScratchSlots<AlignedRows<std::int16_t>> luma_;
};

}  // namespace mfar::simd
