#include "base/workers.h"
#include "pipeline/render/exposure.h"
#include "pipeline/render/paint.h"
#include "pipeline/render/texture_lookup.h"
#include "pipeline/simd/surface_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace mfar::simd {
namespace {

constexpr Size kPainted{60, 40};
constexpr int kRays = 8;

CameraModel paintCamera() {
    return {kPainted, 50, 50, 29.5, 19.5, {}};
}

SurfaceTexture noise(Size size, unsigned seed, bool srgb = true) {
    std::mt19937 random(seed);
    SurfaceTexture out{size, srgb, {}};
    for (int i = 0; i < size.width * size.height; ++i)
        out.texels.push_back({static_cast<std::uint8_t>(random() & 255U),
                              static_cast<std::uint8_t>(random() & 255U),
                              static_cast<std::uint8_t>(random() & 255U), 255});
    return out;
}

/// A square of 0.4 m about the origin that faces -z. It shows `uvScale` periods of its texture.
Mesh square(float uvScale = 1) {
    Mesh mesh;
    mesh.positions = {{-0.2F, -0.2F, 0}, {-0.2F, 0.2F, 0}, {0.2F, 0.2F, 0}, {0.2F, -0.2F, 0}};
    for (const Eigen::Vector3f& p : mesh.positions)
        mesh.uvs.emplace_back(uvScale * (p.x() / 0.4F - 0.3F), uvScale * (p.y() / 0.4F - 0.3F));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh ball(float radius, int segments) {
    Mesh mesh;
    const int rows = segments / 2;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= segments; ++i) {
            const double a = 2 * std::numbers::pi * i / segments, b = std::numbers::pi * j / rows;
            mesh.positions.push_back(radius * Eigen::Vector3d(std::sin(b) * std::cos(a),
                                                              std::sin(b) * std::sin(a),
                                                              std::cos(b))
                                                  .cast<float>());
            mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(segments),
                                  static_cast<float>(j) / static_cast<float>(rows));
        }
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < segments; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (segments + 1) + i);
            const auto below = a + static_cast<std::uint32_t>(segments) + 1;
            mesh.triangles.push_back({a, below, a + 1});
            mesh.triangles.push_back({a + 1, below, below + 1});
        }
    return mesh;
}

std::shared_ptr<Model> modelOf(Mesh mesh, const Material& material,
                               std::vector<SurfaceTexture> textures = {}) {
    auto model = std::make_shared<Model>();
    model->meshes.push_back(std::move(mesh));
    model->materials.push_back(material);
    model->textures = std::move(textures);
    return model;
}

RigidTransform placed(double slant, const Eigen::Vector3d& at) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(slant, Eigen::Vector3d(1, 0.3, 0).normalized())),
            at};
}

Scene sceneOf(std::vector<SceneObject> objects) {
    Scene scene;
    scene.objects = std::move(objects);
    return scene;
}

using Words = std::vector<PaintWords>;

Words paintOf(SurfaceRaster& raster) {
    Words out, row(kPainted.width + 8);
    for (int y = 0; y < kPainted.height; ++y) {
        raster.paintRow(y, 0, kPainted.width, row.data());
        out.insert(out.end(), row.begin(), row.begin() + kPainted.width);
    }
    return out;
}

Words paintOf(const Scene& scene, int threads = 1) {
    SurfaceRaster raster(paintCamera(), std::make_shared<Workers>(threads));
    raster.setScene(scene);
    raster.draw({}, {0, 0, kPainted.width, kPainted.height});
    return paintOf(raster);
}

/// Paint of a surface: diffuse colour (3 values), then reflectance along the normal (3 values).
using Six = Eigen::Matrix<double, 6, 1>;

Six bytesOf(const PaintWords& words) {
    Six out;
    for (int c = 0; c < 3; ++c) {
        out[c] = words.diffuse >> 8 * c & 0xFFU;
        out[3 + c] = words.facing >> 8 * c & 0xFFU;
    }
    return out;
}

