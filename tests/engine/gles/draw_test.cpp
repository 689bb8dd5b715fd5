#include "pipeline/gles/still_reference.h"
#include "pipeline/superres/still_scale.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/tile_pass.h"
#include "tests/oracle/still.h"

#include <opencv2/imgproc.hpp>

#include <random>

namespace mfar {
namespace {

using Draw = GlTest;
using gpu::Filter;
using gpu::TexelFormat;

constexpr Size kSmallVideo{53, 37};  // 4x3 tiles, 14x10 cells
constexpr Size kOutput{191, 133};
constexpr Size kSmallStill{200, 140};
// Tolerances [grey levels]. onceRounded: for a result that is rounded once to 8 bits. twiceRounded:
// for a picture that is rounded after it is enlarged along columns, and again after rows. lookedUp:
// twiceRounded plus a bilinear look-up with weights of 8 bits and positions in half precision.

double onceRounded() {
    return 0.51 * roundingFactor();
}

double twiceRounded() {
    return onceRounded() * (1 + twin::kCubicGain);
}

double lookedUp() {
    return twiceRounded() + 1.2;
}

double worst(const twin::Grey& a, const twin::Grey& b) {
    EXPECT_EQ(a.size, b.size);
    double out = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        out = std::max(out, std::abs(a.values[i] - std::clamp(b.values[i], 0.0, 255.0)));
    return out;
}

gpu::Texture cellTexture(std::array<float, 4> value, TexelFormat format) {
    std::vector<float> values;
    for (int i = 0; i < 14 * 10; ++i)
        values.insert(values.end(), value.begin(), value.end());
    return floatTexture({14, 10}, format, values, Filter::Linear);
}

/// Weights as bytes. Red: half of the detail's weight. Blue: share of the video's variance that is
/// not noise.
gpu::Texture weights(std::uint8_t half, std::uint8_t signal) {
    TestPicture p({14, 10});
    for (std::size_t i = 0; i < p.bytes.size(); i += 4) {
        p.bytes[i] = half;
        p.bytes[i + 2] = signal;
    }
    return uploaded(p, Filter::Linear);
}

TEST_F(Draw, SharpeningMatchesTheOracle) {
    const TestPicture p = Waves(1, 4, 40, 30).shoot(kSmallVideo, {});
    TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    params.sharpening = 1;
    struct Case {
        std::uint8_t half, signal;
        double strength;
    };
    for (const Case& c : {Case{0, 255, 1}, Case{51, 255, 0.6}, Case{0, 102, 0.4}, Case{128, 255, 0},
                          Case{0, 0, 0}}) {
        const gpu::Texture w = weights(c.half, c.signal);
        const gpu::Texture out = drawn("superres_sharpen.frag", params,
                                       {gpu::sampler(0, uploaded(p)), gpu::sampler(1, w),
                                        gpu::sampler(2, w), gpu::sampler(3, w)},
                                       kSmallVideo);
        EXPECT_LE(worst(channelOf(out, 1), twin::sharpened(twin::luma(p.view()),
                                                           [&](int, int) { return c.strength; })),
                  onceRounded() + 0.01);
    }
}

TEST_F(Draw, SharpeningLeavesAConstantPictureUnchanged) {
    TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    params.sharpening = 1;
    for (const std::uint8_t level : {0, 1, 100, 254, 255}) {
        const TestPicture p(kSmallVideo, PixelFormat::Rgba8, level);
        const gpu::Texture w = weights(0, 255);
        const gpu::Texture out = drawn("superres_sharpen.frag", params,
                                       {gpu::sampler(0, uploaded(p)), gpu::sampler(1, w),
                                        gpu::sampler(2, w), gpu::sampler(3, w)},
                                       kSmallVideo);
        for (const double v : channelOf(out, 0).values)
            ASSERT_EQ(v, level);
    }
}

gpu::Texture columnsOf(const TestPicture& p, const TileParams& params) {
    return drawn("superres_vertical.frag", params, {gpu::sampler(0, uploaded(p))},
                 {kSmallVideo.width, kOutput.height});
}

TEST_F(Draw, EnlargementMatchesTheOracle) {
    const TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    for (const TestPicture& p : {randomPicture(kSmallVideo, 2), checkerboard(kSmallVideo),
                                 Waves(1, 5, 40, 40).shoot(kSmallVideo, {})}) {
        const gpu::Texture columns = columnsOf(p, params);
        const gpu::Texture out =
            drawn("composite_enlarge.frag", params, {gpu::sampler(0, columns)}, kOutput);
        for (int channel = 0; channel < 3; ++channel) {
            const twin::Grey in = twin::greyOf(kSmallVideo, [&](int x, int y) {
                return double(p.bytes[4UL * (1UL * y * kSmallVideo.width + x) + channel]);
            });
            const twin::Grey kept = channelOf(columns, channel);
            EXPECT_LE(worst(kept, twin::enlargedColumns(in, kOutput.height)), onceRounded());
            EXPECT_LE(worst(channelOf(out, channel), twin::enlargedRows(kept, kOutput.width)),
                      onceRounded());
        }
    }
}

TEST_F(Draw, EnlargementEqualsOpenCvsBicubic) {
    const TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    TestPicture p = Waves(1, 6, 40, 30).shoot(kSmallVideo, {});
    const gpu::Texture out =
        drawn("composite_enlarge.frag", params, {gpu::sampler(0, columnsOf(p, params))}, kOutput);
    cv::Mat peer;
    cv::resize(cv::Mat(kSmallVideo.height, kSmallVideo.width, CV_8UC4, p.bytes.data()), peer,
               {kOutput.width, kOutput.height}, 0, 0, cv::INTER_CUBIC);
    cv::Mat mine(kOutput.height, kOutput.width, CV_8UC4);
    const auto bytes = out.readRgba8();
    std::copy(bytes.begin(), bytes.end(), mine.data);
    EXPECT_LE(cv::norm(mine, peer, cv::NORM_INF), 1);
}

struct LookUp {
    double x, y;
    double weight, confidence;
};

double stillAt(const twin::Grey& still, int x, int y, const LookUp& l) {
    return still.bilinear((x + 0.5) * kSmallStill.width / kOutput.width + l.x - 0.5,
                          (y + 0.5) * kSmallStill.height / kOutput.height + l.y - 0.5);
}

gpu::Texture lookUpTexture(const LookUp& l) {
    return cellTexture({static_cast<float>(l.x), static_cast<float>(l.y),
                        static_cast<float>(l.weight), static_cast<float>(l.confidence)},
                       TexelFormat::Rgba16F);
}

/// The video in R G B. Alpha is the still, averaged over the video pixel.
gpu::Texture withStill(const TestPicture& video, const gpu::Texture& still, const LookUp& l) {
    return drawn("superres_sharpen.frag", tileParams(kSmallVideo, kSmallStill, kOutput),
                 {gpu::sampler(0, uploaded(video)), gpu::sampler(1, weights(0, 255)),
                  gpu::sampler(2, lookUpTexture(l)), gpu::sampler(3, still)},
                 kSmallVideo);
}

twin::Grey seen(const twin::Grey& still, const LookUp& l) {
    return twin::seen(kSmallVideo, [&](double x, double y) {
        return still.bilinear(x * kSmallStill.width / kSmallVideo.width + l.x - 0.5,
                              y * kSmallStill.height / kSmallVideo.height + l.y - 0.5);
    });
}

const std::vector<LookUp> kLookUps{
    {0, 0, 0, 1}, {0, 0, 1, 1}, {3.25, -5.5, 0.5, 1}, {-7.75, 2, 2.25, 0}, {-400, 900, 1, 0}};

TEST_F(Draw, AlphaOfAVideoPixelIsTheMeanOfTheStillOverThePixel) {
    const TestPicture video = Waves(2, 6, 40, 20).shoot(kSmallVideo, {});
    const TestPicture still =
        Waves(3, 8, 60, 20).shoot(kSmallStill, {.format = PixelFormat::Gray8});
    const gpu::Texture luma = uploaded(still, Filter::Linear);
    for (const LookUp& l : kLookUps) {
        const gpu::Texture out = withStill(video, luma, l);
        EXPECT_LE(worst(channelOf(out, 3), seen(twin::luma(still.view()), l)), onceRounded() + 0.4);
        EXPECT_LE(worst(channelOf(out, 0), twin::luma(video.view())), 0.01);
    }
}

TEST_F(Draw, DetailIsAddedInProportionToItsWeight) {
    const TestPicture video = Waves(2, 6, 40, 20).shoot(kSmallVideo, {});
    const TestPicture still =
        Waves(3, 8, 40, 20).shoot(kSmallStill, {.format = PixelFormat::Gray8});
    const gpu::Texture luma = uploaded(still, Filter::Linear);
    const TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    const twin::Grey up = twin::enlarged(twin::luma(video.view()), kOutput);
    const twin::Grey s = twin::luma(still.view());
    for (const LookUp& l : kLookUps) {
        const gpu::Texture columns =
            drawn("superres_vertical.frag", params, {gpu::sampler(0, withStill(video, luma, l))},
                  {kSmallVideo.width, kOutput.height});
        const gpu::Texture out = drawn(
            "composite_detail.frag", params,
            {gpu::sampler(0, columns), gpu::sampler(1, luma), gpu::sampler(2, lookUpTexture(l))},
            kOutput);
        const twin::Grey low = twin::enlarged(seen(s, l), kOutput);
        const twin::Grey wanted = twin::greyOf(kOutput, [&](int x, int y) {
            return up.at(x, y) + l.weight * (stillAt(s, x, y, l) - low.at(x, y));
        });
        // Tolerance: the mean is rounded, enlarged along columns and rounded again. The error of
        // the look-up is 1.2, as in lookedUp().
        EXPECT_LE(worst(channelOf(out, 0), wanted),
                  twiceRounded() + l.weight * (twiceRounded() + 1.2))
            << l.x;
    }
}

TEST_F(Draw, ModeBlendMixesVideoAndStillByConfidence) {
    const TestPicture p = Waves(2, 6, 40, 20).shoot(kSmallVideo, {});
    const TestPicture still = Waves(3, 8, 40, 30).shoot(kSmallStill, {});
    const TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    const gpu::Texture columns = columnsOf(p, params);
    const twin::Grey up = twin::enlarged(twin::luma(p.view()), kOutput);
    const twin::Grey s = twin::luma(still.view());
    for (const LookUp& l : {LookUp{0, 0, 1, 0}, LookUp{0, 0, 0, 1}, LookUp{3.25, -5.5, 0, 0.5}}) {
        const gpu::Texture look = lookUpTexture(l);
        const gpu::Texture out =
            drawn("composite_blend.frag", params,
                  {gpu::sampler(0, columns), gpu::sampler(1, uploaded(still, Filter::Linear)),
                   gpu::sampler(2, look)},
                  kOutput);
        const twin::Grey wanted = twin::greyOf(kOutput, [&](int x, int y) {
            return std::lerp(up.at(x, y), stillAt(s, x, y, l), l.confidence);
        });
        EXPECT_LE(worst(channelOf(out, 0), wanted), l.confidence > 0 ? lookedUp() : twiceRounded());
    }
}

gpu::Texture drawnByTiles(const char* shader, const char* defines, const TileParams& params,
                          gpu::Bindings bindings) {
    const std::uint32_t tiles = 4 * 3;
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < tiles; ++i)
        list.push_back(i % 4 | (i / 4) << 16);
    gpu::Buffer commands(16), instances(4 * tiles);
    const std::array<std::uint32_t, 4> command{6, tiles, 0, 0};
    commands.write(std::span<const std::uint32_t>(command));
    instances.write(std::span<const std::uint32_t>(list));
    gpu::Texture out(kOutput, TexelFormat::Rgba8);
    const gpu::Framebuffer target(out);
    gpu::DrawPass<TileParams> pass("tile_rect.vert", shader, defines);
    pass.runTiles(params, bindings, target, {commands, 0, instances, 0});
    return out;
}

TEST_F(Draw, TilesCoverThePictureWithoutSeams) {
    const TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    const gpu::Texture columns = columnsOf(randomPicture(kSmallVideo, 3), params);
    EXPECT_EQ(
        drawnByTiles("composite_enlarge.frag", "", params, {gpu::sampler(0, columns)}).readRgba8(),
        drawn("composite_enlarge.frag", params, {gpu::sampler(0, columns)}, kOutput).readRgba8());
}

TEST_F(Draw, LookUpsBetweenTileCornersGiveTheSamePictureAsLookUpsBetweenCells) {
    const TileParams params = tileParams(kSmallVideo, kSmallStill, kOutput);
    const gpu::Texture columns = columnsOf(Waves(2, 6, 40, 20).shoot(kSmallVideo, {}), params);
    const gpu::Texture still =
        uploaded(Waves(3, 10, 60, 30).shoot(kSmallStill, {}), Filter::Linear);
    const gpu::Texture look = cellTexture({2.5F, -3.25F, 0.75F, 0.5F}, TexelFormat::Rgba16F);
    for (const char* shader : {"composite_detail.frag", "composite_blend.frag"}) {
        const gpu::Bindings from{gpu::sampler(0, columns), gpu::sampler(1, still),
                                 gpu::sampler(2, look)};
        const gpu::Texture plain = drawnByTiles(shader, "#define PLAIN_TILE\n", params, from);
        EXPECT_LE(worst(channelOf(plain, 0), channelOf(drawn(shader, params, from, kOutput), 0)),
                  1);
    }
}

TEST_F(Draw, TheRaisedStillIsWithoutNoise) {
    constexpr double kNoise = 4;
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, kNoise);
    TestPicture still(kSmallStill);
    for (int y = 0; y < kSmallStill.height; ++y)
        for (int x = 0; x < kSmallStill.width; ++x)
            std::fill_n(still.at(x, y), 4,
                        static_cast<std::uint8_t>(90 + (x > y ? 40 : 0) + noise(random)));
    gpu::PictureTexture picture(gpu::Filter::Linear);
    StillTone darker;
    for (std::size_t i = 0; i < darker.levels.size(); ++i)
        darker.levels[i] = static_cast<std::uint8_t>(i / 2);
    for (const Size output : {kSmallStill, Size{100, 70}}) {
        StillReference reference(plainRig({50, 35}, kSmallStill), output, picture);
        reference.set(still.view(), darker, kNoise);
        const Size size = reference.rig().still.size;
        const bool isReduced = size != kSmallStill;
        twin::Grey luma = twin::greyOf(kSmallStill, [&](int x, int y) { return *still.at(x, y); });
        if (isReduced) luma = twin::reduced(luma, size);
        twin::Grey wanted = twin::quiet(luma, quietVariance(kNoise, kSmallStill, size));
        for (double& level : wanted.values)
            level /= 2;
        wanted = twin::raised(wanted, isReduced ? 0 : kLinearLoss);
        EXPECT_LE(worst(channelOf(reference.raised(), 0), wanted), 2);
    }
}

TEST_F(Draw, AConstantStillStaysConstant) {
    gpu::PictureTexture picture(gpu::Filter::Linear);
    for (const Size output : {kSmallStill, Size{100, 70}}) {
        StillReference reference(plainRig({50, 35}, kSmallStill), output, picture);
        for (const std::uint8_t level : {0, 90, 255}) {
            reference.set(TestPicture(kSmallStill, PixelFormat::Rgba8, level).view());
            for (const double v : channelOf(reference.raised(), 0).values)
                ASSERT_EQ(v, level);
        }
    }
}

}  // namespace
}  // namespace mfar
