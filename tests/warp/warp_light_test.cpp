#include "pipeline/scene/rigid_path.h"
#include "tests/engine/gl_test.h"
#include "tests/warp/mirror_surfaces.h"
#include "tests/warp/warp_support.h"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mfar {
namespace {

constexpr Size kView{241, 183};

SurfaceTexture stripes(bool srgb) {
    SurfaceTexture out{{64, 32}, srgb, {}};
    for (int i = 0; i < 64 * 32; ++i) {
        const int x = i % 64, y = i / 64;
        const auto wave = [](double phase) {
            return static_cast<std::uint8_t>(std::lround(130 + 100 * std::sin(phase)));
        };
        const std::uint8_t third = wave(0.2 * x + 0.5 * y);
        // One channel of the colours is dark, because eyes see small errors there.
        const auto dark = static_cast<std::uint8_t>(third / 8);
        out.texels.push_back({wave(0.4 * x), wave(0.3 * y), srgb ? dark : third, 255});
    }
    return out;
}

/// The scene of the balls, with texture coordinates and a material with both textures.
Scene painted(const test::CastScene& cast) {
    Scene out = cast.scene();
    for (SceneObject& object : out.objects) {
        auto model = std::make_shared<Model>(*object.model);
        Mesh& mesh = model->meshes.front();
        for (const Eigen::Vector3f& p : mesh.positions)
            mesh.uvs.emplace_back(3 * p.normalized().x(), 2 * p.normalized().z());
        model->textures = {stripes(true), stripes(false)};
        model->materials.front().baseColourTexture = 0;
        model->materials.front().metallicRoughnessTexture = 1;
        object.model = model;
    }
    return out;
}

Eigen::Vector2d placeOf(std::size_t pixel) {
    const std::size_t row = pixel / kView.width;
    return {static_cast<double>(pixel % kView.width), static_cast<double>(row)};
}

/// Any light that changes smoothly over the picture.
LightWords lightAt(std::size_t pixel) {
    const double sum = placeOf(pixel).sum();
    const auto wave = [&](double per) {
        return static_cast<float>(0.4 + 0.3 * std::sin(per * sum));
    };
    return packedWords({{wave(0.1), wave(0.07), 0.3F}, {0.2F, wave(0.05), 0.4F}, 0.2F});
}

RenderedPicture litPicture(const test::CastScene& cast, const CameraModel& camera) {
    RenderedPicture out = cast.cast({camera, test::orbit(0)}, 2);
    out.mirrors = std::make_shared<const MirrorLight>(test::smoothLightAndSun());
    out.light.resize(out.id.size());
    out.gloss.resize(out.id.size());
    for (std::size_t i = 0; i < out.id.size(); ++i) {
        if (out.id[i] == 0 || out.id[i] == kCatcherId) continue;
        const Eigen::Vector2d pixel = placeOf(i);
        const Eigen::Vector3d point =
            out.T_world_camera *
            Eigen::Vector3d(out.depth[i] * camera.unproject(pixel).homogeneous());
        const Eigen::Vector3f normal =
            (point - cast.balls[out.id[i] - 1U].centre).normalized().cast<float>();
        out.light[i] = lightAt(i);
        out.gloss[i] = packedGloss({normal.x(), normal.y(), normal.z()}, 0.4F, 0.3F, 0.5F);
    }
    return out;
}

struct LitWarp {
    explicit LitWarp(EngineKind kind, bool moves, const WarpOptions& options)
        : engine(test::warpEngine(kind)), warp(test::bentCamera(kView), kView, *engine, options) {
        Scene scene = painted(cast);
        if (moves) scene.objects[1].path = std::make_shared<const RigidPath>();
        warp.setScene(scene);
        RenderedPicture picture = litPicture(cast, warp.camera());
        if (moves) picture.poses = poses;
        warp.setTracedPicture(tracedPicture(picture));
    }
    [[nodiscard]] std::vector<std::uint8_t> at(double degrees,
                                               std::vector<RigidTransform> moved = {}) {
        return test::bytesOf(warp.run(test::orbit(degrees), std::move(moved)).colour);
    }
    std::optional<HoleRequest> request() {
        engine->finish();
        return warp.takeRequest();
    }

