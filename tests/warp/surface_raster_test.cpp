#include "base/workers.h"
#include "pipeline/render/rendered_picture.h"
#include "pipeline/render/texture_lookup.h"
#include "pipeline/simd/surface_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace mfar::simd {
namespace {

constexpr Size kLayer{60, 40};
constexpr PixelRect kAll{0, 0, kLayer.width, kLayer.height};

CameraModel straight() {
    return {kLayer, 50, 50, 29.5, 19.5, {}};
}

/// A square of 0.4 m about the origin that faces -z, cut into many irregular triangles.
Mesh shards(int side, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> shift(-0.4F, 0.4F);
    Mesh mesh;
    const float step = 0.4F / static_cast<float>(side);
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) {
            const bool inside = x > 0 && y > 0 && x < side && y < side;
            const float u = static_cast<float>(x) + (inside ? shift(random) : 0);
            const float v = static_cast<float>(y) + (inside ? shift(random) : 0);
            mesh.positions.emplace_back(u * step - 0.2F, v * step - 0.2F, 0);
            mesh.uvs.emplace_back(u * step / 0.4F, v * step / 0.4F);
        }
    const auto at = [side](int x, int y) { return static_cast<std::uint32_t>(y * (side + 1) + x); };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            mesh.triangles.push_back({at(x, y), at(x, y + 1), at(x + 1, y + 1)});
            mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x + 1, y)});
        }
    return mesh;
}

Scene sceneOf(const Mesh& mesh, const Material& material, const RigidTransform& at) {
    auto model = std::make_shared<Model>();
    model->meshes.push_back(mesh);
    model->materials.push_back(material);
    Scene scene;
    scene.objects.push_back({model, at, 1});
    return scene;
}

std::vector<std::uint32_t> drawn(const Scene& scene, const RigidTransform& camera = {},
                                 int threads = 1) {
    SurfaceRaster raster(straight(), std::make_shared<Workers>(threads));
    raster.setScene(scene);
    raster.draw(camera, kAll);
    std::vector<std::uint32_t> out;
    const auto rows = raster.surface();
    for (int y = 0; y < rows.size.height; ++y)
        out.insert(out.end(), rows[y], rows[y] + rows.size.width);
    return out;
}

float depthOf(std::uint32_t word) {
    return std::bit_cast<float>(word & 0xFFFFFF00U);
}

// At a distance of 1 m, the square covers 40x40 pixels of the grid, which has twice the layer's
// resolution. The square's upper left corner is at (39.51, 19.51) [grid px].
TEST(SurfaceRaster, CoversASurfaceWithoutGapsAndNotBeyondItsOutline) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto words = drawn(
            sceneOf(shards(9, seed), {}, {Eigen::Quaterniond::Identity(), {0.0001, 0.0001, 1}}));
        for (int y = 0; y < 2 * kLayer.height; ++y)
            for (int x = 0; x < 2 * kLayer.width; ++x) {
                const bool inside = x >= 40 && x < 80 && y >= 20 && y < 60;
                const std::uint32_t word = words[static_cast<std::size_t>(y) * 120 + x];
                ASSERT_EQ(word & 0xFFU, inside ? 1U : 0U) << seed << " " << x << " " << y;
                if (inside) {
                    ASSERT_NEAR(depthOf(word), 1, 3e-5) << x << " " << y;
                }
            }
    }
}

TEST(SurfaceRaster, DepthMatchesTheSlantedPlane) {
    Material both;
    both.doubleSided = true;
    const Eigen::Quaterniond slant(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 0.3, 0).normalized()));
    const RigidTransform at{slant, {0.02, -0.01, 0.6}};
    const auto words = drawn(sceneOf(shards(6, 1), both, at));
    const Eigen::Vector3d normal = slant * Eigen::Vector3d::UnitZ();
    int checked = 0;
    for (int y = 0; y < 2 * kLayer.height; ++y)
        for (int x = 0; x < 2 * kLayer.width; ++x) {
            const std::uint32_t word = words[static_cast<std::size_t>(y) * 120 + x];
            if (word == 0) continue;
            const Eigen::Vector2d pixel(0.5 * x - 0.25, 0.5 * y - 0.25);
            const Eigen::Vector3d ray = straight().unproject(pixel).homogeneous();
            const double z = normal.dot(at.translation) / normal.dot(ray);
            ASSERT_NEAR(depthOf(word), z, 1e-4 * z) << x << " " << y;
            ++checked;
        }
    EXPECT_GT(checked, 1000);
}

