#include "base/workers.h"
#include "pipeline/engine/engine.h"
#include "pipeline/enlarge/filter_bank.h"
#include "tests/engine/engine_name.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/still.h"

namespace mfar {
namespace {

// Tolerance: half a grey level, plus rounding errors of single precision.
constexpr double kToABit = 0.501;

class StepsTest : public GlTest, public testing::WithParamInterface<EngineKind> {
protected:
    static std::unique_ptr<Engine> engineFor(const StereoRig& rig, Size output = {64, 48}) {
        const StepSetup setup{rig, output, {}, std::make_shared<Workers>(2)};
        return GetParam() == EngineKind::Gles ? makeGlesEngine(setup) : makeSimdEngine(setup);
    }
    static bool isGles() { return GetParam() == EngineKind::Gles; }
};
INSTANTIATE_TEST_SUITE_P(Engines, StepsTest, testing::Values(EngineKind::Gles, EngineKind::Simd),
                         engineOfTest);

TileWork everything(Size video) {
    TileWork work;
    work.tiles = tilesOf(video);
    const int count = work.tiles.width * work.tiles.height;
    work.flags.assign(static_cast<std::size_t>(count), {1, 1});
    work.changed = work.matched = count;
    return work;
}

/// Reads a pyramid level from memory. Checks that the level's margin repeats the border.
twin::Grey levelOf(const LumaPyramid& pyramid, const LumaLevel& level) {
    const std::uint32_t* words = pyramid.words.host().data + level.offset;
    const auto stored = [&](int x, int y) {  // the stored columns begin at x = -8
        const std::uint32_t word =
            words[static_cast<std::ptrdiff_t>(y) * level.pitch + (x + 8) / 4];
        return static_cast<double>((word >> (8 * (x & 3))) & 255U);
    };
    twin::Grey out = twin::greyOf({level.width, level.height}, stored);
    for (int y = 0; y < level.height; ++y)
        for (int x = -8; x < 4 * level.pitch - 8; ++x)
            if (stored(x, y) != out.at(x, y)) {
                ADD_FAILURE() << "the margin does not repeat the border at " << x << ", " << y;
                return out;
            }
    return out;
}

double worstOf(const twin::Grey& got, const twin::Grey& wanted) {
    EXPECT_EQ(got.size, wanted.size);
    double out = 0;
    for (std::size_t i = 0; i < got.values.size(); ++i)
        out = std::max(out, std::abs(got.values[i] - wanted.values[i]));
    return out;
}

TEST_P(StepsTest, VideoPyramidIsSmoothedAndHalved) {
    for (const Size size : {Size{64, 48}, Size{101, 59}, Size{213, 119}})
        for (const PixelFormat format : {PixelFormat::Rgba8, PixelFormat::Gray8}) {
            const TestPicture picture = randomPicture(size, 1, format);
            const auto engine = engineFor(plainRig(size, size));
            const auto step = engine->pyramid();
            const RgbPlanes planes = planesOf(picture);
            const ImageView view = picture.view();
            const LumaPyramid& pyramid = step->video({view, planes, 1}, everything(size));
            twin::Grey finer = levelOf(pyramid, pyramid.video[0]);
            EXPECT_LE(worstOf(finer, twin::smoothed(twin::luma(view))), isGles() ? kToABit : 1);
            for (std::size_t i = 1; i < pyramid.video.size(); ++i) {
                const twin::Grey coarser = levelOf(pyramid, pyramid.video[i]);
                EXPECT_EQ(worstOf(coarser, twin::halved(finer)), 0) << "level " << i;
                finer = coarser;
            }
        }
}

TEST_P(StepsTest, StillPyramidIsResampledToPixelsOfTheVideo) {
    for (const StereoRig& rig : {plainRig({96, 72}, {345, 259}), plainRig({96, 72}, {96, 72}),
                                 bentRig({97, 71}, {350, 256})}) {
        const TestPicture still = Waves(3, 12, 200, 40).shoot(rig.still.size, {});
        const auto engine = engineFor(rig, rig.still.size);
        const auto prepare = engine->still();
        const StillPictures& pictures = prepare->run(still.view(), SuperResMode::Detail, {}, 0);
        const auto step = engine->pyramid();
        for (const float light : {0.0F, 0.8F, Guidance::kMost}) {
            const LumaPyramid& pyramid = step->still(pictures, light);
            // Tolerance: the shaders' filter has weights of 8 bits; the kernels filter rounded
            // luma.
            EXPECT_LE(worstOf(levelOf(pyramid, pyramid.still[0]),
                              twin::lumaFromStill(twin::luma(still.view()), rig, light)),
                      kToABit + 1);
        }
    }
}

TEST_P(StepsTest, PyramidsKeepBlackAndWhite) {
    const Size size{70, 60};
    for (const std::uint8_t fill : {0, 255}) {
        const TestPicture flat(size, PixelFormat::Rgba8, fill);
        const auto engine = engineFor(plainRig(size, size));
        const auto step = engine->pyramid();
        const RgbPlanes planes = planesOf(flat);
        const ImageView view = flat.view();
        const LumaPyramid& pyramid = step->video({view, planes, 1}, everything(size));
        for (const LumaLevel& level : pyramid.video)
            for (const double value : levelOf(pyramid, level).values)
                ASSERT_EQ(value, fill);
    }
}

twin::Grey raisedOf(const StillPictures& still) {
    EXPECT_NE(still.raised.isEmpty(), still.pairs.isEmpty());
    if (still.pairs.isEmpty()) {
        const Rows<const std::uint8_t> raised = still.raised.host();
        return twin::greyOf(raised.size, [&](int x, int y) { return double(raised[y][x]); });
    }
    const Rows<const std::uint16_t> pairs = still.pairs.host();
    return twin::greyOf(pairs.size, [&](int x, int y) { return double(pairs[y][x] & 255); });
}

TEST_P(StepsTest, FinestDetailOfTheStillIsAmplifiedUnlessTheStillIsReduced) {
    const StereoRig rig = plainRig({50, 35}, {200, 140});
    for (const auto& [output, share] : {std::pair{Size{200, 140}, 0.08}, {Size{100, 70}, 0.0}})
        for (const PixelFormat format : {PixelFormat::Rgba8, PixelFormat::Gray8}) {
            const TestPicture still = Waves(5, 4, 60, 30).shoot(rig.still.size, {.format = format});
            const auto engine = engineFor(rig, output);
            const auto step = engine->still();
            const StillPictures& made = step->run(still.view(), SuperResMode::Detail, {}, 0);
            twin::Grey luma = twin::luma(still.view());
            if (share == 0) luma = twin::reduced(luma, made.rig.still.size);
            EXPECT_LE(worstOf(raisedOf(made), twin::raised(luma, share)), 1.6) << share;
        }
}

TEST_P(StepsTest, LumaOfAStillIsCorrectInEveryPixelFormat) {
    const StereoRig rig = plainRig({50, 35}, {200, 140});
    for (const PixelFormat format : {PixelFormat::Rgba8, PixelFormat::Bgra8, PixelFormat::Gray8}) {
        const bool isGrey = format == PixelFormat::Gray8;
        TestPicture still = randomPicture(rig.still.size, 3, isGrey ? format : PixelFormat::Rgba8);
        const twin::Grey wanted = twin::luma(still.view());
        if (format == PixelFormat::Bgra8)
            for (std::size_t i = 0; i < still.bytes.size(); i += 4)
                std::swap(still.bytes[i], still.bytes[i + 2]);
        ImageView view = still.view();
        view.format = format;
        const auto engine = engineFor(rig, rig.still.size);
        const auto step = engine->still();
        const Rows<const std::uint8_t> luma =
            step->run(view, SuperResMode::Detail, {}, 0).luma.host();
        EXPECT_LE(worstOf(twin::greyOf(luma.size, [&](int x, int y) { return double(luma[y][x]); }),
                          wanted),
                  1)
            << int(format);
    }
}

TEST_P(StepsTest, TheToneCurveIsAppliedToTheLumaThePyramidAndTheDetailOfAStill) {
    StillTone tone;
    for (std::size_t i = 0; i < tone.levels.size(); ++i)
        tone.levels[i] = static_cast<std::uint8_t>(40 + i * i / 400);
    const StereoRig rig = plainRig({50, 35}, {200, 140});
    for (const auto& [output, share] : {std::pair{Size{200, 140}, 0.08}, {Size{100, 70}, 0.0}}) {
        const TestPicture still = Waves(5, 4, 60, 30).shoot(rig.still.size, {});
        const auto curve = [&](const twin::Grey& of) {
            return twin::greyOf(of.size, [&](int x, int y) {
                const double level = of.at(x, y);
                return 40 + level * level / 400;
            });
        };
        const auto engine = engineFor(rig, output);
        const auto step = engine->still();
        const StillPictures& made = step->run(still.view(), SuperResMode::Detail, tone, 0);
        EXPECT_EQ(made.tone, tone);
        const twin::Grey luma = twin::luma(still.view());
        const Rows<const std::uint8_t> host = made.luma.host();
        EXPECT_LE(worstOf(twin::greyOf(host.size, [&](int x, int y) { return double(host[y][x]); }),
                          curve(luma)),
                  2);
        const auto pyramids = engine->pyramid();
        const LumaPyramid& pyramid = pyramids->still(made, 1);
        EXPECT_LE(
            worstOf(levelOf(pyramid, pyramid.still[0]), twin::lumaFromStill(curve(luma), rig, 1)),
            2.5);
        const twin::Grey shown = share == 0 ? twin::reduced(luma, made.rig.still.size) : luma;
        EXPECT_LE(worstOf(raisedOf(made), twin::raised(curve(shown), share)), 3) << share;
    }
}

twin::Grey channelOf(const TestPicture& picture, int channel) {
    return twin::greyOf(picture.size, [&](int x, int y) {
        return double(picture.bytes[4UL * (1UL * y * picture.size.width + x) + channel]);
    });
}

void expectEnlarged(Engine& engine, const TestPicture& picture, Size output, bool cubic,
                    double most) {
    const auto step = engine.detail();
    const RgbPlanes planes = planesOf(picture);
    const ImageView view = picture.view();
    step->draw({view, planes, 1}, nullptr, everything(picture.size), {SuperResMode::Off, cubic});
    const Rows<const std::uint32_t> shown = step->output().host();
    for (int channel = 0; channel < 3; ++channel) {
        const twin::Grey wanted = twin::enlarged(channelOf(picture, channel), output, !cubic);
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x)
                ASSERT_NEAR(shown[y][x] >> (8 * channel) & 255U,
                            std::clamp(wanted.at(x, y), 0.0, 255.0), most)
                    << output.width << ": " << x << ", " << y;
    }
}

TEST_P(StepsTest, WithoutAStillTheVideoIsEnlarged) {
    const Size video{53, 37};
    for (const Size output : {Size{191, 133}, Size{61, 140}, Size{424, 296}})
        for (const bool cubic : {true, false}) {
            const auto engine = engineFor(plainRig(video, output), output);
            // Tolerance [grey levels]: shaders first enlarge along columns and round the result to
            // 8 bits. Kernels first enlarge along rows and round the result to 1/64 grey level.
            // Then they enlarge along columns and round products to 1/32 grey level.
            const double gain = cubic ? twin::kCubicGain : 1;
            const double most = isGles() ? 0.51 * (1 + gain) * roundingFactor() : 0.65;
            expectEnlarged(*engine, Waves(1, 3, 40, 20).shoot(video, {}), output, cubic, most);
            // When the pictures below are enlarged along columns, values can leave a byte's range.
            // Shaders clamp them, but the oracle and the kernels do not.
            if (isGles()) continue;
            expectEnlarged(*engine, randomPicture(video, 2), output, cubic, most);
            expectEnlarged(*engine, checkerboard(video), output, cubic, most);
        }
}

}  // namespace
}  // namespace mfar
