#include "pipeline/gles/edge_refiner.h"

#include "pipeline/composite/pass_values.h"

#include <algorithm>
#include <bit>
#include <span>

namespace mfar {
namespace {

constexpr int kEdgeGroup = 8;      // width and height of a workgroup in warp_edges.comp
constexpr int kSharpenGroup = 64;  // size of a workgroup in warp_sharpen.comp
constexpr int kLeastContrast = 3;  // lowest listed contrast level; below it, blur is invisible
constexpr std::size_t kListedAt = EdgeRefiner::kLevels + 1;

}  // namespace

EdgeRefiner::EdgeRefiner(Size layer, double share, int most, int fadeFrames)
    : layer_(layer), share_(share), step_(fadeFrames > 0 ? 1.0 / fadeFrames : 1), most_(most),
      counts_(sizeof(std::uint32_t) * (kListedAt + 1)),
      list_(2 * sizeof(std::uint32_t) * layer.width * layer.height),
      entries_(sizeof(Entry) * static_cast<std::size_t>(most)),
      count_("warp_edges.comp", "#define COUNT\n"), choose_("warp_edges.comp"),
      sharpen_("warp_sharpen.comp") {}

void EdgeRefiner::drop() {
    fence_.reset();
    listed_.clear();
    shown_ = 0;
}

void EdgeRefiner::list(const gpu::Texture& colour, const gpu::Texture& state,
                       const PixelRect& where) {
    drop();
    params_ = {.bounds = boundsOf(where),
               .width = layer_.width,
               .shown = 0,
               .leastContrast = kLeastContrast,
               .mostListed = most_,
               .renderedShare = 0,
               .listedShare = static_cast<float>(share_)};
    constexpr std::array<std::uint32_t, kListedAt + 1> kNone{};
    counts_.write(std::span<const std::uint32_t>(kNone));
    const gpu::Groups groups{gpu::groupsFor(where.x1 - where.x0, kEdgeGroup),
                             gpu::groupsFor(where.y1 - where.y0, kEdgeGroup), 1};
    count_.run(params_, {gpu::sampler(0, colour), gpu::sampler(1, state), gpu::storage(0, counts_)},
               groups);
    choose_.run(params_,
                {gpu::sampler(0, colour), gpu::sampler(1, state), gpu::storage(0, counts_),
                 gpu::storage(1, list_)},
                groups);
    fence_.emplace();
}

std::optional<std::vector<std::uint32_t>> EdgeRefiner::poll() {
    if (!fence_ || !fence_->passed()) return {};
    fence_.reset();
    std::vector<std::uint32_t> out;
    const auto count = counts_.read<std::uint32_t>(1, sizeof(std::uint32_t) * kListedAt)[0];
    if (count == 0) return out;
    listed_ = list_.read<std::array<std::uint32_t, 2>>(count);
    std::ranges::sort(listed_);
    for (const auto& [pixel, colour] : listed_)
        out.push_back(pixel);
    return out;
}

void EdgeRefiner::answer(const HoleAnswer& answer) {
    std::vector<Entry> entries;
    auto before = listed_.begin();
    for (std::size_t i = 0; i < answer.pixels.size(); ++i) {
        const std::uint32_t pixel = answer.pixels[i];
        while (before != listed_.end() && (*before)[0] < pixel)
            ++before;
        if (before == listed_.end() || (*before)[0] != pixel) continue;
        if (entries.size() == static_cast<std::size_t>(most_)) break;
        entries.push_back({pixel, (*before)[1], std::bit_cast<std::uint32_t>(answer.colour[i]), 0});
    }
    params_.shown = static_cast<std::int32_t>(entries.size());
    if (entries.empty()) return;
    entries_.write(std::span<const Entry>(entries));
    shown_ = step_;
}

void EdgeRefiner::show(const gpu::Texture& colour) {
    if (shown_ == 0) return;
    params_.renderedShare = static_cast<float>(shown_);
    sharpen_.run(params_, {gpu::imageWrite(0, colour), gpu::storage(0, entries_)},
                 {gpu::groupsFor(params_.shown, kSharpenGroup), 1, 1});
    shown_ = std::min(1.0, shown_ + step_);
}

}  // namespace mfar
