#include "pipeline/gles/detail_painter.h"

#include "base/gl/scoped_state.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/plan/tile_edges.h"

#include <algorithm>

namespace mfar {
namespace {

constexpr std::uint32_t kQuadVertices = 6;
constexpr const char* kPlain = "#define PLAIN_TILE\n";

const FilterBank* filtersOf(const DetailOptions& options) {
    return options.mode == SuperResMode::Detail ? options.filters : nullptr;
}

}  // namespace

DetailPainter::DetailPainter(const StereoRig& stillRig, Size output)
    : rig_(stillRig), video_(stillRig.video.size), cells_(cellsOf(video_)), tiles_(tilesOf(video_)),
      blank_(cells_, gpu::TexelFormat::Rgba8), sharpened_(video_, gpu::TexelFormat::Rgba8),
      columns_({video_.width, output.height}, gpu::TexelFormat::Rgba8),
      output_(output, gpu::TexelFormat::Rgba8), sharpenedTarget_(sharpened_),
      columnsTarget_(columns_), outputTarget_(output_),
      classes_(8 * static_cast<std::size_t>(tiles_.width) * tiles_.height),
      lists_(24 * static_cast<std::size_t>(tiles_.width) * tiles_.height),
      draws_{gpu::Buffer(sizeof(DrawBlock)), gpu::Buffer(sizeof(DrawBlock))},
      classify_("superres_classify.comp"), sharpen_("superres_sharpen.frag"),
      columnsPass_("superres_vertical.frag"), wholeBlend_("composite_blend.frag"),
      blend_("tile_rect.vert", "composite_blend.frag", ""),
      plainBlend_("tile_rect.vert", "composite_blend.frag", kPlain) {}

void DetailPainter::classify(const Matched* matched, const TileBuffer& tiles,
                             const DetailOptions& options) {
    current_ = 1 - current_;
    DrawBlock block{};
    for (auto& command : block.commands)
        command[0] = kQuadVertices;
    draws_[current_].write(std::span<const DrawBlock>(&block, 1));
    const bool learns = filtersOf(options) != nullptr;
    const Matched* second = matched != nullptr && learns ? matched->second : nullptr;
    const bool hasDetail = matched != nullptr && options.mode == SuperResMode::Detail;
    classified_ = std::max(classified_ + 1, 1U);
    classify_.run({.columns = tiles_.width,
                   .rows = tiles_.height,
                   .cellColumns = cells_.width,
                   .cellRows = cells_.height,
                   .leastWeight = options.enlargedTiles ? params::kLeastDetailWeight : -1.0F,
                   .plainFlow = options.plainTiles ? params::kPlainFlow : 0.0F,
                   .stillGiven = matched != nullptr ? 1 : 0,
                   .detailFrame = hasDetail || learns ? classified_ : 0,
                   .learns = learns ? 1 : 0,
                   .secondGiven = second != nullptr ? 1 : 0},
                  {gpu::storage(0, tiles.buffer()), gpu::storage(1, classes_),
                   gpu::storage(2, draws_[current_]), gpu::storage(3, lists_),
                   gpu::sampler(0, matched != nullptr ? matched->weighed : blank_),
                   gpu::sampler(1, matched != nullptr ? matched->trust : blank_),
                   gpu::sampler(2, second != nullptr ? second->weighed : blank_),
                   gpu::sampler(3, second != nullptr ? second->trust : blank_)},
                  {gpu::groupsFor(tiles_.width, 8), gpu::groupsFor(tiles_.height, 8), 1});
}

gpu::InstanceList DetailPainter::list(List which) const {
    const std::size_t tiles = static_cast<std::size_t>(tiles_.width) * tiles_.height;
    const auto index = static_cast<std::size_t>(which);
    return {draws_[current_], 16 * index, lists_, 4 * index * tiles};
}

DetailPainter::TileParams DetailPainter::tileParams() const {
    TileParams p{};
    p.videoWidth = video_.width;
    p.videoHeight = video_.height;
    p.cellColumns = cells_.width;
    p.cellRows = cells_.height;
    p.scaleX = static_cast<float>(video_.width) / static_cast<float>(output_.size().width);
    p.scaleY = static_cast<float>(video_.height) / static_cast<float>(output_.size().height);
    p.stillTexelX = 1.0F / static_cast<float>(rig_.still.size.width);
    p.stillTexelY = 1.0F / static_cast<float>(rig_.still.size.height);
    p.stillScaleX = p.scaleX * static_cast<float>(rig_.still.fx / rig_.video.fx);
    p.stillScaleY = p.scaleY * static_cast<float>(rig_.still.fy / rig_.video.fy);
    p.sharpening = 1;
    return p;
}

// Sharpens the tiles that are drawn. Drawing a tile also reads sharpened pixels of neighbouring
// tiles. So if the last frame was not sharpened, this frame is sharpened in all tiles.
void DetailPainter::sharpen(const TileParams& params, const gpu::Texture& video,
                            const Matched& matched, const TileWork& work) {
    sharpen_.run(work.drawsWhole() || sharpenedIsOld_, params,
                 {gpu::sampler(0, video), gpu::sampler(1, matched.trust),
                  gpu::sampler(2, matched.lookUps), gpu::sampler(3, matched.still)},
                 sharpenedTarget_, list(List::All));
}

void DetailPainter::enlargeLearned(const TileParams& params, const gpu::Texture& video,
                                   const Matched* matched, const TileBuffer& tiles,
                                   const FilterBank& filters) {
    if (!learned_) learned_.emplace(video_, output_.size());
    if (matched == nullptr) {
        learned_->run(video, nullptr, tiles, filters, params, list(List::All));
        return;
    }
    const LearnedEnlarger::Seen seen{matched->still, matched->lookUps};
    learned_->run(video, &seen, tiles, filters, params, list(List::All));
}

// Enlarges along columns. The programs composite_*.frag then enlarge along rows.
void DetailPainter::enlargeColumns(const TileParams& params, const gpu::Texture& video,
                                   const Matched* matched, const TileBuffer& tiles,
                                   const DetailOptions& options) {
    const FilterBank* filters = filtersOf(options);
    const bool sharpens =
        filters == nullptr && matched != nullptr && options.mode == SuperResMode::Detail;
    if (sharpens) sharpen(params, video, *matched, tiles.work());
    sharpenedIsOld_ = !sharpens;
    if (filters != nullptr) {
        columnsAreOld_ = true;
        enlargeLearned(params, video, matched, tiles, *filters);
        return;
    }
    if (learned_) learned_->skip();
    if (!options.cubic && !linear_) linear_.emplace();
    TilePass& columns = options.cubic ? columnsPass_ : linear_->columns;
    // Drawing a tile also reads the columns of neighbouring tiles.
    columns.run(tiles.work().drawsWhole() || columnsAreOld_, params,
                {gpu::sampler(0, sharpens ? sharpened_ : video)}, columnsTarget_, list(List::All));
    columnsAreOld_ = false;
}

DetailPainter::Composites DetailPainter::compositesFor(const DetailOptions& options) {
    DetailPasses& detail = filtersOf(options) != nullptr ? learned_->passes() : detailPasses_;
    TilePass& enlarged = options.cubic ? detail.enlarged : linear_->rows;
    if (options.mode == SuperResMode::Blend) return {enlarged, wholeBlend_, blend_, plainBlend_};
    return {enlarged, detail.whole, detail.tiles, detail.plain};
}

void DetailPainter::drawDetail(Composites passes, const TileParams& params, gpu::Bindings bindings,
                               const TileWork& work) {
    const PixelRect in = outputOf(work.detailTiles);
    const auto [width, height] = output_.size();
    for (const PixelRect& part :
         {PixelRect{0, 0, width, in.y0}, PixelRect{0, in.y1, width, height},
          PixelRect{0, in.y0, in.x0, in.y1}, PixelRect{in.x1, in.y0, width, in.y1}}) {
        if (part.empty()) continue;
        const gpu::Scissor scissor(part);
        passes.enlarged.whole.run(params, bindings, outputTarget_);
    }
    const gpu::Scissor scissor(in);
    passes.whole.run(params, bindings, outputTarget_);
}

// Returns the output pixels whose centres are in these tiles, as tile_rect.vert draws them.
PixelRect DetailPainter::outputOf(const PixelRect& tiles) const {
    const auto [width, height] = output_.size();
    return {outputPixelsBefore(tiles.x0, video_.width, width),
            outputPixelsBefore(tiles.y0, video_.height, height),
            outputPixelsBefore(tiles.x1, video_.width, width),
            outputPixelsBefore(tiles.y1, video_.height, height)};
}

void DetailPainter::draw(const gpu::Texture& video, const Matched* matched, const TileBuffer& tiles,
                         const DetailOptions& options) {
    const TileWork& work = tiles.work();
    // draws_ stores the counters of the last two frames. After two frames without a change, further
    // frames would leave them unchanged, so classify() is not needed.
    restingFrames_ = work.changed == 0 ? restingFrames_ + 1 : 0;
    if (restingFrames_ <= 2) classify(matched, tiles, options);
    // Returns before any draw call, because even a call that draws nothing would compile its
    // shader.
    if (restingFrames_ > 0) return;

    const TileParams p = tileParams();
    enlargeColumns(p, video, matched, tiles, options);
    const Composites passes = compositesFor(options);
    const bool learns = filtersOf(options) != nullptr;
    const gpu::Texture& columns = learns ? learned_->columns() : columns_;
    // Without a still, the shaders do not read these textures.
    const gpu::Texture& still = matched != nullptr ? matched->still : blank_;
    const gpu::Texture& lookUps = matched != nullptr ? matched->lookUps : blank_;
    if (learns)
        composite(passes, p,
                  {gpu::sampler(0, columns), gpu::sampler(1, still), gpu::sampler(2, lookUps),
                   gpu::sampler(3, learned_->residuals()), gpu::sampler(4, learned_->tiles())},
                  matched != nullptr, work);
    else
        composite(passes, p,
                  {gpu::sampler(0, columns), gpu::sampler(1, still), gpu::sampler(2, lookUps)},
                  matched != nullptr, work);
    if (learns && matched != nullptr && matched->second != nullptr)
        drawSecond(p, video, *matched, *filtersOf(options));
}

// Blends the detail of the second still over that of the first still, in the tiles that show some
// of the second still.
void DetailPainter::drawSecond(const TileParams& params, const gpu::Texture& video,
                               const Matched& matched, const FilterBank& filters) {
    const Matched& second = *matched.second;
    const gpu::InstanceList tiles = list(List::Second);
    learned_->seeSecond(video, {second.still, second.lookUps}, filters, params, tiles);
    const gpu::PremultipliedBlend blend;
    learned_->second().runTiles(
        params,
        {gpu::sampler(0, learned_->columns()), gpu::sampler(1, second.still),
         gpu::sampler(2, second.lookUps), gpu::sampler(3, learned_->residuals()),
         gpu::sampler(4, learned_->tiles()), gpu::sampler(5, matched.lookUps)},
        outputTarget_, tiles);
}

void DetailPainter::composite(Composites passes, const TileParams& params, gpu::Bindings bindings,
                              bool isMatched, const TileWork& work) {
    if (!work.drawsWhole())
        passes.enlarged.tiles.runTiles(params, bindings, outputTarget_, list(List::Enlarged));
    const bool enlargesAll =
        !isMatched ? work.drawsWhole() : work.draw == TileWork::Draw::WholeEnlarged;
    if (enlargesAll) passes.enlarged.whole.run(params, bindings, outputTarget_);
    if (!isMatched) return;
    if (work.draw == TileWork::Draw::Whole) {
        drawDetail(passes, params, bindings, work);
        return;
    }
    passes.plain.runTiles(params, bindings, outputTarget_, list(List::Trusted));
    passes.tiles.runTiles(params, bindings, outputTarget_, list(List::Blended));
}

TileSummary DetailPainter::summary(int which) const {
    const auto block = draws_[which].read<DrawBlock>(1)[0];
    TileSummary s;
    int total = 0;
    for (std::size_t i = 0; i < kTileClasses; ++i) {
        s.tiles[i] = static_cast<int>(block.counts[i]);
        total += s.tiles[i];
    }
    if (total == 0) return s;
    s.explained = 1.0 - static_cast<double>(block.counts[5]) / total;
    s.meanConfidence = block.counts[6] / (256.0 * total);
    s.second = static_cast<int>(block.counts[7]);
    return s;
}

std::vector<TileClass> DetailPainter::readClasses() const {
    const std::size_t tiles = static_cast<std::size_t>(tiles_.width) * tiles_.height;
    const auto raw = classes_.read<std::array<std::uint32_t, 2>>(tiles);
    std::vector<TileClass> out;
    out.reserve(tiles);
    for (const auto& r : raw)
        out.push_back(static_cast<TileClass>(r[0]));
    return out;
}

}  // namespace mfar
