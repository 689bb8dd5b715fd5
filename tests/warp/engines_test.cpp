#include "tests/engine/gl_test.h"
#include "tests/warp/warp_support.h"

#include <cmath>

namespace mfar {
namespace {

using WarpEngines = GlTest;

constexpr Size kBoth{241, 183};

struct OfEngine {
    OfEngine(EngineKind kind, double degrees, const WarpOptions& options)
        : engine(test::warpEngine(kind)), warp(test::bentCamera(kBoth), kBoth, *engine, options) {
        const test::CastScene scene = test::twoBalls();
        warp.setScene(scene.scene());
        warp.setTracedPicture(tracedPicture(scene.cast({warp.camera(), test::orbit(0)}, 2)));
        const LayerPicture& layer = warp.run(test::orbit(degrees));
        colour = test::bytesOf(layer.colour);
        depth = test::valuesOf(layer.depth);
        bounds = layer.bounds;
        engine->finish();
        (void)warp.takeRequest();
    }
    std::unique_ptr<Engine> engine;
    Warp warp;
    std::vector<std::uint8_t> colour;
    std::vector<float> depth;
    PixelRect bounds;
};

TEST_F(WarpEngines, BothEnginesShowTheSamePicture) {
    for (const HoleFilling filling : {HoleFilling::None, HoleFilling::PushPull})
        for (const double degrees : {0.5, 3.0, 12.0}) {
            const WarpOptions options{.filling = filling};
            const OfEngine gles(EngineKind::Gles, degrees, options);
            const OfEngine simd(EngineKind::Simd, degrees, options);
            EXPECT_EQ(gles.bounds, simd.bounds);
            double sum = 0;
            int apart = 0;
            for (std::size_t i = 0; i < gles.colour.size(); ++i) {
                const int error = gles.colour[i] - simd.colour[i];
                sum += error * error;
                apart += std::abs(error) > 8 ? 1 : 0;
            }
            const auto values = static_cast<double>(gles.colour.size());
            EXPECT_LT(std::sqrt(sum / values), 1.0)
                << "difference in grey levels, at " << degrees << " degrees";
            EXPECT_LT(apart, 0.002 * values) << degrees;
            const int holes = gles.warp.counters().openHoles;
            EXPECT_NEAR(simd.warp.counters().openHoles, holes, 5 + 0.02 * holes) << degrees;
        }
}

TEST_F(WarpEngines, BothEnginesShowTheSameDepth) {
    const OfEngine gles(EngineKind::Gles, 5, {}), simd(EngineKind::Simd, 5, {});
    int apart = 0;
    for (std::size_t i = 0; i < gles.depth.size(); ++i)
        apart += std::abs(gles.depth[i] - simd.depth[i]) > 1e-3F ? 1 : 0;
    EXPECT_LT(apart, 0.003 * static_cast<double>(gles.depth.size()));
}

}  // namespace
}  // namespace mfar
