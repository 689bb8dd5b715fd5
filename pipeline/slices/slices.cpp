#include "pipeline/slices/slices.h"

#include "pipeline/render/sampling_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

using sampling::evenlySpread, sampling::mortonCode, sampling::kTileEdge, sampling::kTilePixels;

// The turns of Slicing::Time are numbered from 1. In turn kLook, one ray is traced through each
// pixel's centre. The turns between kLook and kFirstFull sample only some pixels. From turn
// kFirstFull on, all pixels are sampled.
constexpr int kLook = 1, kFirstFull = 4;

int gathered(std::uint32_t v) {
    v &= 0x55555555;
    v = (v | v >> 1) & 0x33333333;
    v = (v | v >> 2) & 0x0f0f0f0f;
    v = (v | v >> 4) & 0x00ff00ff;
    return static_cast<int>((v | v >> 8) & 0x0000ffff);
}

std::uint32_t rankOf(std::uint32_t pixel, int width) {
    const auto x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    return sampling::rankOf(x % kTileEdge, y % kTileEdge);
}

}  // namespace

Slices::Slices(const SliceOptions& options) : options_(options) {
    if (options.samples < 1 || options.samplesPerTurn < 1 || options.leastSamples < 2)
        throw std::invalid_argument("path tracer: samples and samplesPerTurn must be at least 1, "
                                    "and leastSamples at least 2");
    if (!(options.threshold >= 0))
        throw std::invalid_argument("path tracer: the error threshold must not be negative");
}

void Slices::begin(const PixelRect& bounds, Size picture,
                   const std::function<Density(const PixelRect&)>& densityOf) {
    const PixelRect r = common(bounds, {0, 0, picture.width, picture.height});
    width_ = picture.width;
    pixels_.clear();
    tiles_.clear();
    open_.clear();
    order_.clear();
    cursor_ = 0;
    samples_ = turn_ = 0;
    traced_ = settled_ = 0;
    unfinished_ = ofTurn_ = 0;
    if (r.empty()) return;
    for (int row = r.y0 / kTileEdge; row * kTileEdge < r.y1; ++row)
        for (int column = r.x0 / kTileEdge; column * kTileEdge < r.x1; ++column)
            order_.push_back(mortonCode(column, row));
    std::sort(order_.begin(), order_.end());
    for (const std::uint32_t code : order_) {
        const int x = kTileEdge * gathered(code), y = kTileEdge * gathered(code >> 1);
        const PixelRect tile = common({x, y, x + kTileEdge, y + kTileEdge}, r);
        const Density density = densityOf ? densityOf(tile) : Density::Full;
        if (density != Density::None) addTile(tile, density);
    }
    unfinished_ = tiles_.size();
}

void Slices::addTile(const PixelRect& pixels, Density density) {
    Tile tile;
    tile.first = static_cast<std::uint32_t>(pixels_.size());
    const int left = pixels.x0 - pixels.x0 % kTileEdge, top = pixels.y0 - pixels.y0 % kTileEdge;
    // Ranks below kTilePixels / 4 belong to the pixels with even column and even row.
    const std::uint32_t ranks = density == Density::Full ? kTilePixels : kTilePixels / 4;
    for (std::uint32_t rank = 0; rank < ranks; ++rank) {
        const std::uint32_t code = evenlySpread(rank);
        const int x = left + gathered(code), y = top + gathered(code >> 1);
        if (x >= pixels.x0 && x < pixels.x1 && y >= pixels.y0 && y < pixels.y1)
            pixels_.push_back(static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_) +
                              static_cast<std::uint32_t>(x));
    }
    tile.count = tile.active = static_cast<std::uint32_t>(pixels_.size()) - tile.first;
    if (tile.count > 0) tiles_.push_back(tile);
}

Slice Slices::next(std::int64_t mostSamples) {
    if (finished()) return {};
    while (turnComplete())
        beginTurn();
    return options_.slicing == Slicing::Time ? nextOfTurn(mostSamples) : nextOfTiles(mostSamples);
}

bool Slices::looks() const {
    return options_.slicing == Slicing::Time && turn_ == kLook;
}

void Slices::beginTurn() {
    ++turn_;
    ofTurn_ = unfinished_;
    cursor_ = 0;
    for (Tile& tile : tiles_) {
        if (tile.active == 0) continue;
        tile.most = mostOfTurn(tile);
        // The tile has no pixels to sample in this turn, so the turn does not wait for it.
        if (tile.handed >= tile.most) --ofTurn_;
    }
    if (ofTurn_ == 0) samples_ = samplesOfTurn();
}

int Slices::samplesOfTurn() const {
    if (options_.slicing == Slicing::Spatial) return options_.samples;
    return std::min(std::max(turn_ - kFirstFull + 1, 0) * options_.samplesPerTurn,
                    options_.samples);
}

std::uint32_t Slices::mostOfTurn(const Tile& tile) const {
    const bool isSparse = options_.slicing == Slicing::Time && turn_ > kLook && turn_ < kFirstFull;
    if (!isSparse) return tile.active;
    const std::uint32_t most = turn_ == kLook + 1 ? kTilePixels / 16 : kTilePixels / 4;
    std::uint32_t out = 0;
    while (out < tile.active && rankOf(pixels_[tile.first + out], width_) < most)
        ++out;
    return out;
}

