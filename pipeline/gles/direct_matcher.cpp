#include "pipeline/gles/direct_matcher.h"

#include "pipeline/flow/cell_field.h"
#include "pipeline/flow/least_texture.h"
#include "pipeline/gles/luma_pyramids.h"

namespace mfar {

DirectMatcher::DirectMatcher(const StereoRig& stillRig)
    : rig_(stillRig), cells_(cellsOf(stillRig.video.size)), compare_("flow_direct.comp") {}

void DirectMatcher::run(const gpu::Buffer& cells, const Fields& fields, const gpu::Texture& video,
                        const gpu::Texture& still, const TileBuffer& tiles) {
    const TileWork& work = tiles.work();
    if (work.matched == 0) return;
    compare_.run({.rig = rigParams(rig_),
                  .columns = cells_.width,
                  .rows = cells_.height,
                  .videoWidth = rig_.video.size.width,
                  .videoHeight = rig_.video.size.height,
                  .target = fields.flow,
                  .source = fields.lines,
                  .errors = fields.errors,
                  .noise = static_cast<float>(work.noise),
                  .texelX = 1.0F / static_cast<float>(rig_.still.size.width),
                  .texelY = 1.0F / static_cast<float>(rig_.still.size.height),
                  .leastTexture = leastTexture(work.noise)},
                 {gpu::storage(1, cells), gpu::storage(2, tiles.buffer()), gpu::sampler(0, video),
                  gpu::sampler(1, still)},
                 {gpu::groupsFor(cells_.width, kCellsPerTile),
                  gpu::groupsFor(cells_.height, kCellsPerTile), 1});
}

}  // namespace mfar
