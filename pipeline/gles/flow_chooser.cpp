#include "pipeline/gles/flow_chooser.h"

#include "pipeline/flow/cell_field.h"
#include "pipeline/gles/luma_pyramids.h"

#include <array>

namespace mfar {

FlowChooser::FlowChooser(const StereoRig& stillRig)
    : rig_(stillRig), cells_(cellsOf(stillRig.video.size)),
      chosen_(sizeof(std::array<float, 4>) * cells_.width * cells_.height),
      choose_("flow_choose.comp") {}

const gpu::Buffer& FlowChooser::run(const gpu::Buffer& cells, const Fields& fields,
                                    const gpu::Texture& video, const gpu::Texture& still,
                                    float light, const TileBuffer& tiles) {
    choose_.run({.rig = rigParams(rig_),
                 .columns = cells_.width,
                 .rows = cells_.height,
                 .videoWidth = rig_.video.size.width,
                 .videoHeight = rig_.video.size.height,
                 .source = fields.flow,
                 .errors = fields.errors,
                 .texelX = 1.0F / static_cast<float>(rig_.still.size.width),
                 .texelY = 1.0F / static_cast<float>(rig_.still.size.height),
                 .light = light,
                 .noise = static_cast<float>(tiles.work().noise)},
                {gpu::storage(1, cells), gpu::storage(2, tiles.buffer()), gpu::storage(3, chosen_),
                 gpu::sampler(0, video), gpu::sampler(1, still)},
                {gpu::groupsFor(cells_.width, kCellsPerTile),
                 gpu::groupsFor(cells_.height, kCellsPerTile), 1});
    return chosen_;
}

}  // namespace mfar
