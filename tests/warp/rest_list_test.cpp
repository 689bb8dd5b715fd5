#include "base/gl/pass.h"
#include "pipeline/composite/pass_values.h"
#include "pipeline/gles/hole_filler.h"
#include "tests/engine/gl_test.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace mfar {
namespace {

using WarpRestListGl = GlTest;
using Command = HoleFiller::Command;

struct Listed {
    Command command;
    std::vector<std::uint32_t> pixels;  ///< sorted
};

/// Lists all pixels of a layer of this size.
Listed listedIn(Size size) {
    const std::size_t pixels = static_cast<std::size_t>(size.width) * size.height;
    gpu::Texture state(size, gpu::TexelFormat::Rgba8);
    const std::vector<std::array<std::uint8_t, 4>> left(pixels, {0, 255, 0, 0});
    state.uploadRows(left);
    gpu::Buffer commands(sizeof(Command)), list(sizeof(std::uint32_t) * pixels);
    commands.write(std::span(&HoleFiller::kEmptyList, 1));
    params::LookUpViews p{};
    p.bounds = boundsOf(PixelRect{0, 0, size.width, size.height});
    p.width = size.width;
    p.height = size.height;
    gpu::ComputePass<params::LookUpViews>("warp_rest_list.comp")
        .run(
            p, {gpu::sampler(0, state), gpu::storage(0, commands), gpu::storage(1, list)},
            {gpu::groupsFor((size.width + 1) / 2, 8), gpu::groupsFor((size.height + 1) / 2, 8), 1});
    Listed out{commands.read<Command>(1)[0], list.read<std::uint32_t>(pixels)};
    std::ranges::sort(out.pixels);
    return out;
}

TEST_F(WarpRestListGl, ACommandHasAtMostTheWorkgroupsThatOpenGlEsGuarantees) {
    constexpr std::uint32_t kMost = 65535;
    for (const Size size : {Size{5, 3}, {32, 32}, {41, 25}, {2100, 2000}}) {
        const auto pixels = static_cast<std::uint32_t>(size.width * size.height);
        const Listed got = listedIn(size);
        EXPECT_EQ(got.command.count, pixels);
        EXPECT_LE(got.command.x, kMost);
        EXPECT_LE(got.command.y, kMost);
        EXPECT_EQ(got.command.z, 1U);
        EXPECT_GE(64 * got.command.x * got.command.y, pixels) << "entries are left";
        EXPECT_LT(64 * got.command.x * got.command.y, pixels + params::kListRow);
        std::vector<std::uint32_t> all(pixels);
        std::iota(all.begin(), all.end(), 0U);
        EXPECT_EQ(got.pixels, all);
    }
}

}  // namespace
}  // namespace mfar
