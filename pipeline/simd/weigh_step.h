#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/flow/luma_layout.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/cell_plane.h"
#include "pipeline/simd/still_look_up.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// Input for the weights of a frame. Borrowed for the call.
struct WeighInput {
    /// Levels in `words`, at least two each; the second level is used for the photometric gain
    /// between the sensors.
    const std::vector<LumaLevel>& videoLuma;
    const std::vector<LumaLevel>& stillLuma;
    std::span<const std::uint32_t> words;  ///< ends with kLumaSpareWords
    Rows<const FlowCell> forward;          ///< video to still, cells of 4x4 video px
    /// Still to video, in pixels of level `backwardLevel`; read only if errors.data is null.
    Rows<const FlowCell> backward;
    int backwardLevel = 0;
    Rows<const ErrorCell> errors;  ///< for the cells of `forward`, or data == nullptr
    const TileWork& work;
};

/// Trust in the still, cell by cell: superres_assess.comp, superres_gain.comp and
/// superres_weigh.comp on the CPU. Results are single precision; the GLES step rounds look-ups to
/// 16 and trust to 8 bits.
class WeighStep {
public:
    /// `stillRig`: StillReference::rig(), whose still may have fewer pixels than the sensor's. Null
    /// workers: runs in the caller's thread.
    WeighStep(const StereoRig& stillRig, std::shared_ptr<Workers> workers);

    /// Weighs every cell; does nothing if no tile changed. If no changed tile is matched, the gain
    /// of the last frame is kept. Unmatched tiles get no weight of their own. The results have one
    /// entry per cell and are valid until the next run.
    void run(const WeighInput& in);

    /// Multiplies each cell's weight by its share, one entry per cell.
    void lower(Rows<const float> shares);

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
    void measureGain(const WeighInput& in, int row);
    void weigh(int row, float noise);
    [[nodiscard]] BackwardCells backwardOf(const WeighInput& in, int row) const;
    void forRows(int rows, int grain, const std::function<void(int)>& body);

    LookUpParams params_;
    std::shared_ptr<Workers> workers_;
    Size cells_, halfCells_;
    CellPlane flowX_, flowY_, covariance_, varianceVideo_, varianceStill_;
    CellPlane confidence_, lookX_, lookY_;
    CellPlane halfFlowX_, halfFlowY_, halfCovariance_, halfVarianceStill_;
    AlignedRows<WeighedCell> weighed_;
    AlignedRows<LookUpCell> lookUps_;
    AlignedRows<TrustCell> trust_;
};

}  // namespace mfar::simd
