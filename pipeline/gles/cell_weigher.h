#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/tile_buffer.h"

#include <vector>

namespace mfar {

struct WeighInput {
    const std::vector<LumaLevel>&video, &still;
    const gpu::Buffer& words;
    const gpu::Buffer& cells;
    /// Index in `cells` of the forward field's first cell. The backward field follows the forward
    /// field.
    int first;
    Size forward, backward;
    int backwardLevel;
    bool errorsGiven;  ///< true if two-way errors replace the backward field
};

/// Computes the weight of the still in each cell from the cell's match and from the photometric
/// gain between the sensors, which it measures.
class CellWeigher {
public:
    explicit CellWeigher(const StereoRig& rig);

    /// Does nothing if no tile has changed.
    void run(const WeighInput& in, const TileBuffer& tiles);

    /// WeighedCell of each cell (Rgba32F), LookUpCell of each cell (Rgba16F, linear filter) and
    /// TrustCell of each cell (Rgba8, linear filter).
    [[nodiscard]] const gpu::Texture& weighed() const { return weighed_; }
    [[nodiscard]] const gpu::Texture& lookUps() const { return lookUps_; }
    [[nodiscard]] const gpu::Texture& trust() const { return trust_; }

private:
    void assess(const WeighInput& in, const TileBuffer& tiles);
    void measureGain(const WeighInput& in, const TileBuffer& tiles);
    void weigh(double noise);

    StereoRig rig_;
    Size cells_, halfCells_;
    gpu::Texture displacement_, statistics_, halfStatistics_, weighed_, lookUps_, trust_;
    gpu::ComputePass<params::AssessCells> assess_;
    gpu::ComputePass<params::MeasureGain> gain_;
    gpu::ComputePass<params::WeighCells> weigh_;
};

}  // namespace mfar
