#pragma once

#include "base/geometry.h"
#include "base/gl/buffer.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/flow.h"
#include "pipeline/gles/tile_buffer.h"

namespace mfar {

/// Cells at depth edges choose among the flow of their neighbours, see params::kOtherSurface.
class FlowChooser {
public:
    /// The still camera of `stillRig` must have the resolution of the still that is compared.
    explicit FlowChooser(const StereoRig& stillRig);

    /// Indices in a buffer of cells. `flow`: the first cell of the flow. `errors`: the first
    /// ErrorCell; -1: there are no ErrorCells.
    struct Fields {
        int flow, errors;
    };
    /// Returns four floats per cell: the chosen flow, 1 if the cell is compared with the still
    /// (otherwise 0), and 0. `still` contains the still's luma, its finest detail amplified. It is
    /// sampled linearly. `light`: Guidance::light. The buffer stays valid as long as this object.
    const gpu::Buffer& run(const gpu::Buffer& cells, const Fields& fields,
                           const gpu::Texture& video, const gpu::Texture& still, float light,
                           const TileBuffer& tiles);

private:
    StereoRig rig_;
    Size cells_;
    gpu::Buffer chosen_;
    gpu::ComputePass<params::ChooseFlow> choose_;
};

}  // namespace mfar