std::optional<Six> met(const Scene& scene, const Eigen::Vector3d& along) {
    double nearest = 1e9;
    std::optional<Six> out;
    for (const SceneObject& object : scene.objects)
        for (const Mesh& mesh : object.model->meshes)
            for (const auto& t : mesh.triangles) {
                std::array<Eigen::Vector3d, 3> p;
                for (std::size_t i = 0; i < 3; ++i)
                    p[i] = object.T_world_object *
                           (object.scale * mesh.positions[t[i]].cast<double>()).eval();
                Eigen::Matrix3d m;
                m << p[1] - p[0], p[2] - p[0], -along;
                const Eigen::Vector3d s = m.inverse() * -p[0];
                if (!(s.x() >= 0 && s.y() >= 0 && s.x() + s.y() <= 1 && s.z() > 0.01) ||
                    s.z() >= nearest)
                    continue;
                const Material& material = object.model->materials.front();
                Eigen::Vector4f paint(material.baseColour.x(), material.baseColour.y(),
                                      material.baseColour.z(), material.metallic);
                if (!mesh.uvs.empty()) {
                    const Eigen::Vector2f uv =
                        static_cast<float>(1 - s.x() - s.y()) * mesh.uvs[t[0]] +
                        static_cast<float>(s.x()) * mesh.uvs[t[1]] +
                        static_cast<float>(s.y()) * mesh.uvs[t[2]];
                    const auto& textures = object.model->textures;
                    if (material.baseColourTexture >= 0)
                        paint.head<3>().array() *=
                            lookUp(textures[material.baseColourTexture], uv).head<3>().array();
                    if (material.metallicRoughnessTexture >= 0)
                        paint.w() *= lookUp(textures[material.metallicRoughnessTexture], uv).z();
                }
                nearest = s.z();
                const Paint made = mfar::paintOf(paint.head<3>(), paint.w(), {});
                out = (Six() << made.diffuse.cast<double>(), made.facing.cast<double>()).finished();
            }
    return out;
}

struct Errors {
    double mean = 0;
    int pixels = 0;
    double worst = 0;
};

Errors errorsOf(const Words& words, const Scene& scene) {
    Errors out;
    for (int y = 0; y < kPainted.height; ++y)
        for (int x = 0; x < kPainted.width; ++x) {
            Six sum = Six::Zero();
            int hits = 0;
            for (int i = 0; i < kRays * kRays; ++i) {
                const int column = i % kRays, row = i / kRays;
                const Eigen::Vector2d at(x + (column + 0.5) / kRays - 0.5,
                                         y + (row + 0.5) / kRays - 0.5);
                const auto found = met(scene, paintCamera().unproject(at).homogeneous());
                if (!found) break;
                sum += *found / (kRays * kRays);
                ++hits;
            }
            if (hits < kRays * kRays) continue;
            ++out.pixels;
            const auto bytes = bytesOf(words[static_cast<std::size_t>(y) * kPainted.width + x]);
            for (int c = 0; c < 6; ++c) {
                const double truth = srgbEncoded(static_cast<float>(sum[c]));
                const double error = std::abs(bytes[c] - 255 * truth);
                out.mean += error;
                out.worst = std::max(out.worst, error);
            }
        }
    out.mean /= 6 * out.pixels;
    return out;
}

Material textured(int baseColour = 0, int metallic = -1) {
    Material out;
    out.baseColourTexture = baseColour;
    out.metallicRoughnessTexture = metallic;
    return out;
}

TEST(SurfacePaint, TextureOfAPlaneIsAveragedOverEachPixel) {
    for (const auto& [slant, side, mean, worst] : {std::tuple{0.3, 8, 1.0, 20.0},
                                                   {0.3, 32, 3.5, 40.0},
                                                   {0.3, 256, 3.0, 20.0},
                                                   {1.2, 16, 4.0, 45.0},
                                                   {1.2, 128, 3.0, 20.0}}) {
        const Scene scene = sceneOf({{modelOf(square(2.5F), textured(), {noise({side, side}, 1)}),
                                      placed(slant, {0, 0, 0.6}), 1}});
        const Errors errors = errorsOf(paintOf(scene), scene);
        EXPECT_GT(errors.pixels, 200);
        EXPECT_LT(errors.mean, mean) << slant << " " << side;
        EXPECT_LT(errors.worst, worst) << slant << " " << side;
    }
}

TEST(SurfacePaint, ABallIsPaintedWithFactorsAndTexturesOfTwoSizes) {
    Material material = textured(0, 1);
    material.baseColour = {0.8F, 0.5F, 0.3F, 1};
    material.metallic = 0.7F;
    const Scene scene = sceneOf(
        {{modelOf(ball(0.15F, 32), material, {noise({60, 28}, 2), noise({24, 40}, 3, false)}),
          placed(0.8, {0, 0, 0.5}), 1}});
    const Errors errors = errorsOf(paintOf(scene), scene);
    EXPECT_GT(errors.pixels, 200);
    EXPECT_LT(errors.mean, 3.6);
}

