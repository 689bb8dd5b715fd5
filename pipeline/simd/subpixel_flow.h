#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/simd/compared_cells.h"
#include "pipeline/simd/flow_choice.h"
#include "pipeline/simd/scratch_slots.h"
#include "pipeline/simd/subpixel_rows.h"

#include <array>
#include <cstdint>
#include <memory>

namespace mfar::simd {

/// Corrects the flow: at depth edges by FlowChoice, then everywhere by a fraction of a pixel, see
/// params::kSubpixelReach. CPU version of flow_subpixel_sums.comp and flow_subpixel.comp. Allocates
/// memory only in the constructor.
class SubpixelFlow {
public:
    /// The still camera of `stillRig` has the resolution of the still that is compared.
    SubpixelFlow(const StereoRig& stillRig, std::shared_ptr<Workers> workers);

    /// Changes the flow of the cells in matched tiles. `flow` and `errors`: see
    /// ComparedCells::take(). `light`: Guidance::light.
    void run(const RgbPlanes& video, const StillPairs& still, float light, const TileWork& work,
             FlowCell* flow, const ErrorCell* errors);

private:
    using Frame = FlowChoice::Frame;
    void makeSlopes(int row);
    void sum(const Frame& frame, AlignedRows<std::int16_t>& luma, int row);
    void correct(const Frame& frame, int row);

    LookUpParams lookUp_;
    Size cells_;
    std::shared_ptr<Workers> workers_;
    ComparedCells given_;
    FlowChoice choice_;
    CellPlane none_;  // one row of zeros (never written), instead of rows outside the picture
    std::array<CellPlane, 2> alongX_, alongY_, corrected_;
    std::array<CellPlane, kSubpixelSums> sums_;
    ScratchSlots<AlignedRows<std::int16_t>> luma_;
};

}  // namespace mfar::simd
