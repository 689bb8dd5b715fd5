#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/simd/compared_cells.h"
#include "pipeline/simd/flow_choice_rows.h"
#include "pipeline/simd/scratch_slots.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar::simd {

/// Cells at depth edges choose among the flow of their neighbours, see params::kOtherSurface. CPU
/// version of flow_choose.comp. Allocates memory only in the constructor.
class FlowChoice {
public:
    /// The still camera of `stillRig` has the resolution of the still that is compared. `cells`
    /// must outlive this object.
    FlowChoice(const StereoRig& stillRig, std::shared_ptr<Workers> workers, ComparedCells& cells);

    struct Frame {
        const RgbPlanes& video;
        const StillPairs& still;
        float light;  ///< Guidance::light
        const TileWork& work;
        FlowCell* flow;  ///< of all cells
    };
    /// Changes the flow of compared cells in `frame.flow`. `cells` must contain the same flow, and
    /// is not changed.
    void run(const Frame& frame);

private:
    /// A cell beside a step of the flow. `neighbours`: see findFlowSteps(). `own`: index of its
    /// pair in Scratch::own.
    struct Chooser {
        int row, column, own;
        std::int32_t neighbours;
    };
    /// Pairs of a cell and a flow vector, see FlowPairs, and their errors.
    struct Pairs {
        explicit Pairs(int most);
        void add(int ofRow, int ofColumn, float x, float y);
        [[nodiscard]] const float* compare(const LookUpParams& lookUp, const StillPairs& still,
                                           float light);
        int count = 0;
        AlignedRows<float> row, column, flowX, flowY, error;
        AlignedRows<std::int16_t> video;
    };
    /// Memory for some rows of cells.
    struct Scratch {
        explicit Scratch(const ComparedCells& cells);
        AlignedRows<std::int16_t> luma;
        AlignedRows<std::int32_t> neighbours;
        std::vector<Chooser> choosers;
        Pairs own, others;
    };
    void choose(const Frame& frame, Scratch& scratch, int first, int last);
    void listOwn(const Frame& frame, Scratch& scratch, int row);
    void listOthers(Scratch& scratch);
    void takeBest(const Frame& frame, Scratch& scratch) const;

    LookUpParams lookUp_;
    std::shared_ptr<Workers> workers_;
    ComparedCells& cells_;
    CellPlane none_;  // one row of zeros (never written), instead of rows outside the picture
    ScratchSlots<Scratch> scratch_;
};

}  // namespace mfar::simd