// Tolerance of 1.25 grey levels: texels are bytes with 255 times the square root of linear values.
// In dark areas, rounding to such a byte changes the result by up to 0.75 grey levels. The result
// is rounded again.
TEST(SurfacePaint, PlainColoursAreExactUpToTwoRoundings) {
    for (const bool hasTexture : {false, true})
        for (int level = 0; level < 256; ++level) {
            Material material;
            const float linear = srgbDecoded(static_cast<float>(level) / 255);
            material.metallic = static_cast<float>(level) / 255;
            SurfaceTexture plain{{3, 5}, true, {}};
            if (hasTexture) {
                const auto byte = static_cast<std::uint8_t>(level);
                plain.texels.assign(15, {byte, byte, byte, 255});
                material.baseColourTexture = 0;
            } else {
                material.baseColour.head<3>().setConstant(linear);
            }
            const Words words =
                paintOf(sceneOf({{modelOf(square(), material, {plain}), placed(0, {0, 0, 1}), 1}}));
            const Paint truth =
                mfar::paintOf(Eigen::Vector3f::Constant(linear), material.metallic, {});
            const Six bytes = bytesOf(words[20UL * kPainted.width + 30]);
            for (int c = 0; c < 6; ++c) {
                const Eigen::Vector3f& part = c < 3 ? truth.diffuse : truth.facing;
                ASSERT_NEAR(bytes[c], 255 * srgbEncoded(part[c % 3]), 1.25) << level << " " << c;
            }
        }
}

TEST(SurfacePaint, LampsHaveThePaintOfThePathTracer) {
    Material lamp;
    lamp.baseColour = {0, 0, 0, 1};
    lamp.metallic = 1;
    for (const float emission : {0.0F, 2.0F}) {
        lamp.emission.y() = emission;
        const Words words = paintOf(sceneOf({{modelOf(square(), lamp), placed(0, {0, 0, 1}), 1}}));
        const Paint truth = mfar::paintOf({0, 0, 0}, 1, {}, emission > 0);
        const Six bytes = bytesOf(words[20UL * kPainted.width + 30]);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(bytes[3 + c], 255 * srgbEncoded(truth.facing[c]), 1.25) << emission;
    }
}

TEST(SurfacePaint, WithoutTextureCoordinatesOnlyTheFactorIsUsed) {
    Material material = textured(0, 0);
    material.baseColour = {1, 0, 1, 1};
    Mesh bare = square();
    bare.uvs.clear();
    const Words words =
        paintOf(sceneOf({{modelOf(bare, material, {noise({4, 4}, 4)}), placed(0, {0, 0, 1}), 1}}));
    EXPECT_EQ(words[20UL * kPainted.width + 30].facing & 0xFFFFFFU, 0xFF00FFU)
        << "a metal must reflect its base colour";
    EXPECT_EQ(words.front(), PaintWords{});
}

// Two squares overlap. The nearer one covers the upper right quarter of pixel (30, 20) and half of
// each of two neighbouring pixels.
TEST(SurfacePaint, TheObjectThatCoversMostQuartersOfAPixelIsPainted) {
    Material red, blue;
    red.baseColour = {1, 0, 0, 1};
    blue.baseColour = {0, 0, 1, 1};
    red.metallic = blue.metallic = 0;
    const SceneObject far{modelOf(square(), red), placed(0, {0.0001, 0.0001, 1}), 1};
    const SceneObject near{modelOf(square(), blue), placed(0, {0.2099, -0.1899, 0.9999}), 1};
    for (const Scene& scene : {sceneOf({far, near}), sceneOf({near, far})}) {
        const Words words = paintOf(scene);
        const auto at = [&](int x, int y) {
            return words[static_cast<std::size_t>(y) * kPainted.width + x].diffuse & 0xFFFFFFU;
        };
        EXPECT_EQ(at(30, 20), 0x000000FFU);
        // If each object covers two quarters of the pixel, the object in the lower left is painted.
        EXPECT_EQ(at(30, 19), 0x000000FFU);
        EXPECT_EQ(at(31, 20), 0x000000FFU);
        EXPECT_EQ(at(31, 19), 0x00FF0000U);
        EXPECT_EQ(at(39, 10), 0x00FF0000U);
    }
}

