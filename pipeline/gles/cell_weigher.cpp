#include "pipeline/gles/cell_weigher.h"

#include "pipeline/flow/cell_field.h"

namespace mfar {
namespace {

constexpr float kAlpha = 2.0F;  // eq. 2 [video px]

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
    AssessParams p{};
    p.rig = rigParams(rig_);
    p.video = in.video[0];
    p.still = in.still[0];
    p.cells[0] = in.forward.width;
    p.cells[1] = in.forward.height;
    p.cells[2] = in.backward.width;
    p.cells[3] = in.backward.height;
    p.offsets[0] = in.first;
    p.offsets[1] = in.first + in.forward.width * in.forward.height;
    p.offsets[2] = in.errorsGiven ? 1 : 0;
    p.offsets[3] = 1 << in.backwardLevel;
    p.tune[0] = kAlpha;
    p.stillSize[0] = static_cast<float>(rig_.still.size.width);
    p.stillSize[1] = static_cast<float>(rig_.still.size.height);
    p.stillSize[2] = static_cast<float>(rig_.still.fx / rig_.video.fx);
    p.stillSize[3] = static_cast<float>(rig_.still.fy / rig_.video.fy);
    assess_.run(p,
                {gpu::storage(0, in.words), gpu::storage(1, in.patches),
                 gpu::storage(2, tiles.buffer()), gpu::imageWrite(0, displacement_),
                 gpu::imageWrite(1, statistics_)},
                groupsOf(cells_, 4));
}

void CellWeigher::measureGain(const WeighInput& in, const TileBuffer& tiles) {
    GainParams g{};
    g.video = in.video[1];
    g.still = in.still[1];
    g.cells[0] = halfCells_.width;
    g.cells[1] = halfCells_.height;
    g.cells[2] = cells_.width;
    g.cells[3] = cells_.height;
    g.offsets[0] = in.first;
    g.offsets[1] = tiles.work().tiles.width;
    gain_.run(g,
              {gpu::storage(0, in.words), gpu::storage(1, in.patches),
               gpu::storage(2, tiles.buffer()), gpu::imageWrite(0, halfStatistics_)},
              groupsOf(halfCells_, 4));
}

void CellWeigher::weigh(double noise) {
    WeighParams w{};
    w.cells[0] = cells_.width;
    w.cells[1] = cells_.height;
    w.cells[2] = halfCells_.width;
    w.cells[3] = halfCells_.height;
    w.tune[0] = static_cast<float>(noise);
    weigh_.run(w,
               {gpu::sampler(0, displacement_), gpu::sampler(1, statistics_),
                gpu::sampler(2, halfStatistics_), gpu::imageWrite(0, weighed_),
                gpu::imageWrite(1, trust_), gpu::imageWrite(2, lookUps_)},
               groupsOf(cells_, 8));
}

}  // namespace mfar