Slice Slices::nextOfTurn(std::int64_t mostSamples) {
    for (; cursor_ < tiles_.size(); ++cursor_) {
        const Tile& tile = tiles_[cursor_];
        if (tile.handed < tile.most) return part(cursor_, mostSamples);
    }
    return {};
}

Slice Slices::nextOfTiles(std::int64_t mostSamples) {
    for (const std::uint32_t tile : open_)
        if (tiles_[tile].handed < tiles_[tile].most) return part(tile, mostSamples);
    if (cursor_ == tiles_.size()) return {};
    open_.push_back(cursor_);
    return part(cursor_++, mostSamples);
}

int Slices::step(const Tile& tile) const {
    return looks() ? 0 : std::min(options_.samplesPerTurn, options_.samples - tile.samples);
}

Slice Slices::part(std::uint32_t index, std::int64_t mostSamples) {
    Tile& tile = tiles_[index];
    const std::int64_t most = std::max<std::int64_t>(mostSamples / std::max(step(tile), 1), 1);
    const auto count =
        static_cast<std::uint32_t>(std::min<std::int64_t>(most, tile.most - tile.handed));
    const std::span pixels(pixels_.data() + tile.first + tile.handed, count);
    tile.handed += count;
    ++tile.out;
    return {pixels, step(tile), index};
}

void Slices::done(const Slice& slice, const PixelStates& states) {
    Tile& tile = tiles_[slice.tile];
    traced_ += slice.pixels.size() * static_cast<std::uint64_t>(slice.samples);
    --tile.out;
    if (tile.out == 0 && tile.handed == tile.most) endRound(tile, states);
}

void Slices::endRound(Tile& tile, const PixelStates& states) {
    const bool time = options_.slicing == Slicing::Time;
    const bool adapts = options_.threshold > 0;
    std::uint32_t kept = tile.active;
    if (time && turn_ == kLook) {
        if (adapts) kept = keepNoisy(tile, states);
        tile.handed = 0;
    } else if (tile.handed < tile.active) {
        if (adapts && turn_ + 1 == kFirstFull && isUntouched(tile, states)) {
            kept = 0;
            // dropActive() counts all samples of the tile as not needed. The samples that were
            // already traced are subtracted here.
            settled_ -= tile.handed * static_cast<std::uint64_t>(step(tile));
        }
    } else {
        tile.samples += step(tile);
        tile.handed = 0;
        if (tile.samples == options_.samples)
            kept = 0;
        else if (adapts)
            kept = keepNoisy(tile, states);
    }
    dropActive(tile, kept);
    // In Slicing::Spatial, tiles do not wait for each other.
    if (!time && tile.active > 0) {
        tile.most = tile.active;
        return;
    }
    tile.most = tile.handed;
    if (--ofTurn_ == 0) samples_ = samplesOfTurn();
}

void Slices::dropActive(Tile& tile, std::uint32_t kept) {
    settled_ += (tile.active - kept) * static_cast<std::uint64_t>(options_.samples - tile.samples);
    tile.active = kept;
    if (kept > 0) return;
    --unfinished_;
    std::erase(open_, static_cast<std::uint32_t>(&tile - tiles_.data()));
}

bool Slices::isUntouched(const Tile& tile, const PixelStates& states) const {
    for (std::uint32_t i = 0; i < tile.count; ++i)
        if (!states(pixels_[tile.first + i]).untouched) return false;
    return true;
}

std::uint32_t Slices::keepNoisy(Tile& tile, const PixelStates& states) {
    // A border of one pixel around the tile, where `noisy` stays false, avoids range checks below.
    constexpr int kRow = kTileEdge + 2;
    std::array<bool, kRow * kRow> noisy{};
    const auto placeOf = [&](std::uint32_t pixel) {
        const std::uint32_t x = pixel % static_cast<std::uint32_t>(width_);
        const std::uint32_t y = pixel / static_cast<std::uint32_t>(width_);
        return (y % kTileEdge + 1) * kRow + x % kTileEdge + 1;
    };
    const auto least = static_cast<float>(options_.leastSamples);
    for (std::uint32_t i = 0; i < tile.count; ++i) {
        const std::uint32_t pixel = pixels_[tile.first + i];
        const PixelState state = states(pixel);
        noisy[placeOf(pixel)] = !(state.samples >= least && state.error < options_.threshold);
    }
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < tile.active; ++i) {
        const std::uint32_t pixel = pixels_[tile.first + i], at = placeOf(pixel);
        const auto rowNoisy = [&](std::uint32_t p) {
            return noisy[p - 1] || noisy[p] || noisy[p + 1];
        };
        if (rowNoisy(at - kRow) || rowNoisy(at) || rowNoisy(at + kRow))
            std::swap(pixels_[tile.first + i], pixels_[tile.first + kept++]);
    }
    return kept;
}

bool Slices::turnComplete() const {
    return ofTurn_ == 0;
}

double Slices::progress() const {
    if (pixels_.empty()) return 1;
    const double most = static_cast<double>(pixels_.size()) * options_.samples;
    return static_cast<double>(traced_ + settled_) / most;
}

}  // namespace mfar