TEST(SurfacePaint, ASurfaceBehindTransparentTexelsIsPainted) {
    Material masked = textured(), red;
    masked.alphaCutoff = 0.5F;
    masked.metallic = 0;
    red.baseColour = {1, 0, 0, 1};
    red.metallic = 0;
    SurfaceTexture board{{2, 2}, true, {}};
    board.texels = {{0, 255, 0, 255}, {0, 255, 0, 0}, {0, 255, 0, 0}, {0, 255, 0, 255}};
    Mesh whole = square();
    for (Eigen::Vector2f& uv : whole.uvs)
        uv += Eigen::Vector2f(0.8F, 0.8F);
    const Words words =
        paintOf(sceneOf({{modelOf(square(), red), placed(0, {0, 0, 1.01}), 1},
                         {modelOf(whole, masked, {board}), placed(0, {0, 0, 1}), 1}}));
    const auto at = [&](int x, int y) {
        return words[static_cast<std::size_t>(y) * kPainted.width + x].diffuse & 0xFFFFFFU;
    };
    EXPECT_EQ(at(24, 14), 0x0000FF00U);
    EXPECT_EQ(at(34, 14), 0x000000FFU);
    EXPECT_EQ(at(24, 24), 0x000000FFU);
    EXPECT_EQ(at(34, 24), 0x0000FF00U);
}

// Two objects coincide, and so do the two meshes of their model, so that the order of drawing could
// matter.
TEST(SurfacePaint, PaintDependsNeitherOnThreadsNorOnWhereRowsAreSplit) {
    const std::vector<SurfaceTexture> textures{noise({64, 64}, 5), noise({16, 16}, 6)};
    auto twice = modelOf(ball(0.15F, 64), textured(0), textures);
    twice->materials.push_back(textured(1));
    twice->meshes.push_back(twice->meshes.front());
    twice->meshes.back().material = 1;
    Scene scene = sceneOf({{twice, placed(0.8, {0, 0, 0.5}), 1},
                           {twice, placed(0.8, {0.05, 0, 0.5}), 0.9F},
                           {twice, placed(0.8, {0, 0, 0.5}), 1}});
    // A planar shadow catcher would not be drawn. So this one is bent. It has no paint.
    scene.catcher.positions = {{-1, -1, 0.4F}, {1, -1, 0.4F}, {1, 1, 0.5F}, {-1, 1, 0.4F}};
    scene.catcher.triangles = {{0, 1, 2}, {0, 2, 3}};
    const Words one = paintOf(scene);
    EXPECT_EQ(one, paintOf(scene, 3));
    EXPECT_EQ(one.front(), PaintWords{});
    SurfaceRaster raster(paintCamera(), nullptr);
    raster.setScene(scene);
    raster.draw({}, {7, 3, 51, 37});
    Words row(kPainted.width + 8);
    for (int y = 3; y < 37; ++y) {
        raster.paintRow(y, 13, 50, row.data());
        for (int x = 13; x < 50; ++x)
            ASSERT_EQ(row[static_cast<std::size_t>(x) - 13],
                      one[static_cast<std::size_t>(y) * kPainted.width + x])
                << x << " " << y;
    }
}

TEST(SurfacePaint, ANewSceneIsPaintedAfterSetScene) {
    const auto made = [](unsigned seed) {
        return modelOf(square(), textured(), {noise({32, 16}, seed)});
    };
    const auto one = made(1), two = made(2), three = made(3);
    const Scene first =
        sceneOf({{one, placed(0, {-0.1, 0, 1}), 1}, {two, placed(0, {0.2, 0, 1}), 1}});
    const Scene second = sceneOf({{three, placed(0, {-0.2, 0, 1}), 1},
                                  {one, placed(0.5, {0.05, 0, 1}), 1},
                                  {one, placed(0.1, {0.2, 0, 1.1}), 1}});
    const Scene moved =
        sceneOf({{one, placed(0.4, {0, 0, 1}), 1}, {three, placed(0, {0.1, 0, 1}), 1}});
    SurfaceRaster raster(paintCamera(), nullptr);
    for (const Scene& scene : {first, second, moved, sceneOf({}), first}) {
        raster.setScene(scene);
        raster.draw({}, {0, 0, kPainted.width, kPainted.height});
        EXPECT_EQ(paintOf(raster), paintOf(scene));
    }
}

}  // namespace
}  // namespace mfar::simd
