#include "pipeline/gles/subpixel_corrector.h"

#include "pipeline/flow/cell_field.h"
#include "pipeline/gles/luma_pyramids.h"

#include <array>

namespace mfar {

SubpixelCorrector::SubpixelCorrector(const StereoRig& stillRig)
    : rig_(stillRig), cells_(cellsOf(stillRig.video.size)), chooser_(stillRig),
      sums_(sizeof(std::array<float, 16>) * cells_.width * cells_.height),
      sum_("flow_subpixel_sums.comp"), correct_("flow_subpixel.comp") {}

void SubpixelCorrector::run(const gpu::Buffer& cells, const FlowChooser::Fields& fields,
                            const gpu::Texture& video, const gpu::Texture& still, float light,
                            const TileBuffer& tiles) {
    const TileWork& work = tiles.work();
    if (work.matched == 0) return;
    const gpu::Groups groups{gpu::groupsFor(cells_.width, kCellsPerTile),
                             gpu::groupsFor(cells_.height, kCellsPerTile), 1};
    const gpu::Buffer& chosen = chooser_.run(cells, fields, video, still, light, tiles);
    sum_.run({.rig = rigParams(rig_),
              .columns = cells_.width,
              .rows = cells_.height,
              .source = 0,
              .texelX = 1.0F / static_cast<float>(rig_.still.size.width),
              .texelY = 1.0F / static_cast<float>(rig_.still.size.height),
              .light = light},
             {gpu::storage(1, chosen), gpu::storage(2, sums_), gpu::sampler(0, video),
              gpu::sampler(1, still)},
             groups);
    correct_.run({.columns = cells_.width,
                  .rows = cells_.height,
                  .target = fields.flow,
                  .noise = static_cast<float>(work.noise)},
                 {gpu::storage(1, cells), gpu::storage(2, tiles.buffer()), gpu::storage(3, sums_)},
                 groups);
}

}  // namespace mfar