    test::CastScene cast = test::twoBalls();
    std::vector<RigidTransform> poses{{Eigen::Quaterniond::Identity(), cast.balls[0].centre},
                                      {Eigen::Quaterniond::Identity(), cast.balls[1].centre}};
    std::unique_ptr<Engine> engine;
    Warp warp;
};

void expectSame(const std::vector<std::uint8_t>& gles, const std::vector<std::uint8_t>& simd) {
    double sum = 0;
    int apart = 0, bright = 0;
    for (std::size_t i = 0; i < gles.size(); ++i) {
        const int error = gles[i] - simd[i];
        sum += error * error;
        apart += std::abs(error) > 12 ? 1 : 0;
        bright += simd[i] > 60 ? 1 : 0;
    }
    const auto values = static_cast<double>(gles.size());
    EXPECT_GT(bright, 0.1 * values);
    EXPECT_LT(std::sqrt(sum / values), 1.2) << "root mean square difference [grey levels]";
    EXPECT_LT(apart, 0.002 * values);
}

using WarpLight = GlTest;

TEST_F(WarpLight, BothEnginesShowTheSamePaintInTheSameLight) {
    const WarpOptions options{.filling = HoleFilling::PushPull};
    LitWarp gles(EngineKind::Gles, false, options), simd(EngineKind::Simd, false, options);
    for (const double degrees : {0.5, 4.0, 12.0}) {
        SCOPED_TRACE(degrees);
        expectSame(gles.at(degrees), simd.at(degrees));
    }
}

TEST_F(WarpLight, BothEnginesShowTheSameLightOnMovedObjects) {
    const WarpOptions options{.filling = HoleFilling::PushPull};
    LitWarp gles(EngineKind::Gles, true, options), simd(EngineKind::Simd, true, options);
    std::vector<RigidTransform> moved = gles.poses;
    moved[1].translation += Eigen::Vector3d(0.005, 0.003, 0.002);
    expectSame(gles.at(3, moved), simd.at(3, moved));
}

TEST_F(WarpLight, BothEnginesShowTheSameLightInRerenderedPixels) {
    constexpr double kTurn = 40;  // [degrees]
    const WarpOptions options{.filling = HoleFilling::Rerender};
    LitWarp gles(EngineKind::Gles, false, options), simd(EngineKind::Simd, false, options);
    for (LitWarp* one : {&gles, &simd})
        (void)one->at(kTurn);
    const auto request = gles.request();
    ASSERT_TRUE(request && simd.request());
    HoleAnswer answer = test::answered(gles.cast, *request);
    for (const std::uint32_t pixel : answer.pixels)
        answer.light.push_back(lightAt(pixel));
    // The colours must not be used where the light is known.
    for (std::size_t i = 0; i < answer.id.size(); ++i)
        if (answer.id[i] != 0) answer.colour[i] = {255, 0, 255, 255};
    const std::vector<std::uint8_t> before = gles.at(kTurn);
    gles.warp.answer(answer);
    simd.warp.answer(answer);
    const std::vector<std::uint8_t> now = gles.at(kTurn);
    expectSame(now, simd.at(kTurn));
    int changed = 0, coloured = 0;
    for (const std::uint32_t pixel : answer.pixels) {
        const std::uint8_t* const rgba = &now[4UL * pixel];
        changed += rgba[3] != before[4UL * pixel + 3] ? 1 : 0;
        coloured += rgba[0] == 255 && rgba[1] == 0 && rgba[2] == 255 ? 1 : 0;
    }
    EXPECT_GT(changed, 100);
    EXPECT_LT(coloured, changed / 50);
}

}  // namespace
}  // namespace mfar
