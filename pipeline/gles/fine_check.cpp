#include "pipeline/gles/fine_check.h"

#include "pipeline/flow/cell_field.h"

namespace mfar {

FineCheck::FineCheck(const StereoRig& stillRig)
    : rig_(stillRig), cells_(cellsOf(stillRig.video.size)),
      sums_(cells_, gpu::TexelFormat::Rgba32F), weighed_(cells_, gpu::TexelFormat::Rgba32F),
      lookUps_(cells_, gpu::TexelFormat::Rgba16F, gpu::Filter::Linear),
      trust_(cells_, gpu::TexelFormat::Rgba8, gpu::Filter::Linear), sum_("superres_fine.comp"),
      confirm_("superres_confirm.comp") {}

void FineCheck::run(const gpu::Texture& video, const gpu::Texture& still, const Weights& weights,
                    const gpu::Texture& statistics, const TileBuffer& tiles,
                    const FineMatch& match) {
    const Size tileCount = tiles.work().tiles;
    sum_.run({.columns = cells_.width,
              .rows = cells_.height,
              .videoWidth = rig_.video.size.width,
              .videoHeight = rig_.video.size.height,
              .scaleX = static_cast<float>(rig_.still.fx / rig_.video.fx),
              .scaleY = static_cast<float>(rig_.still.fy / rig_.video.fy),
              .texelX = 1.0F / static_cast<float>(rig_.still.size.width),
              .texelY = 1.0F / static_cast<float>(rig_.still.size.height)},
             {gpu::storage(0, tiles.buffer()), gpu::sampler(0, video),
              gpu::sampler(1, weights.lookUps), gpu::sampler(2, still), gpu::sampler(3, statistics),
              gpu::imageWrite(0, sums_)},
             {static_cast<GLuint>(tileCount.width), static_cast<GLuint>(tileCount.height), 1});
    confirm_.run({.columns = cells_.width,
                  .rows = cells_.height,
                  .noise = match.noise,
                  .share = match.share},
                 {gpu::sampler(0, sums_), gpu::sampler(1, weights.weighed),
                  gpu::sampler(2, weights.trust), gpu::sampler(3, weights.lookUps),
                  gpu::imageWrite(0, weighed_), gpu::imageWrite(1, trust_),
                  gpu::imageWrite(2, lookUps_)},
                 {gpu::groupsFor(cells_.width, 8), gpu::groupsFor(cells_.height, 8), 1});
}

}  // namespace mfar
