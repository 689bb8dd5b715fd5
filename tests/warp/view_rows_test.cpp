#include "base/gl/pass.h"
#include "pipeline/composite/pass_values.h"
#include "pipeline/gles/traced_textures.h"
#include "pipeline/simd/surface_raster.h"
#include "pipeline/simd/view_rows.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/traced_picture.h"
#include "tests/engine/gl_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mfar {
namespace {

constexpr Size kSize{16, 8};
constexpr std::size_t kPixels = std::size_t{16} * 8;
constexpr int kBareColumn = 3;  // shows no shadow
constexpr int kObjectX = 10, kObjectY = 5;
constexpr int kShadow = 100;  // alpha of the shadow

std::uint32_t surfaceWord(float z, std::uint32_t number) {
    return packedSurface({.z = z, .id = static_cast<float>(number), .known = 1});
}

/// A slanted shadow catcher, whose z changes by 7 % from row to row, as seen in the traced picture
/// and from a camera that moved parallel to it.
struct Ground {
    Eigen::Vector4d plane{0, 0.9, 0.436, 0.436};
    CameraModel camera;
    RigidTransform T_traced_layer;
    std::vector<std::uint32_t> traced;
    std::vector<std::array<std::uint8_t, 4>> colours;

    Ground() : traced(kPixels), colours(kPixels) {
        camera.size = kSize;
        camera.fx = camera.fy = 32;
        camera.cx = 7.5;
        camera.cy = 3.5;
        T_traced_layer.translation = {-0.01, 0.02 * 0.436, -0.02 * 0.9};
        for (int y = 0; y < kSize.height; ++y)
            for (int x = 0; x < kSize.width; ++x) {
                const bool isObject = x == kObjectX && y == kObjectY;
                if (x == kBareColumn) continue;
                traced[index(x, y)] = surfaceWord(depth(x, y), isObject ? 7 : simd::kCatcherNumber);
                colours[index(x, y)] = {0, 0, 0, kShadow};
            }
    }
    static std::size_t index(int x, int y) {
        return static_cast<std::size_t>(y) * kSize.width + static_cast<std::size_t>(x);
    }
    [[nodiscard]] Eigen::Vector3d ray(int x, int y) const {
        return camera.unproject(Eigen::Vector2d(x, y)).homogeneous();
    }
    [[nodiscard]] float depth(int x, int y) const {
        return static_cast<float>(plane.w() / plane.head<3>().dot(ray(x, y)));
    }

