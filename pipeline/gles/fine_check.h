#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/gles/tile_buffer.h"

namespace mfar {

/// Lowers the weights of cells where the still does not show the video's finest detail.
class FineCheck {
public:
    /// `stillRig`: the rig with the still camera at the resolution of its detail.
    explicit FineCheck(const StereoRig& stillRig);

    /// Fields of CellWeigher.
    struct Weights {
        const gpu::Texture &weighed, &lookUps, &trust;
    };
    /// `still`: raised luma, linear filter.
    void run(const gpu::Texture& video, const gpu::Texture& still, const Weights& weights,
             const TileBuffer& tiles, const FineMatch& match);

    [[nodiscard]] Weights weights() const { return {weighed_, lookUps_, trust_}; }

private:
    StereoRig rig_;
    Size cells_;
    gpu::Texture sums_, weighed_, lookUps_, trust_;
    gpu::ComputePass<params::SumFine> sum_;
    gpu::ComputePass<params::ConfirmCells> confirm_;
};

}  // namespace mfar
