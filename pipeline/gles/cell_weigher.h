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
    bool errorsGiven;  ///< true: `cells` has two-way errors (ErrorCell) instead of a backward field
};

/// Computes the weight of the still's detail in each cell. The weight depends on how well the still
/// matches there, and on the photometric gain between the sensors. The gain is measured as well.
class CellWeigher {
public:
    explicit CellWeigher(const StereoRig& rig);

    /// Computes weighed(), lookUps(), trust() and statistics(). Does nothing if no tile has
    /// changed.
    void run(const WeighInput& in, const TileBuffer& tiles);

    /// Textures with one texel per cell: a WeighedCell (Rgba32F), a LookUpCell (Rgba16F, linear
    /// filter) and a TrustCell (Rgba8, linear filter).
    [[nodiscard]] const gpu::Texture& weighed() const { return weighed_; }
    [[nodiscard]] const gpu::Texture& lookUps() const { return lookUps_; }
    [[nodiscard]] const gpu::Texture& trust() const { return trust_; }
    /// Texture with one texel per cell (Rgba32F): covariance of the patches of video and still,
    /// variance of the video's patch, variance of the still's patch, confidence. The first three
    /// are sums over params::kPatchPixels pixels.
    [[nodiscard]] const gpu::Texture& statistics() const { return statistics_; }

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
