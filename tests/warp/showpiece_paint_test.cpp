#include "pipeline/models/showpiece.h"
#include "pipeline/render/exposure.h"
#include "pipeline/render/traced_scene.h"
#include "pipeline/simd/surface_raster.h"
#include "tests/warp/cast_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace mfar::simd {
namespace {

constexpr Size kView{320, 240};
constexpr int kAcross = 8;  // rays a pixel, each way

struct Truth {
    Eigen::Vector4d paint = Eigen::Vector4d::Zero();  // linear; metallic
    int hits = 0;
};

Truth truthAt(const TracedScene& scene, const CameraModel& camera, const RigidTransform& pose,
              int x, int y) {
    Truth out;
    for (int j = 0; j < kAcross; ++j)
        for (int i = 0; i < kAcross; ++i) {
            const Eigen::Vector2d at(x + (i + 0.5) / kAcross - 0.5, y + (j + 0.5) / kAcross - 0.5);
            const Eigen::Vector3d along = pose.rotation * camera.unproject(at).homogeneous();
            const Ray ray{pose.translation.cast<float>(), along.cast<float>()};
            const RayHit hit = scene.shown(ray, scene.objects().first(ray));
            if (!hit.found()) continue;
            const SurfaceLook look = scene.objectPoint(hit, ray.direction).look;
            out.paint.head<3>() += look.baseColour.cast<double>();
            out.paint.w() += look.metallic;
            ++out.hits;
        }
    if (out.hits > 0) out.paint /= out.hits;
    return out;
}

TEST(ShowpiecePaint, IsWhatRaysMeet) {
    const CameraModel camera = test::bentCamera(kView);
    const RigidTransform pose = test::orbit(20, 0.25, 25);
    auto scene = std::make_shared<Scene>();
    scene->objects.push_back({std::make_shared<Model>(showpiece()), {}, 1});
    const TracedScene traced(scene, 1);
    SurfaceRaster raster(camera, nullptr);
    raster.setScene(*scene);
    raster.draw(pose, {0, 0, kView.width, kView.height});
    double colour = 0, metallic = 0;
    int pixels = 0;
    std::vector<std::uint32_t> row(kView.width + 8);
    for (int y = 0; y < kView.height; ++y) {
        raster.paintRow(y, 0, kView.width, row.data());
        for (int x = 0; x < kView.width; ++x) {
            const std::uint32_t word = row[static_cast<std::size_t>(x)];
            if (word == 0) continue;
            const Truth truth = truthAt(traced, camera, pose, x, y);
            if (truth.hits < kAcross * kAcross) continue;
            ++pixels;
            for (int c = 0; c < 3; ++c) {
                const float linear = static_cast<float>(truth.paint[c]);
                const double shown = word >> 8 * c & 0xFFU;
                colour += std::pow(shown - 255 * srgbEncoded(linear), 2) / 3;
            }
            metallic += std::pow((word >> 24) - 255 * truth.paint.w(), 2);
        }
    }
    const auto psnr = [&](double sum) { return 10 * std::log10(255.0 * 255 * pixels / sum); };
    EXPECT_GT(pixels, 12000);
    EXPECT_GT(psnr(colour), 32.1);
    EXPECT_GT(psnr(metallic), 29.3);
}

}  // namespace
}  // namespace mfar::simd
