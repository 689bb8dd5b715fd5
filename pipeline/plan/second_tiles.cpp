#include "pipeline/plan/second_tiles.h"

#include <algorithm>

namespace mfar {
namespace {

constexpr int kCells = 4;
// The priority of tiles that the second still showed before is multiplied by this. Otherwise, noise
// would change the choice of tiles in every frame.
constexpr float kRather = 1.5F;

template <class Body>
void forCells(Size tiles, int tile, Size cells, const Body& body) {
    const int x0 = kCells * (tile % tiles.width), y0 = kCells * (tile / tiles.width);
    for (int y = y0; y < std::min(y0 + kCells, cells.height); ++y)
        for (int x = x0; x < std::min(x0 + kCells, cells.width); ++x)
            body(x, y);
}

/// Share of a tile that the newest still does not show, [0, 1]: mean of (1 - weight) *
/// TrustCell::signal over the tile's cells. NaN counts as 0.
float lackOf(Size tiles, int tile, const SecondTiles::Match& newest) {
    float sum = 0;
    forCells(tiles, tile, newest.weighed.size, [&](int x, int y) {
        const float lack = newest.trust[y][x].signal * (1 - newest.weighed[y][x].weight);
        if (lack > 0) sum += std::min(lack, 1.0F);
    });
    return sum / (kCells * kCells);
}

/// Mean over the tile's cells of (weight of the second still - weight of the newest still) *
/// TrustCell::signal, [0, 1]. Negative values count as 0.
float gainOf(Size tiles, int tile, const SecondTiles::Match& newest,
             const Rows<const WeighedCell>& second) {
    float sum = 0;
    forCells(tiles, tile, newest.weighed.size, [&](int x, int y) {
        const float more =
            newest.trust[y][x].signal * (second[y][x].weight - newest.weighed[y][x].weight);
        if (more > 0) sum += std::min(more, 1.0F);
    });
    return sum / (kCells * kCells);
}

}  // namespace

SecondTiles::SecondTiles(Size tiles) : work_(TileWork::everything(tiles)) {
    const std::size_t count = work_.flags.size();
    candidates_.reserve(count);
    showed_.resize(count);
    rest_.resize(count);
    // With Draw::Tiles, steps would keep the last results of unchanged tiles. But each frame
    // chooses its own tiles for the second still, so a tile may have no results of the last frame.
    work_.draw = TileWork::Draw::WholeEnlarged;
}

void SecondTiles::forget() {
    showed_.assign(showed_.size(), false);
    std::ranges::fill(rest_, std::uint8_t{0});
}

const TileWork& SecondTiles::choose(const TileWork& work, std::span<const TileMeasure> measured,
                                    const Match& newest, int most) {
    candidates_.clear();
    matched_ = shownByNewest_ = gained_ = 0;
    const auto count = static_cast<int>(work.flags.size());
    for (int tile = 0; tile < count; ++tile) {
        const auto i = static_cast<std::size_t>(tile);
        work_.flags[i].matched = 0;
        if (work.flags[i].matched == 0 || !work.draws(i)) continue;
        ++matched_;
        const float lack = lackOf(work.tiles, tile, newest);
        if (lack < kLack) {
            ++shownByNewest_;
            continue;
        }
        if (rest_[i] > 0) {
            --rest_[i];
            continue;
        }
        const float kept = showed_[i] ? kRather : 1.0F;
        candidates_.push_back({kept * lack * measured[i].structure, tile});
    }
    if (static_cast<int>(candidates_.size()) > most) {
        const auto more = [](const Candidate& a, const Candidate& b) {
            return a.missing != b.missing ? a.missing > b.missing : a.tile < b.tile;
        };
        std::ranges::nth_element(candidates_, candidates_.begin() + most, more);
        candidates_.resize(static_cast<std::size_t>(most));
    }
    for (const Candidate& candidate : candidates_)
        work_.flags[static_cast<std::size_t>(candidate.tile)].matched = 1;
    work_.matched = static_cast<int>(candidates_.size());
    work_.noise = work.noise;
    return work_;
}

void SecondTiles::judge(const Match& newest, Rows<const WeighedCell> second) {
    for (const Candidate& candidate : candidates_) {
        const auto i = static_cast<std::size_t>(candidate.tile);
        const bool gained = gainOf(work_.tiles, candidate.tile, newest, second) >= kGain;
        showed_[i] = gained;
        rest_[i] = gained ? 0 : kRest;
        gained_ += gained ? 1 : 0;
    }
}

}  // namespace mfar
