#include "pipeline/gles/hole_filler.h"

#include "pipeline/composite/pass_values.h"

#include <algorithm>
#include <span>

namespace mfar {
namespace {

constexpr int kPullGroup = 8;  // width and height of a workgroup in warp_pull.comp
constexpr std::uint32_t kOpen = 1U << 31, kCrack = 1U << 30;

using Command = HoleFiller::Command;

int halved(int pixels) {
    return (pixels + 1) / 2;
}

std::size_t mostTexels(Size size) {
    std::size_t sum = 0;
    for (int l = 0; l < HoleFiller::kLevels; ++l) {
        // One more than half the size, because a rectangle can begin at an odd coordinate.
        size = {halved(size.width) + 1, halved(size.height) + 1};
        sum += static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    }
    return sum;
}

}  // namespace

HoleFiller::HoleFiller(Size layer)
    : layer_(layer), pyramid_(sizeof(Command) * mostTexels(layer)),
      first_("warp_pull.comp", "#define FIRST_LEVEL\n"), pull_("warp_pull.comp"),
      fill_("warp_fill.comp") {
    const auto pixels = static_cast<std::size_t>(layer.width) * layer.height;
    for (Lists& lists : lists_)
        lists = {gpu::Buffer(sizeof(Command) * (1 + kLevels)),
                 gpu::Buffer(2 * sizeof(std::uint32_t) * pixels)};
}

void HoleFiller::begin(const PixelRect& where, HoleFilling filling) {
    std::array<Command, 1 + kLevels> none{};
    for (Command& command : none)
        command = {0, 1, 1, 0};
    none[0] = kEmptyList;
    lists_[current_].commands.write(std::span<const Command>(none));
    params_ = {};
    params_.bounds = boundsOf(where);
    params_.width = layer_.width;
    params_.fillsObjects = pushPulls(filling) ? 1 : 0;
    params_.fillsCatcher = fillsShadows(filling) ? 1 : 0;
    params_.levelCount = fillsShadows(filling) ? kLevels : params::kCrackLevels;
    PixelRect r = where;
    int end = 0;
    for (int l = 0; l < levels(); ++l) {
        r = {r.x0 / 2, r.y0 / 2, halved(r.x1), halved(r.y1)};
        const int columns = r.x1 - r.x0, rows = r.y1 - r.y0;
        params_.levels[l] = {end, columns, r.x0, r.y0};
        rows_[l] = rows;
        end += columns * rows;
        wanted_[l] = {gpu::groupsFor(columns, kPullGroup), gpu::groupsFor(rows, kPullGroup), 1, 0};
    }
    params_.texels = end;
}

void HoleFiller::pull(const gpu::Texture& colour, const gpu::Texture& state) {
    params::FillHoles p = params_;
    for (int l = 1; l <= levels(); ++l) {
        p.level = l;
        p.rows = rows_[l - 1];
        p.rowsBelow = l > 1 ? rows_[l - 2] : 0;
        const std::size_t offset = sizeof(Command) * l;
        if (l == 1)
            first_.runIndirect(
                p, {gpu::sampler(0, colour), gpu::sampler(1, state), gpu::storage(0, pyramid_)},
                commands(), offset);
        else
            pull_.runIndirect(p, {gpu::storage(0, pyramid_)}, commands(), offset);
    }
}

void HoleFiller::fill(const gpu::Texture& colour, const gpu::Texture& state, bool wantList) {
    pull(colour, state);
    fill_.runIndirect(params_,
                      {gpu::sampler(0, state), gpu::imageWrite(0, colour),
                       gpu::storage(0, commands()), gpu::storage(1, entries()),
                       gpu::storage(2, pyramid_)},
                      commands(), 0);
    if (!wantList || fence_) return;
    fence_.emplace();
    current_ = 1 - current_;
}

std::optional<WarpHoles> HoleFiller::poll() {
    if (!fence_ || !fence_->passed()) return {};
    fence_.reset();
    WarpHoles out;
    const Lists& lists = lists_[1 - current_];
    const std::size_t listed = lists.commands.read<Command>(1)[0].count;
    if (listed == 0) return out;
    for (const auto& [pixel, colour] : lists.entries.read<std::array<std::uint32_t, 2>>(listed)) {
        if ((pixel & kCrack) != 0)
            ++out.cracks;
        else if ((pixel & kOpen) != 0)
            out.open.push_back(pixel & ~kOpen);
    }
    std::ranges::sort(out.open);
    return out;
}

}  // namespace mfar
