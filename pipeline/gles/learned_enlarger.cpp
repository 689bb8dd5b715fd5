#include "pipeline/gles/learned_enlarger.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>

namespace mfar {
namespace {

constexpr const char* kLearned = "#define LEARNED\n";
constexpr const char* kAround = "#define AROUND\n";
constexpr int kClasses = enlarge::GradientClasses::kCount + enlarge::CurvatureClasses::kCount;
constexpr int kFilterWords = enlarge::kFilterSize / 2;

std::uint32_t halfOf(std::int16_t weight) {
    return Eigen::half(static_cast<float>(weight) / enlarge::kWeightScale).x;
}

gpu::Framebuffer targetOf(const gpu::Texture& first, const gpu::Texture& second) {
    const std::array<const gpu::Texture*, 2> both{&first, &second};
    return gpu::Framebuffer(both);
}

void setGuidance(params::DrawTiles& params, const FilterBank& filters) {
    params.guidanceStill = filters.guidance().still;
    params.guidanceVideo = filters.guidance().video;
    params.guidanceLight = filters.guidance().light;
}

PixelRect tilesAround(const TileWork& work) {
    PixelRect out{work.tiles.width, work.tiles.height, 0, 0};
    for (int row = 0, i = 0; row < work.tiles.height; ++row)
        for (int column = 0; column < work.tiles.width; ++column, ++i) {
            const auto tile = static_cast<std::size_t>(i);
            if (!work.draws(tile) || work.flags[tile].matched == 0) continue;
            out = {std::min(out.x0, column), std::min(out.y0, row), std::max(out.x1, column + 1),
                   std::max(out.y1, row + 1)};
        }
    if (out.empty()) return out;
    return {std::max(out.x0 - 1, 0), std::max(out.y0 - 1, 0),
            std::min(out.x1 + 1, work.tiles.width), std::min(out.y1 + 1, work.tiles.height)};
}

}  // namespace

LearnedEnlarger::LearnedEnlarger(Size video, Size output)
    : video_(video), tiles_(tilesOf(video)),
      filters_({kFilterWords / 4, kClasses}, gpu::TexelFormat::Rgba32Ui),
      learned_(tiles_, gpu::TexelFormat::R8),
      grid_({video.width, enlarge::kGrid * video.height}, gpu::TexelFormat::Rgba16I),
      seen_(video, gpu::TexelFormat::Rgba16I), guided_(video, gpu::TexelFormat::R16I),
      columns_({video.width, output.height}, gpu::TexelFormat::Rgba16I),
      residuals_(columns_.size(), gpu::TexelFormat::Rgba16I), seenTarget_(seen_),
      guidedTarget_(guided_), columnsTarget_(targetOf(columns_, residuals_)),
      enlarge_("superres_enlarge.comp"), see_("superres_seen.frag"), guide_("superres_guide.frag"),
      enlargeColumns_("superres_vertical.frag", kLearned), passes_(kLearned),
      seeAround_("tile_rect.vert", "superres_seen.frag", kAround),
      guideAround_("tile_rect.vert", "superres_guide.frag", kAround),
      enlargeColumnsAround_("tile_rect.vert", "superres_vertical.frag",
                            "#define AROUND\n#define LEARNED\n"),
      second_("tile_rect.vert", "composite_detail.frag", "#define SECOND\n") {}

// Uploads the filters as half floats, because shaders unpack two half floats in one instruction. A
// half float keeps only 11 of the 14 bits of a weight near 1.
void LearnedEnlarger::takeFilters(const FilterBank& filters) {
    if (number_ == filters.number()) return;
    std::vector<std::uint32_t> words;
    words.reserve(std::size_t{kFilterWords} * kClasses);
    for (const Rows<const std::int16_t>& rows : {filters.gradient(), filters.curvature()})
        for (int i = 0; i < rows.size.height; ++i)
            for (int n = 0; n < enlarge::kFilterSize; n += 2)
                words.push_back(halfOf(rows[i][n]) | halfOf(rows[i][n + 1]) << 16U);
    filters_.upload(std::span<const std::uint32_t>(words));
    number_ = filters.number();
}

void LearnedEnlarger::takeTiles(const TileWork& work) {
    std::vector<std::uint8_t> mask;
    mask.reserve(work.flags.size());
    for (const TileWork::Tile& tile : work.flags)
        mask.push_back(tile.matched != 0 ? 255 : 0);
    if (mask == mask_) return;
    learned_.upload({mask.data(), static_cast<std::size_t>(tiles_.width)});
    mask_.swap(mask);
}

void LearnedEnlarger::fillGrid(const gpu::Texture& video, const TileBuffer& tiles) {
    const PixelRect where = tilesAround(tiles.work());
    if (where.empty()) return;
    enlarge_.run({.videoWidth = video_.width,
                  .videoHeight = video_.height,
                  .columns = tiles_.width,
                  .rows = tiles_.height,
                  .firstColumn = where.x0,
                  .firstRow = where.y0},
                 {gpu::storage(0, tiles.buffer()), gpu::sampler(0, video),
                  gpu::sampler(1, filters_), gpu::imageWrite(0, grid_)},
                 {static_cast<GLuint>(where.x1 - where.x0),
                  static_cast<GLuint>(2 * (where.y1 - where.y0)), 1});
}

// In a tile, each pass also reads results of the previous pass in neighbouring tiles. So if a pass
// did not run in the last frame, it draws all tiles.
void LearnedEnlarger::run(const gpu::Texture& video, const Seen* seen, const TileBuffer& tiles,
                          const FilterBank& filters, params::DrawTiles params,
                          const gpu::InstanceList& list) {
    takeFilters(filters);
    takeTiles(tiles.work());
    fillGrid(video, tiles);
    const bool whole = tiles.work().drawsWhole();
    setGuidance(params, filters);
    const bool guides = seen != nullptr && filters.guidance().any();
    if (seen != nullptr)
        see_.run(
            whole || seenIsOld_, params,
            {gpu::sampler(0, video), gpu::sampler(2, seen->lookUps), gpu::sampler(3, seen->still)},
            seenTarget_, list);
    if (guides)
        guide_.run(whole || guidedIsOld_, params, {gpu::sampler(1, seen_)}, guidedTarget_, list);
    const bool allColumns =
        whole || columnsAreOld_ || (seen != nullptr && seenIsOld_) || guides == guidedIsOld_;
    enlargeColumns_.run(
        allColumns, params,
        {gpu::sampler(0, video), gpu::sampler(1, guides ? guided_ : seen_), gpu::sampler(2, grid_)},
        columnsTarget_, list);
    seenIsOld_ = seen == nullptr;
    guidedIsOld_ = !guides;
    columnsAreOld_ = false;
}

void LearnedEnlarger::seeSecond(const gpu::Texture& video, const Seen& seen,
                                const FilterBank& filters, params::DrawTiles params,
                                const gpu::InstanceList& list) {
    setGuidance(params, filters);
    seeAround_.runTiles(
        params,
        {gpu::sampler(0, video), gpu::sampler(2, seen.lookUps), gpu::sampler(3, seen.still)},
        seenTarget_, list);
    const bool guides = filters.guidance().any();
    if (guides) guideAround_.runTiles(params, {gpu::sampler(1, seen_)}, guidedTarget_, list);
    enlargeColumnsAround_.runTiles(
        params,
        {gpu::sampler(0, video), gpu::sampler(1, guides ? guided_ : seen_), gpu::sampler(2, grid_)},
        columnsTarget_, list);
}

}  // namespace mfar
