#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/gles/tile_buffer.h"

namespace mfar {

/// Corrects the weights, which are too cautious because they were computed without the finest
/// detail. Raises all weights below 1. Then lowers the weights of cells in which the still does not
/// show the video's finest detail as well as usual. See params::kFineRoom.
class FineCheck {
public:
    /// The still camera of `stillRig` must have the resolution of run()'s `still`.
    explicit FineCheck(const StereoRig& stillRig);

    struct Weights {
        const gpu::Texture &weighed, &lookUps, &trust;
    };
    /// Computes weights() from `weights` and `statistics`, which are the results of CellWeigher for
    /// this frame. `still` is StillReference::raised().
    void run(const gpu::Texture& video, const gpu::Texture& still, const Weights& weights,
             const gpu::Texture& statistics, const TileBuffer& tiles, const FineMatch& match);

    [[nodiscard]] Weights weights() const { return {weighed_, lookUps_, trust_}; }

private:
    StereoRig rig_;
    Size cells_;
    gpu::Texture sums_, weighed_, lookUps_, trust_;
    gpu::ComputePass<params::SumFine> sum_;
    gpu::ComputePass<params::ConfirmCells> confirm_;
};

}  // namespace mfar
