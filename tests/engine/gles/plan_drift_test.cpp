#include "pipeline/plan/work_plan.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace mfar {
namespace {

using PlanDrift = GlTest;

constexpr Size kDriftVideo{317, 235};
constexpr std::size_t kDriftPixels = std::size_t{317} * 235;

using Rgb = std::array<float, 3>;  // a colour [grey levels]
using Light = std::vector<Rgb>;
using DriftScene = std::function<Rgb(int x, int y, int frame)>;

Light lightOf(const DriftScene& scene, int frame) {
    Light out;
    out.reserve(kDriftPixels);
    for (int y = 0; y < kDriftVideo.height; ++y)
        for (int x = 0; x < kDriftVideo.width; ++x)
            out.push_back(scene(x, y, frame));
    return out;
}

/// Gaussian random numbers from a long table, because drawing new numbers would take most of the
/// test's time.
float gaussian(std::size_t at) {
    static const std::vector<float> table = [] {
        std::mt19937 random(3);
        std::normal_distribution<float> normal;
        std::vector<float> out(1U << 20U);
        std::ranges::generate(out, [&] { return normal(random); });
        return out;
    }();
    return table[at % table.size()];
}

/// Noise of a sensor, which grows with brightness. The share `shared` of its variance comes from
/// noise that is equal in all pixels of a 2x2 block, as after smoothing in a camera.
struct NoisySensor {
    double sigma = 1, shared = 0;
    std::mt19937 random{3};

    TestPicture shoot(const Light& light) {
        const std::size_t first = random(), firstBlock = random();
        const auto own = static_cast<float>(std::sqrt(1 - shared)),
                   common = static_cast<float>(std::sqrt(shared));
        TestPicture out(kDriftVideo);
        for (std::size_t i = 0; i < kDriftPixels; ++i) {
            const std::size_t x = i % kDriftVideo.width, y = i / kDriftVideo.width;
            const std::size_t block = y / 2 * kDriftVideo.width + x / 2;
            for (std::size_t c = 0; c < 3; ++c) {
                const float bright = 0.7F + 0.5F * light[i][c] / 255;
                const float noise = own * gaussian(first + 3 * i + c) +
                                    common * gaussian(firstBlock + 3 * block + c);
                const float grey = light[i][c] + static_cast<float>(sigma) * bright * noise;
                out.bytes[4 * i + c] =
                    static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
            }
            out.bytes[4 * i + 3] = 255;
        }
        return out;
    }
};

struct DriftOutcome {
    double stale = 0;    ///< mean squared change of light since a tile was drawn [grey levels^2]
    double changed = 0;  ///< mean share of the tiles that count as changed
};

/// Runs frames and draws the tiles that the plan marks. Counts only the frames after the first
/// `settled` ones.
DriftOutcome watch(const DriftScene& scene, NoisySensor sensor, int settled, int frames) {
    WorkPlan plan(kDriftVideo);
    Light drawnLight = lightOf(scene, 0), light = drawnLight;
    TestPicture drawn = sensor.shoot(drawnLight);
    DriftOutcome out;
    for (int frame = 1; frame <= settled + frames; ++frame) {
        light = lightOf(scene, frame);
        const TestPicture now = sensor.shoot(light);
        plan.update(planesOf(now), planesOf(drawn), false);
        const std::vector<TileWork::Tile>& tiles = plan.work().flags;
        double stale = 0;
        for (std::size_t i = 0; i < kDriftPixels; ++i) {
            const std::size_t x = i % kDriftVideo.width, y = i / kDriftVideo.width;
            if (tiles[y / 16 * plan.tileCount().width + x / 16].changed != 0) {
                std::copy_n(&now.bytes[4 * i], 4, &drawn.bytes[4 * i]);
                drawnLight[i] = light[i];
            }
            for (std::size_t c = 0; c < 3; ++c)
                stale += std::pow(light[i][c] - drawnLight[i][c], 2) / (3.0 * kDriftPixels);
        }
        if (frame <= settled) continue;
        out.stale += stale / frames;
        out.changed += static_cast<double>(plan.work().changed) / tiles.size() / frames;
    }
    return out;
}

Rgb grey(double level) {
    const auto g = static_cast<float>(level);
    return {g, g, g};
}

DriftScene slopes(double contrast, double pixelsPerFrame) {
    return [=](int x, int y, int frame) {
        const double u = (x + pixelsPerFrame * frame) / 90, v = y / 70.0;
        return grey(120 + contrast * (std::sin(u) * std::cos(v) + 0.3 * u));
    };
}

DriftScene brightening(double perFrame, bool redAlone) {
    return [=](int x, int y, int frame) {
        const auto gain = static_cast<float>(1 + perFrame * frame / 100);
        Rgb out = grey(90 + 0.2 * x + 0.1 * y);
        for (float& channel : out)
            if (!redAlone || &channel == out.data()) channel *= gain;
        return out;
    };
}

// The mean squared error of stale tiles must be below 3 % of the noise's variance. If noise is the
// picture's only other error, 3 % lower the PSNR by 0.13 dB.
TEST_F(PlanDrift, SlowChangesLeaveNoStaleTiles) {
    const std::vector<std::pair<const char*, DriftScene>> scenes{
        {"slow", slopes(25, 0.05)},
        {"faster", slopes(25, 0.5)},
        {"hardly any contrast", slopes(8, 0.3)},
        {"brighter", brightening(0.02, false)},
        {"quickly brighter", brightening(0.2, false)}};
    for (const double sigma : {0.5, 2.0})
        for (const auto& [name, scene] : scenes)
            EXPECT_LT(watch(scene, {sigma}, 4, 12).stale, 0.03 * (sigma * sigma + 1.0 / 12))
                << name << ", noise " << sigma;
}

// WorkPlan looks for slow changes in two ways: by a sum over many tiles, which contains only luma,
// and in each tile, in all channels. A change of red alone changes luma only 0.3 times as much.
TEST_F(PlanDrift, ChangesOfColourAloneAreRedrawnBeforeTheyAreVisible) {
    for (const double sigma : {0.5, 2.0})
        EXPECT_LT(watch(brightening(0.3, true), {sigma}, 4, 12).stale,
                  0.1 * (sigma * sigma + 1.0 / 12))
            << "noise " << sigma;
}

TEST_F(PlanDrift, NoiseOfAStaticSceneRedrawsNothing) {
    for (const double sigma : {0.0, 0.5, 2.0})
        EXPECT_LT(watch(slopes(60, 0), {sigma}, 20, 24).changed, 0.0005) << "noise " << sigma;
}

TEST_F(PlanDrift, NoiseThatTheCameraSmoothedRedrawsNothingOnceItIsLearned) {
    EXPECT_LT(watch(slopes(60, 0), {1.5, 0.25}, 80, 16).changed, 0.0005);
}

// Tiles around a small moving object must be drawn as rarely as without the object.
TEST_F(PlanDrift, AMovingObjectRedrawsOnlyItsTiles) {
    const DriftScene scene = [](int x, int y, int frame) {
        const bool moves = std::hypot(x - 100 - 2 * (frame % 20), y - 90) < 12;
        return grey((moves ? 200 : 90) + 0.1 * x);
    };
    const DriftOutcome out = watch(scene, {1.5}, 8, 16);
    EXPECT_GT(out.changed, 0.01);
    EXPECT_LT(out.changed, 0.08);
    EXPECT_LT(out.stale, 0.03 * 1.5 * 1.5);
}

}  // namespace
}  // namespace mfar
