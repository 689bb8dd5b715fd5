#pragma once

#include "base/geometry.h"
#include "base/gl/buffer.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/flow.h"
#include "pipeline/gles/flow_chooser.h"
#include "pipeline/gles/tile_buffer.h"

namespace mfar {

/// Corrects the flow: at depth edges by FlowChooser, then everywhere by a fraction of a pixel, see
/// params::kSubpixelReach.
class SubpixelCorrector {
public:
    /// The still camera of `stillRig` must have the resolution of the still that is compared.
    explicit SubpixelCorrector(const StereoRig& stillRig);

    /// Changes the flow in `cells` where tiles are matched. `still` contains the still's luma, its
    /// finest detail amplified. It must have a linear filter. `light`: Guidance::light.
    void run(const gpu::Buffer& cells, const FlowChooser::Fields& fields, const gpu::Texture& video,
             const gpu::Texture& still, float light, const TileBuffer& tiles);

private:
    StereoRig rig_;
    Size cells_;
    FlowChooser chooser_;
    gpu::Buffer sums_;
    gpu::ComputePass<params::SumSubpixel> sum_;
    gpu::ComputePass<params::CorrectSubpixel> correct_;
};

}  // namespace mfar
