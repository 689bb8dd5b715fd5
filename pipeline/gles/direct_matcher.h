#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/flow.h"
#include "pipeline/gles/tile_buffer.h"

namespace mfar {

/// Compares doubtful cells with the still at its own resolution instead of the video's, see
/// params::kPatchSamples.
class DirectMatcher {
public:
    /// The still camera of `stillRig` must have the resolution of the still that is compared.
    explicit DirectMatcher(const StereoRig& stillRig);

    /// Indices of the first cell of each field in a buffer of cells: filtered flow, flow along
    /// epipolar lines, ErrorCells.
    struct Fields {
        int flow, lines, errors;
    };
    /// Changes the flow and the ErrorCells in `cells`. `still` is a luma texture that is sampled
    /// linearly; its finest detail is amplified, see StillReference::raised().
    void run(const gpu::Buffer& cells, const Fields& fields, const gpu::Texture& video,
             const gpu::Texture& still, const TileBuffer& tiles);

private:
    StereoRig rig_;
    Size cells_;
    gpu::ComputePass<params::CompareDirectly> compare_;
};

}  // namespace mfar
