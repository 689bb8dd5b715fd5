#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/flow/luma_layout.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/cell_plane.h"
#include "pipeline/simd/cell_weights.h"
#include "pipeline/simd/patch_sums.h"
#include "pipeline/simd/still_look_up.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// Input of WeighStep::run() for a frame. The data must remain valid during the call.
struct WeighInput {
    /// At least two pyramid levels of each picture; their pixels are in `words`. The photometric
    /// gain between the sensors is measured at the first two levels.
    const std::vector<LumaLevel>& videoLuma;
    const std::vector<LumaLevel>& stillLuma;
    std::span<const std::uint32_t> words;  ///< must end with kLumaSpareWords unused words
    Rows<const FlowCell> forward;          ///< flow from video to still
    /// Flow from still to video, in pixels of pyramid level `backwardLevel`. Read only if
    /// errors.data is null.
    Rows<const FlowCell> backward;
    int backwardLevel = 0;
    /// Two-way errors of the cells of `forward`, or empty: then `backward` is read.
    Rows<const ErrorCell> errors;
    const TileWork& work;
};

/// Computes the weight of the still's detail in each cell. CPU version of superres_assess.comp,
/// superres_gain.comp and superres_weigh.comp. Results are in single precision, whereas the GLES
/// engine rounds look-ups to 16 bits and trust to 8 bits.
class WeighStep {
public:
    /// `stillRig`: see StillPreparation::rig(). If `workers` is null, all work runs in the caller's
    /// thread.
    WeighStep(const StereoRig& stillRig, std::shared_ptr<Workers> workers);

    /// Computes the weight of every cell. If no tile has changed, the last results stay valid. If
    /// no changed tile is matched, the photometric gain at the second pyramid level is not measured
    /// again; its last value is used. Cells of unmatched tiles are not compared; they get a weight
    /// only from neighbouring cells of matched tiles. The results have one entry per cell and are
    /// valid until the next run().
    void run(const WeighInput& in);

    /// Raises each weight w below 1 to 1 - (1 - w)^4, then multiplies the weight of each cell by
    /// the cell's entry in `shares`. See params::kFineRoom.
    void confirm(Rows<const float> shares);

    [[nodiscard]] SurfaceCells surface() const { return {shown(kink_), shown(variance_)}; }

    [[nodiscard]] Rows<const WeighedCell> weighed() const { return shown(weighed_); }
    [[nodiscard]] Rows<const LookUpCell> lookUps() const { return shown(lookUps_); }
    [[nodiscard]] Rows<const TrustCell> trust() const { return shown(trust_); }

private:
    template <class T>
    [[nodiscard]] Rows<const T> shown(const AlignedRows<T>& rows) const {
        return {rows[0], rows.pitch(), cells_};
    }
    void assessTiles(const WeighInput& in, int tileRow);
    void assess(const WeighInput& in, int row);
    /// Replaces `sums` by the sums in `cells`, for cells that were compared with the still itself.
    void takeDirect(const ErrorCell* cells, const PatchSums& sums) const;
    void measureGain(const WeighInput& in, int row);
    void weigh(int row, float noise);
    [[nodiscard]] BackwardCells backwardOf(const WeighInput& in, int row) const;

    LookUpParams params_;
    std::shared_ptr<Workers> workers_;
    Size cells_, halfCells_;
    CellPlane flowX_, flowY_, covariance_, varianceVideo_, varianceStill_;
    CellPlane confidence_, lookX_, lookY_;
    CellPlane halfFlowX_, halfFlowY_, halfCovariance_, halfVarianceStill_;
    AlignedRows<WeighedCell> weighed_;
    AlignedRows<LookUpCell> lookUps_;
    AlignedRows<TrustCell> trust_;
    AlignedRows<float> kink_, variance_;
};

}  // namespace mfar::simd
