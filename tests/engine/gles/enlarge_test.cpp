#include "pipeline/gles/learned_enlarger.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/tile_pass.h"
#include "tests/oracle/learned.h"

#include <cmath>
#include <random>

namespace mfar {
namespace {

using Enlarge = GlTest;
using twin::Grey;

const std::vector<Size> kSizes{{1, 1}, {3, 5}, {16, 9}, {33, 12}, {97, 41}};

TestPicture texturedPicture(Size size, unsigned seed) {
    std::mt19937 random(seed);
    TestPicture out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double wave = 80 * std::sin(0.31 * x + 0.17 * y) +
                                60 * std::sin(0.05 * x * y / 7.0 - 0.4 * y) +
                                (x * 3 + y * 5 > 150 ? 60 : 0);
            const int grain = static_cast<int>(random() % 13) - 6;
            const int grey = std::clamp(static_cast<int>(120 + 0.6 * wave) + grain, 0, 255);
            std::fill_n(out.at(x, y), 3, static_cast<std::uint8_t>(grey));
        }
    return out;
}

FilterBank randomBank(int most, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<FilterBank::Filter> unique(enlarge::kUnique);
    for (FilterBank::Filter& filter : unique)
        for (std::int16_t& weight : filter)
            weight = static_cast<std::int16_t>(static_cast<int>(random() % (2 * most + 1)) - most);
    return FilterBank(unique);
}

struct NoTiles {
    gpu::Buffer commands{16}, tiles{4};
    [[nodiscard]] gpu::InstanceList list() const { return {commands, 0, tiles}; }
};

std::vector<std::array<GLint, 4>> integersOf(const gpu::Texture& texture) {
    const auto [width, height] = texture.size();
    std::vector<std::array<GLint, 4>> out(static_cast<std::size_t>(width) * height);
    const gpu::Framebuffer target(texture);
    target.bind();
    glReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_INT, out.data());
    return out;
}

/// The residual that the shaders compute [grey levels]: what the learned filters add to Keys'
/// cubic. It has 4x4 values (sub-pixels) for each video pixel.
Grey residualOf(const TestPicture& picture, const FilterBank& bank, const TileWork& work) {
    const Size video = picture.size;
    const Size output{enlarge::kGrid * video.width, enlarge::kGrid * video.height};
    LearnedEnlarger enlarger(video, output);
    TileBuffer tiles(video);
    tiles.set(work);
    const NoTiles none;
    enlarger.run(uploaded(picture), nullptr, tiles, bank, tileParams(video, video, output),
                 none.list());
    const auto texels = integersOf(enlarger.residuals());
    return twin::greyOf(output, [&](int x, int y) {
        const auto at = static_cast<std::size_t>(y) * video.width + x / enlarge::kGrid;
        return texels[at][static_cast<std::size_t>(x % enlarge::kGrid)] /
               static_cast<double>(params::kPassScale);
    });
}

/// `pixels` is the number of compared pixels. `all` also counts pixels near the border between two
/// classes. These are not compared, because rounding to single precision decides their class.
struct Compared {
    int pixels = 0, all = 0;
};

void expectResidual(const Grey& residual, const Grey& luma, int x, int y, const FilterBank& bank,
                    Compared& compared) {
    const auto gradient = twin::gradientClass(luma, x, y),
               curvature = twin::curvatureClass(luma, x, y);
    ++compared.all;
    if (!(gradient.margin > 1e-3 && curvature.margin > 1e-3)) return;
    ++compared.pixels;
    for (int phase = 0; phase < enlarge::kPhases; ++phase)
        // Tolerance [grey levels]: the residual's limit is rounded to whole eighths of a grey
        // level, and filter weights have eleven bits.
        ASSERT_NEAR(residual.at(4 * x + phase % 4, 4 * y + phase / 4),
                    twin::residualAt(luma, x, y, phase, gradient.number, curvature.number, bank),
                    0.32)
            << luma.size.width << ": " << x << " " << y << " " << phase;
}

TEST_F(Enlarge, ResidualMatchesTheOracleWhereRoundingDoesNotDecideTheClass) {
    for (const int most : {500, 8000}) {
        const FilterBank bank = randomBank(most, 11);
        Compared compared;
        for (const Size size : kSizes) {
            const TestPicture picture = texturedPicture(size, 7);
            const Grey luma = twin::luma(picture.view());
            const Grey residual = residualOf(picture, bank, TileWork::everything(tilesOf(size)));
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    ASSERT_NO_FATAL_FAILURE(expectResidual(residual, luma, x, y, bank, compared));
        }
        EXPECT_GT(compared.pixels, compared.all * 0.6);
    }
}

TEST_F(Enlarge, ResidualOfWavesOfEveryAngleAndContrastMatchesTheOracle) {
    const FilterBank bank = randomBank(2000, 13);
    const Size size{40, 40};
    std::vector<bool> met(enlarge::GradientClasses::kCount);
    Compared compared;
    for (int angle = 0; angle < 16; ++angle)
        for (const double strength : {1.5, 4.0, 12.0, 40.0, 100.0}) {
            const double a = angle * std::numbers::pi / 16 + 0.01;
            TestPicture picture(size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const double u = std::cos(a) * x + std::sin(a) * y,
                                 v = std::cos(a) * y - std::sin(a) * x;
                    const double grey =
                        127 + strength * (std::sin(0.7 * u) + y / 40.0 * std::sin(0.6 * v));
                    std::fill_n(picture.at(x, y), 3,
                                static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0)));
                }
            const Grey luma = twin::luma(picture.view());
            const Grey residual = residualOf(picture, bank, TileWork::everything(tilesOf(size)));
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    met.at(static_cast<std::size_t>(twin::gradientClass(luma, x, y).number)) = true;
                    ASSERT_NO_FATAL_FAILURE(expectResidual(residual, luma, x, y, bank, compared));
                }
        }
    EXPECT_GT(std::ranges::count(met, true), enlarge::GradientClasses::kCount * 8 / 10);
    EXPECT_GT(compared.pixels, compared.all * 0.5);
}

TEST_F(Enlarge, FlatPicturesStayFlat) {
    const FilterBank bank = randomBank(8000, 17);
    for (const std::uint8_t level : {0, 1, 100, 255}) {
        const TestPicture picture({33, 20}, PixelFormat::Rgba8, level);
        for (const double value :
             residualOf(picture, bank, TileWork::everything(tilesOf(picture.size))).values)
            ASSERT_EQ(value, 0);
    }
}

}  // namespace
}  // namespace mfar
