#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/tile_buffer.h"

#include <vector>

namespace mfar {

/// Flow and luma on the GPU, the inputs of CellWeigher.
struct WeighInput {
    const std::vector<LumaLevel>&video, &still;
    const gpu::Buffer& words;
    const gpu::Buffer& cells;
    int first;               ///< forward field's index in `cells`; the backward field follows
    Size forward, backward;  ///< [cells]
    int backwardLevel;       ///< pyramid level of the backward field
    bool errorsGiven;        ///< the backward field is replaced by two-way errors
};

/// Computes the weight of the still in each cell from the match, and the photometric gain between
/// the sensors.
class CellWeigher {
public:
    explicit CellWeigher(const StereoRig& rig);

    /// Does nothing if no tile has changed.
    void run(const WeighInput& in, const TileBuffer& tiles);

    [[nodiscard]] const gpu::Texture& weighed() const { return weighed_; }  ///< Rgba32F
    [[nodiscard]] const gpu::Texture& lookUps() const { return lookUps_; }  ///< Rgba16F, linear
    [[nodiscard]] const gpu::Texture& trust() const { return trust_; }      ///< Rgba8, linear

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
