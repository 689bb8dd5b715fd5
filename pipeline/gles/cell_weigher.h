#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/tile_buffer.h"

#include <vector>

namespace mfar {

/// Flow and luma on the GPU, the inputs of weighing.
struct WeighInput {
    const std::vector<LumaLevel>&video, &still;
    const gpu::Buffer& words;
    const gpu::Buffer& patches;
    int first;               ///< entry of the forward field in `patches`; backward follows
    Size forward, backward;  ///< [cells]
    int backwardLevel;       ///< level of the pyramid
    bool errorsGiven;        ///< two-way errors take the place of the backward field
};

/// Computes, cell by cell, the weight of the still from its match, and the sensors' photometric
/// gain.
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
