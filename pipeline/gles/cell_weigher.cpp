#include "pipeline/gles/cell_weigher.h"

#include "pipeline/flow/cell_field.h"

namespace mfar {
namespace {

gpu::Groups groupsOf(Size cells, int perGroup) {
    return {gpu::groupsFor(cells.width, perGroup), gpu::groupsFor(cells.height, perGroup), 1};
}

}  // namespace

CellWeigher::CellWeigher(const StereoRig& rig)
    : rig_(rig), cells_(cellsOf(rig.video.size)),
      halfCells_(cellsOf({(rig.video.size.width + 1) / 2, (rig.video.size.height + 1) / 2})),
      displacement_(cells_, gpu::TexelFormat::Rgba32F),
      statistics_(cells_, gpu::TexelFormat::Rgba32F),
      halfStatistics_(halfCells_, gpu::TexelFormat::Rgba32F),
      weighed_(cells_, gpu::TexelFormat::Rgba32F),
      lookUps_(cells_, gpu::TexelFormat::Rgba16F, gpu::Filter::Linear),
      trust_(cells_, gpu::TexelFormat::Rgba8, gpu::Filter::Linear), assess_("superres_assess.comp"),
      gain_("superres_gain.comp"), weigh_("superres_weigh.comp") {}

void CellWeigher::run(const WeighInput& in, const TileBuffer& tiles) {
    const TileWork& work = tiles.work();
    if (work.changed == 0) return;
    assess(in, tiles);
    if (work.matched > 0) measureGain(in, tiles);
    weigh(work.noise);
}

void CellWeigher::assess(const WeighInput& in, const TileBuffer& tiles) {
    assess_.run({.rig = rigParams(rig_),
                 .video = in.video[0],
                 .still = in.still[0],
                 .columns = in.forward.width,
                 .rows = in.forward.height,
                 .backwardColumns = in.backward.width,
                 .backwardRows = in.backward.height,
                 .forward = in.first,
                 .backward = in.first + in.forward.width * in.forward.height,
                 .errorsGiven = in.errorsGiven ? 1 : 0,
                 .backwardScale = 1 << in.backwardLevel,
                 .stillWidth = static_cast<float>(rig_.still.size.width),
                 .stillHeight = static_cast<float>(rig_.still.size.height),
                 .scaleX = static_cast<float>(rig_.still.fx / rig_.video.fx),
                 .scaleY = static_cast<float>(rig_.still.fy / rig_.video.fy)},
                {gpu::storage(0, in.words), gpu::storage(1, in.cells),
                 gpu::storage(2, tiles.buffer()), gpu::imageWrite(0, displacement_),
                 gpu::imageWrite(1, statistics_)},
                groupsOf(cells_, 4));
}

void CellWeigher::measureGain(const WeighInput& in, const TileBuffer& tiles) {
    gain_.run({.video = in.video[1],
               .still = in.still[1],
               .columns = halfCells_.width,
               .rows = halfCells_.height,
               .forwardColumns = cells_.width,
               .forwardRows = cells_.height,
               .forward = in.first,
               .tileColumns = tiles.work().tiles.width},
              {gpu::storage(0, in.words), gpu::storage(1, in.cells),
               gpu::storage(2, tiles.buffer()), gpu::imageWrite(0, halfStatistics_)},
              groupsOf(halfCells_, 4));
}

void CellWeigher::weigh(double noise) {
    weigh_.run({.columns = cells_.width,
                .rows = cells_.height,
                .halfColumns = halfCells_.width,
                .halfRows = halfCells_.height,
                .noise = static_cast<float>(noise)},
               {gpu::sampler(0, displacement_), gpu::sampler(1, statistics_),
                gpu::sampler(2, halfStatistics_), gpu::imageWrite(0, weighed_),
                gpu::imageWrite(1, trust_), gpu::imageWrite(2, lookUps_)},
               groupsOf(cells_, 8));
}

}  // namespace mfar