// The floor extends from behind the camera to far in front of it.
TEST(SurfaceRaster, TrianglesBehindTheCameraAreClipped) {
    Material both;
    both.doubleSided = true;
    Mesh floor;
    floor.positions = {{-50, 1, -50}, {50, 1, -50}, {50, 1, 50}, {-50, 1, 50}};
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto words = drawn(sceneOf(floor, both, {}));
    for (int y = 0; y < 2 * kLayer.height; ++y)
        for (int x = 0; x < 2 * kLayer.width; ++x) {
            const double v = (0.5 * y - 0.25 - 19.5) / 50, z = 1 / v;
            const std::uint32_t word = words[static_cast<std::size_t>(y) * 120 + x];
            if (v <= 0 || z > 55) {
                ASSERT_EQ(word, 0U) << x << " " << y;
            } else if (z < 45) {
                ASSERT_NEAR(depthOf(word), z, 2e-3 * z) << x << " " << y;
            }
        }
}

/// A square with a mask of 2x2 texels. The texels in `shown` are opaque. Pixel (x, y) shows the
/// texture's coordinates ((x - 39.51) / 40, (y - 19.51) / 40).
Scene maskedSquare(std::initializer_list<std::size_t> shown) {
    auto model = std::make_shared<Model>();
    model->meshes.push_back(shards(5, 3));
    Material masked;
    masked.alphaCutoff = 0.5F;
    masked.baseColourTexture = 0;
    model->materials.push_back(masked);
    SurfaceTexture board;
    board.size = {2, 2};
    board.texels.resize(4);
    for (const std::size_t texel : shown)
        board.texels[texel][3] = 255;
    model->textures.push_back(board);
    Scene scene;
    scene.objects.push_back({model, {Eigen::Quaterniond::Identity(), {0.0001, 0.0001, 1}}, 1});
    return scene;
}

TEST(SurfaceRaster, TransparentTexelsOfAMaskAreNotDrawn) {
    const auto words = drawn(maskedSquare({0, 3}));
    for (const auto& [x, y, shown] : {std::tuple{45, 25, true},
                                      {75, 25, false},
                                      {45, 55, false},
                                      {75, 55, true},
                                      {58, 38, true},
                                      {62, 38, false}})
        EXPECT_EQ(words[static_cast<std::size_t>(y) * 120 + x] != 0, shown) << x << " " << y;
}

TEST(SurfaceRaster, BetweenItsTexelsAMaskIsInterpolatedAsByThePathTracer) {
    const Scene scene = maskedSquare({0});
    const SurfaceTexture& texture = scene.objects[0].model->textures[0];
    const auto words = drawn(scene);
    int sure = 0;
    for (int y = 20; y < 59; ++y)
        for (int x = 40; x < 79; ++x) {
            const Eigen::Vector2f uv((static_cast<float>(x) - 39.51F) / 40,
                                     (static_cast<float>(y) - 19.51F) / 40);
            const float alpha = lookUp(texture, uv).w();
            if (std::abs(alpha - 0.5F) < 0.05F) continue;
            ++sure;
            ASSERT_EQ(words[static_cast<std::size_t>(y) * 120 + x] != 0, alpha > 0.5F)
                << x << " " << y;
        }
    EXPECT_GT(sure, 1300);
}

TEST(SurfaceRaster, ObjectsCoverANearerShadowCatcherWithAnyNumberOfThreads) {
    Scene scene = sceneOf(shards(40, 5), {}, {Eigen::Quaterniond::Identity(), {0, 0, 1}});
    // A planar shadow catcher would not be drawn. So this one is bent. It is nearer than the
    // square.
    scene.catcher.positions = {{-1, -1, 0.5F}, {1, -1, 0.5F}, {1, 1, 0.6F}, {-1, 1, 0.5F}};
    scene.catcher.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto one = drawn(scene);
    EXPECT_EQ(std::ranges::count_if(one, [](std::uint32_t w) { return (w & 0xFFU) == 1; }), 1600);
    EXPECT_EQ(std::ranges::count_if(one, [](std::uint32_t w) { return (w & 0xFFU) == kCatcherId; }),
              120 * 80 - 1600);
    EXPECT_EQ(one, drawn(scene, {}, 2));
}

}  // namespace
}  // namespace mfar::simd
