#include "pipeline/superres/superres.h"

#include "base/gl/scoped_state.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>

namespace mfar {
namespace {

constexpr float kAlpha = 2.0F;  // eq. 2 [video px]
// Below this weight the detail changes no pixel by a grey level.
constexpr float kLeastWeight = 0.02F;
// A tile within these spreads is drawn as one quad; 0.08 px are 0.3 px of the output.
constexpr float kPlainFlow = 0.08F;
constexpr float kPlainWeight = 0.25F;
constexpr std::uint32_t kQuadVertices = 6;
constexpr const char* kLinear = "#define LINEAR\n";
constexpr const char* kPlain = "#define PLAIN_TILE\n";

}  // namespace

SuperRes::SuperRes(const StereoRig& rig, Size output, SuperResMode mode,
                   const LumaPyramids& pyramids, WorkPlan& plan)
    : rig_(rig), mode_(mode), video_{pyramids.video()[0].width, pyramids.video()[0].height},
      cells_(cellsOf(video_)),
      halfCells_(cellsOf({(video_.width + 1) / 2, (video_.height + 1) / 2})),
      tiles_(plan.tileCount()), displacement_(cells_, gpu::TexelFormat::Rgba32F),
      statistics_(cells_, gpu::TexelFormat::Rgba32F),
      halfStatistics_(halfCells_, gpu::TexelFormat::Rgba32F),
      cellField_(cells_, gpu::TexelFormat::Rgba32F),
      weightField_(cells_, gpu::TexelFormat::Rgba8, gpu::Filter::Linear),
      lookupField_(cells_, gpu::TexelFormat::Rgba16F, gpu::Filter::Linear),
      sharpened_(video_, gpu::TexelFormat::Rgba8),
      columns_({video_.width, output.height}, gpu::TexelFormat::Rgba8),
      output_(output, gpu::TexelFormat::Rgba8), sharpenedTarget_(sharpened_),
      columnsTarget_(columns_), outputTarget_(output_),
      classes_(8 * static_cast<std::size_t>(tiles_.width) * tiles_.height),
      lists_(16 * static_cast<std::size_t>(tiles_.width) * tiles_.height),
      draws_{gpu::Buffer(sizeof(DrawBlock)), gpu::Buffer(sizeof(DrawBlock))},
      assessDispatch_(
          plan.add({gpu::groupsFor(cells_.width, 4), gpu::groupsFor(cells_.height, 4), 1},
                   WorkPlan::For::Changed)),
      gainDispatch_(
          plan.add({gpu::groupsFor(halfCells_.width, 4), gpu::groupsFor(halfCells_.height, 4), 1})),
      weighDispatch_(
          plan.add({gpu::groupsFor(cells_.width, 8), gpu::groupsFor(cells_.height, 8), 1},
                   WorkPlan::For::Changed)),
      assess_("superres_assess.comp"), gain_("superres_gain.comp"), weigh_("superres_weigh.comp"),
      classify_("superres_classify.comp"), sharpen_("superres_sharpen.frag"),
      wholeDetail_("composite_detail.frag"), wholeBlend_("composite_blend.frag"),
      detail_("tile_rect.vert", "composite_detail.frag", ""),
      plainDetail_("tile_rect.vert", "composite_detail.frag", kPlain),
      blend_("tile_rect.vert", "composite_blend.frag", ""),
      plainBlend_("tile_rect.vert", "composite_blend.frag", kPlain) {}

void SuperRes::assess(const LumaPyramids& pyramids, const Flow2d& flow, const WorkPlan& plan) {
    AssessParams p{};
    p.rig = rigParams(rig_);
    p.video = pyramids.video()[0];
    p.still = pyramids.still()[0];
    const Flow2d::Field& fw = flow.forward();
    const Flow2d::Field& bw = flow.backward();
    p.cells[0] = fw.cells.width;
    p.cells[1] = fw.cells.height;
    p.cells[2] = bw.cells.width;
    p.cells[3] = bw.cells.height;
    p.offsets[0] = fw.offset;
    p.offsets[1] = bw.offset;
    p.offsets[2] = flow.errorsGiven() ? 1 : 0;
    p.offsets[3] = 1 << bw.level;
    p.tune[0] = kAlpha;
    p.stillSize[0] = static_cast<float>(rig_.still.size.width);
    p.stillSize[1] = static_cast<float>(rig_.still.size.height);
    p.stillSize[2] = static_cast<float>(rig_.still.fx / rig_.video.fx);
    p.stillSize[3] = static_cast<float>(rig_.still.fy / rig_.video.fy);
    plan.run(assess_, p,
             {gpu::storage(0, pyramids.words()), gpu::storage(1, flow.patches()),
              gpu::storage(2, plan.tiles()), gpu::imageWrite(0, displacement_),
              gpu::imageWrite(1, statistics_)},
             assessDispatch_);
    measureGain(pyramids, flow, plan);
    weigh(plan);
}

void SuperRes::measureGain(const LumaPyramids& pyramids, const Flow2d& flow, const WorkPlan& plan) {
    GainParams g{};
    g.video = pyramids.video()[1];
    g.still = pyramids.still()[1];
    g.cells[0] = halfCells_.width;
    g.cells[1] = halfCells_.height;
    g.cells[2] = cells_.width;
    g.cells[3] = cells_.height;
    g.offsets[0] = flow.forward().offset;
    g.offsets[1] = tiles_.width;
    plan.run(gain_, g,
             {gpu::storage(0, pyramids.words()), gpu::storage(1, flow.patches()),
              gpu::storage(2, plan.tiles()), gpu::imageWrite(0, halfStatistics_)},
             gainDispatch_);
}

void SuperRes::weigh(const WorkPlan& plan) {
    WeighParams w{};
    w.cells[0] = cells_.width;
    w.cells[1] = cells_.height;
    w.cells[2] = halfCells_.width;
    w.cells[3] = halfCells_.height;
    w.tune[0] = static_cast<float>(plan.noise());
    plan.run(weigh_, w,
             {gpu::sampler(0, displacement_), gpu::sampler(1, statistics_),
              gpu::sampler(2, halfStatistics_), gpu::imageWrite(0, cellField_),
              gpu::imageWrite(1, weightField_), gpu::imageWrite(2, lookupField_)},
             weighDispatch_);
}

void SuperRes::classify(const WorkPlan& plan, bool hasStill) {
    current_ = 1 - current_;
    DrawBlock block{};
    for (auto& command : block.commands)
        command[0] = kQuadVertices;
    draws_[current_].write(std::span<const DrawBlock>(&block, 1));
    ClassifyParams p{};
    p.tiles[0] = tiles_.width;
    p.tiles[1] = tiles_.height;
    p.tiles[2] = cells_.width;
    p.tiles[3] = cells_.height;
    p.tune[0] = skips_.upscaledTiles ? kLeastWeight : -1.0F;
    p.tune[1] = skips_.plainTiles ? kPlainFlow : 0.0F;
    p.tune[2] = kPlainWeight;
    p.tune[3] = hasStill ? 0.0F : 1.0F;
    classify_.run(p,
                  {gpu::storage(0, plan.tiles()), gpu::storage(1, classes_),
                   gpu::storage(2, draws_[current_]), gpu::storage(3, lists_),
                   gpu::sampler(0, cellField_), gpu::sampler(1, weightField_)},
                  {gpu::groupsFor(tiles_.width, 8), gpu::groupsFor(tiles_.height, 8), 1});
}

gpu::InstanceList SuperRes::list(List which) const {
    const std::size_t tiles = static_cast<std::size_t>(tiles_.width) * tiles_.height;
    const auto index = static_cast<std::size_t>(which);
    return {draws_[current_], 16 * index, lists_, 4 * index * tiles};
}

SuperRes::TileParams SuperRes::tileParams(bool useStill) const {
    TileParams p{};
    p.video[0] = video_.width;
    p.video[1] = video_.height;
    p.video[2] = cells_.width;
    p.video[3] = cells_.height;
    p.scale[0] = static_cast<float>(video_.width) / static_cast<float>(output_.size().width);
    p.scale[1] = static_cast<float>(video_.height) / static_cast<float>(output_.size().height);
    p.scale[2] = 1.0F / static_cast<float>(rig_.still.size.width);
    p.scale[3] = 1.0F / static_cast<float>(rig_.still.size.height);
    p.tune[0] = mode_ == SuperResMode::Detail && useStill ? 1.0F : 0.0F;
    p.tune[2] = p.scale[0] * static_cast<float>(rig_.still.fx / rig_.video.fx);
    p.tune[3] = p.scale[1] * static_cast<float>(rig_.still.fy / rig_.video.fy);
    return p;
}

void SuperRes::drawBoth(TilePass& pass, const TileParams& params, gpu::Bindings bindings,
                        const gpu::Framebuffer& target, const WorkPlan& plan) {
    if (plan.drawsWhole())
        pass.whole.run(params, bindings, target);
    else
        pass.tiles.runTiles(params, bindings, target, list(List::All));
}

// Tiles beside those that are drawn are looked at, too: after frames without, all are made.
void SuperRes::sharpen(const TileParams& params, const gpu::Texture& video, const WorkPlan& plan) {
    const gpu::Bindings from{gpu::sampler(0, video), gpu::sampler(1, weightField_)};
    if (sharpenedIsOld_)
        sharpen_.whole.run(params, from, sharpenedTarget_);
    else
        drawBoth(sharpen_, params, from, sharpenedTarget_, plan);
}

SuperRes::Enlarging& SuperRes::enlarging() {
    if (cubic_) return cubicly_;
    if (!linearly_) linearly_.emplace(kLinear);
    return *linearly_;
}

void SuperRes::drawDetail(gpu::DrawPass<TileParams>& detail, const TileParams& params,
                          gpu::Bindings bindings, const WorkPlan& plan) {
    const PixelRect in = outputOf(plan.detailTiles());
    const auto [width, height] = output_.size();
    for (const PixelRect& part :
         {PixelRect{0, 0, width, in.y0}, PixelRect{0, in.y1, width, height},
          PixelRect{0, in.y0, in.x0, in.y1}, PixelRect{in.x1, in.y0, width, in.y1}}) {
        if (part.empty()) continue;
        const gpu::Scissor scissor(part);
        cubicly_.rows.whole.run(params, {gpu::sampler(0, columns_)}, outputTarget_);
    }
    const gpu::Scissor scissor(in);
    detail.run(params, bindings, outputTarget_);
}

// The pixels of the output that show these tiles, or parts of them.
PixelRect SuperRes::outputOf(const PixelRect& tiles) const {
    const auto [width, height] = output_.size();
    const auto at = [](int tile, int video, int out, int rest) {
        const long pixels = std::min(tile * kTileSize, video) * static_cast<long>(out);
        return static_cast<int>((pixels + rest * (video - 1)) / video);
    };
    return {at(tiles.x0, video_.width, width, 0), at(tiles.y0, video_.height, height, 0),
            at(tiles.x1, video_.width, width, 1), at(tiles.y1, video_.height, height, 1)};
}

void SuperRes::draw(const gpu::Texture& video, const StillReference* still, const WorkPlan& plan) {
    const bool useStill = still != nullptr && mode_ != SuperResMode::Off;
    const bool blend = mode_ == SuperResMode::Blend;
    // Both counts of a frame at rest are there after two of them.
    restingFrames_ = plan.changedTiles() == 0 ? restingFrames_ + 1 : 0;
    if (restingFrames_ <= 2) classify(plan, useStill);
    // A draw of no tiles would have its shader compiled all the same.
    if (restingFrames_ > 0) return;

    const TileParams p = tileParams(useStill);
    const bool sharpens = p.tune[0] > 0;
    if (sharpens) sharpen(p, video, plan);
    sharpenedIsOld_ = !sharpens;
    Enlarging& enlarging = this->enlarging();
    drawBoth(enlarging.columns, p, {gpu::sampler(0, sharpens ? sharpened_ : video)}, columnsTarget_,
             plan);
    if (!plan.drawsWhole())
        enlarging.rows.tiles.runTiles(p, {gpu::sampler(0, columns_)}, outputTarget_,
                                      list(List::Upscaled));
    if (useStill) {
        const gpu::Bindings from{gpu::sampler(0, columns_),
                                 gpu::sampler(1, blend ? still->picture() : still->detail()),
                                 gpu::sampler(2, lookupField_)};
        if (plan.drawsWholeEnlarged())
            enlarging.rows.whole.run(p, {gpu::sampler(0, columns_)}, outputTarget_);
        if (plan.drawsWholeDetail()) {
            drawDetail(blend ? wholeBlend_ : wholeDetail_, p, from, plan);
            return;
        }
        (blend ? plainBlend_ : plainDetail_).runTiles(p, from, outputTarget_, list(List::Trusted));
        (blend ? blend_ : detail_).runTiles(p, from, outputTarget_, list(List::Blended));
    } else if (plan.drawsWhole()) {
        enlarging.rows.whole.run(p, {gpu::sampler(0, columns_)}, outputTarget_);
    }
}

FrameStats SuperRes::stats(int which) const {
    const auto block = draws_[which].read<DrawBlock>(1)[0];
    FrameStats s;
    int total = 0;
    for (std::size_t i = 0; i < kTileClasses; ++i) {
        s.tiles[i] = static_cast<int>(block.counts[i]);
        total += s.tiles[i];
    }
    if (total == 0) return s;
    s.changed = 1.0 - static_cast<double>(s.tiles[0]) / total;
    s.explained = 1.0 - static_cast<double>(block.counts[5]) / total;
    s.meanConfidence = block.counts[6] / (256.0 * total);
    return s;
}

std::vector<TileClass> SuperRes::readClasses() const {
    const std::size_t tiles = static_cast<std::size_t>(tiles_.width) * tiles_.height;
    const auto raw = classes_.read<std::array<std::uint32_t, 2>>(tiles);
    std::vector<TileClass> out;
    out.reserve(tiles);
    for (const auto& r : raw)
        out.push_back(static_cast<TileClass>(r[0]));
    return out;
}

}  // namespace mfar