    /// Expected alpha, or nothing if the pixel must be looked up one by one.
    [[nodiscard]] std::optional<double> alphaAt(int x, int y) const {
        const Eigen::Vector3d point =
            T_traced_layer * (static_cast<double>(depth(x, y)) * ray(x, y));
        const Eigen::Vector2d at = camera.project(point.hnormalized());
        const int lowX = static_cast<int>(std::floor(at.x())),
                  lowY = static_cast<int>(std::floor(at.y()));
        if (lowX < 0 || lowY < 0 || lowX > kSize.width - 2 || lowY > kSize.height - 2) return {};
        double sum = 0;
        for (int i = 0; i < 4; ++i) {
            const int right = i & 1, down = i >> 1;
            if (lowX + right == kObjectX && lowY + down == kObjectY) return {};
            const double fx = at.x() - lowX, fy = at.y() - lowY;
            sum += (right != 0 ? fx : 1 - fx) * (down != 0 ? fy : 1 - fy) *
                   colours[index(lowX + right, lowY + down)][3];
        }
        return sum;
    }
};

/// For each pixel, its alpha, or nothing if it was left to be looked up one by one.
using GroundAlpha = std::vector<std::optional<int>>;

/// `isPlane`: the shadow catcher is given as a plane. Otherwise it is drawn as a mesh.
GroundAlpha shownBySimd(const Ground& ground, bool isPlane) {
    constexpr std::size_t kRow = 16, kPadding = 16;
    GroundAlpha out(kPixels);
    for (int y = 0; y < kSize.height; ++y) {
        std::vector<std::uint32_t> quarters(2 * (kRow + kPadding)), colour(kRow + kPadding),
            state(colour), left(colour);
        std::vector<float> rayX(kRow + kPadding), rayY(rayX), depth(rayX);
        for (int x = 0; x < kSize.width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            rayX[i] = static_cast<float>(ground.ray(x, y).x());
            rayY[i] = static_cast<float>(ground.ray(x, y).y());
            if (!isPlane)
                quarters[2 * i] = quarters[2 * i + 1] =
                    surfaceWord(ground.depth(x, y), simd::kCatcherNumber);
        }
        const Eigen::Vector4f plane = ground.plane.cast<float>();
        simd::ViewLookUpInput input{simd::pointTransformOf(ground.T_traced_layer),
                                    simd::pointLensOf(LensProjection(ground.camera)),
                                    kSize,
                                    ground.traced.data(),
                                    reinterpret_cast<const std::uint32_t*>(ground.colours.data()),
                                    nullptr,
                                    {},
                                    1};
        if (isPlane) input.plane = {plane.x(), plane.y(), plane.z(), plane.w()};
        const int lefts =
            simd::lookUpRow({kSize.width, quarters.data(), quarters.data(), nullptr, rayX.data(),
                             rayY.data(), colour.data(), depth.data(), state.data(), left.data()},
                            input);
        for (std::size_t x = 0; x < kRow; ++x)
            out[Ground::index(static_cast<int>(x), y)] = static_cast<int>(colour[x] >> 24);
        for (const std::uint32_t x : std::span(left).first(static_cast<std::size_t>(lefts)))
            out[Ground::index(static_cast<int>(x), y)].reset();
    }
    return out;
}

GroundAlpha shownByGles(const Ground& ground, bool isPlane) {
    std::vector<std::uint32_t> quarters(4 * kPixels);
    for (int y = 0; !isPlane && y < 2 * kSize.height; ++y)
        for (int x = 0; x < 2 * kSize.width; ++x)
            quarters[static_cast<std::size_t>(2 * kSize.width * y + x)] =
                surfaceWord(ground.depth(x / 2, y / 2), simd::kCatcherNumber);
    const auto words = [](Size size, const std::vector<std::uint32_t>& values) {
        gpu::Texture out(size, gpu::TexelFormat::R32Ui);
        out.upload(std::span<const std::uint32_t>(values));
        return out;
    };
    const gpu::Texture silhouette = words({2 * kSize.width, 2 * kSize.height}, quarters),
                       surfaces = words(kSize, ground.traced);
    const gpu::Texture rays = rayTexture(ground.camera), none({1, 1}, gpu::TexelFormat::Rgba8);
    gpu::Texture colours(kSize, gpu::TexelFormat::Rgba8, gpu::Filter::Linear);
    colours.uploadRows(ground.colours);
    const gpu::Texture colour(kSize, gpu::TexelFormat::Rgba8), depth(kSize, gpu::TexelFormat::R32F),
        state(kSize, gpu::TexelFormat::Rgba8);
    params::LookUpViews p{};
    p.views[0].toView = transformOf(ground.T_traced_layer);
    p.projections[0] = p.projections[1] = projectionOf(LensProjection(ground.camera));
    const Eigen::Vector4f plane = ground.plane.cast<float>();
    if (isPlane) p.plane = {plane.x(), plane.y(), plane.z(), plane.w()};
    p.tracedWidth = p.width = kSize.width;
    p.tracedHeight = p.height = kSize.height;
    p.texels = 4;
    gpu::DrawPass<params::LookUpViews>("warp_look_up.frag")
        .run(p,
             {gpu::sampler(0, silhouette), gpu::sampler(1, rays), gpu::sampler(2, colours),
              gpu::sampler(3, surfaces), gpu::sampler(7, none), gpu::sampler(8, none),
              gpu::sampler(9, none), gpu::sampler(10, none)},
             gpu::Framebuffer(std::array<const gpu::Texture*, 3>{&colour, &depth, &state}));
    const std::vector<std::uint8_t> shown = colour.readRgba8(), states = state.readRgba8();
    GroundAlpha out(kPixels);
    for (std::size_t i = 0; i < kPixels; ++i)
        if (states[4 * i + 1] == 0) out[i] = shown[4 * i + 3];
    return out;
}

void expectGround(const Ground& ground, const GroundAlpha& shown) {
    int plain = 0;
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
            const std::optional<double> expected = ground.alphaAt(x, y);
            const std::optional<int> got = shown[Ground::index(x, y)];
            ASSERT_EQ(got.has_value(), expected.has_value()) << x << ", " << y;
            if (!got) continue;
            ++plain;
            EXPECT_NEAR(*got, *expected, 1.5) << x << ", " << y;
        }
    EXPECT_GT(plain, 80);
}

bool isNothingPlain(const GroundAlpha& shown) {
    return std::ranges::none_of(shown, [](const auto& pixel) { return pixel.has_value(); });
}

using PlainGroundGl = GlTest;

// A pixel that is looked up one by one takes several times as long.
TEST(PlainGround, OnASlantedPlaneAllPixelsWithoutObjectsArePlain) {
    const Ground ground;
    expectGround(ground, shownBySimd(ground, true));
}

TEST_F(PlainGroundGl, OnASlantedPlaneAllPixelsWithoutObjectsArePlain) {
    const Ground ground;
    expectGround(ground, shownByGles(ground, true));
}

// A mesh may have several surfaces one behind the other.
TEST(PlainGround, OnAMeshPixelsOfDifferentDepthAreNotPlain) {
    EXPECT_TRUE(isNothingPlain(shownBySimd(Ground(), false)));
}

TEST_F(PlainGroundGl, OnAMeshPixelsOfDifferentDepthAreNotPlain) {
    EXPECT_TRUE(isNothingPlain(shownByGles(Ground(), false)));
}

}  // namespace
}  // namespace mfar
