#include "pipeline/gles/depth_splat.h"
#include "tests/shader/gl_test.h"
#include "tests/warp/cast_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar {
namespace {

using DepthSplatGl = GlTest;

/// The nearest z of the points that reach each pixel, of those numbered as `catcher` says; its
/// second value is the same with a margin of a thousandth of a pixel about the quarter.
struct Splat {
    std::vector<float> strict, lenient;
};
Splat twinSplat(const RenderedPicture& picture, bool catcher, const LensProjection& lens,
                const RigidTransform& pose) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const Size size = lens.camera.size;
    Splat out{std::vector<float>(picture.id.size(), kFar),
              std::vector<float>(picture.id.size(), kFar)};
    const RigidTransform T = pose.inverse() * picture.T_world_camera;
    for (std::size_t i = 0; i < picture.id.size(); ++i) {
        if (picture.id[i] == 0 || (picture.id[i] == kCatcherId) != catcher) continue;
        const Eigen::Vector2d from(i % size.width, i / size.width);
        const Eigen::Vector3d p =
            T * (picture.depth[i] * picture.camera.unproject(from).homogeneous());
        if (!(p.z() > LensProjection::kNear)) continue;
        const Eigen::Vector2d to = lens(p).hnormalized(), low = to.array().floor(), f = to - low;
        for (int k = 0; k < 4; ++k) {
            const double x = low.x() + (k & 1), y = low.y() + (k >> 1);
            if (x < 0 || y < 0 || x >= size.width || y >= size.height) continue;
            const double w =
                ((k & 1) != 0 ? f.x() : 1 - f.x()) * ((k >> 1) != 0 ? f.y() : 1 - f.y());
            const auto j = static_cast<std::size_t>(y * size.width + x);
            const auto z = static_cast<float>(p.z());
            if (w > 0.251) out.strict[j] = std::min(out.strict[j], z);
            if (w > 0.249) out.lenient[j] = std::min(out.lenient[j], z);
        }
    }
    return out;
}

TEST_F(DepthSplatGl, MatchesItsTwin) {
    const test::CastScene scene = test::twoBalls();
    const Size size{173, 131};
    const LensProjection lens(test::bentCamera(size));
    const RenderedPicture picture = scene.cast({lens.camera, test::orbit(0)});
    const WarpReference reference = warpReference(picture);
    ReferenceTextures textures;
    textures.upload(reference);
    DepthSplat splat(lens);
    for (const double degrees : {0.7, 12.0, 60.0}) {
        const RigidTransform pose = test::orbit(degrees);
        splat.run(reference, textures, pose, {0, 0, size.width, size.height});
        for (const bool catcher : {false, true}) {
            const Splat twin = twinSplat(picture, catcher, lens, pose);
            const auto z = (catcher ? splat.catcher() : splat.objects()).readRgba32F();
            int hit = 0;
            for (std::size_t i = 0; i < twin.strict.size(); ++i) {
                const float got = z[4 * i] > 0 ? z[4 * i] : 1e9F;
                ASSERT_LE(got, std::min(twin.strict[i] * 1.0001F, 1e9F))
                    << i % size.width << " " << i / size.width;
                ASSERT_GE(got, std::min(twin.lenient[i] * 0.9999F, 1e9F))
                    << i % size.width << " " << i / size.width;
                hit += z[4 * i] > 0 ? 1 : 0;
            }
            EXPECT_GT(hit, 500) << degrees;
        }
    }
}

}  // namespace
}  // namespace mfar
