#include "pipeline/composite/preview_renderer.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/samples_passed.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/ray_cast.h"

#include <limits>
#include <numbers>

namespace mfar {
namespace {

using Preview = GlTest;

constexpr Size kVideo{160, 120};
constexpr Size kOutput{576, 432};

CameraModel lens() {
    CameraModel c = plainRig(kVideo, kVideo).video;
    c.cx += 3.4;
    c.cy -= 2.2;
    c.distortion = {-0.28, 0.07, 0.002, -0.001, 0.004};
    return c;
}

RigidTransform turned(const Eigen::Vector3d& axisAngle, const Eigen::Vector3d& at) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(axisAngle.norm(), axisAngle.normalized())), at};
}

VirtualObject object(VirtualShape shape, const Eigen::Vector3d& size, const RigidTransform& pose) {
    VirtualObject o;
    o.shape = shape;
    o.size = size;
    o.T_world_object = pose;
    return o;
}

std::vector<VirtualObject> objects() {
    return {
        object(VirtualShape::Sphere, {0.8, 0.8, 0.8}, turned({0.3, 0.1, 0}, {0.1, -0.05, 1.5})),
        object(VirtualShape::Sphere, {0.3, 0.9, 0.5}, turned({0.1, 0.4, 0.9}, {-0.4, 0.2, 1.4})),
        object(VirtualShape::Box, {0.7, 0.5, 0.6}, turned({0.5, -0.7, 0.3}, {-0.1, 0.1, 1.6})),
        object(VirtualShape::Quad, {1.1, 0.9, 5}, turned({0.6, 0.2, 0.1}, {0.1, 0.1, 1.5})),
        object(VirtualShape::Quad, {1.1, 0.9, 0}, turned({3.0, 0.2, 0.3}, {0, 0, 1.5})),
    };
}

// A camera pose away from the world's origin and not upright. Objects are given in the camera's
// frame.
const RigidTransform kPose = turned({0.4, -1.1, 0.7}, {2, -3, 1});

std::vector<VirtualObject> inWorld(std::vector<VirtualObject> inCamera) {
    for (VirtualObject& o : inCamera)
        o.T_world_object = kPose * o.T_world_object;
    return inCamera;
}

twin::DepthPicture depthOf(const VirtualLayer& layer) {
    twin::DepthPicture out{layer.depth->size(), {}};
    const auto rgba = layer.depth->readRgba32F();
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        out.z.push_back(rgba[i]);
    return out;
}

/// Silhouettes must agree within a pixel. Depth may have a relative error of `exactness`, because
/// triangles are flat, and of 3 % beside a silhouette.
void expectAlike(const twin::DepthPicture& drawn, const twin::DepthPicture& truth,
                 double exactness = 1e-3) {
    ASSERT_EQ(drawn.size, truth.size);
    int covered = 0;
    for (int y = 0; y < truth.size.height; ++y) {
        for (int x = 0; x < truth.size.width; ++x) {
            const double z = drawn.at(x, y);
            const auto [least, most] = truth.around(x, y);
            const double tolerance = least > 0 ? exactness : 0.03;
            ASSERT_TRUE(z >= least * (1 - tolerance) && z <= most * (1 + tolerance))
                << x << " " << y << ": " << z << " of " << least << " to " << most;
            ASSERT_TRUE(truth.at(x, y) == 0 || drawn.around(x, y)[1] > 0) << x << " " << y;
            covered += z > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(covered, 2000);
}

TEST_F(Preview, ShapesAreDrawnThroughTheLensAtTheRightPixels) {
    PreviewRenderer renderer(lens(), kOutput);
    for (const VirtualObject& o : inWorld(objects()))
        expectAlike(depthOf(renderer.render(std::array{o}, kPose)),
                    twin::rayCast({o}, kPose, lens().scaledTo(kOutput), LensProjection::kNear));
}

TEST_F(Preview, NearerObjectsHideFartherOnesInAnyOrderOfDrawing) {
    PreviewRenderer renderer(lens(), kOutput);
    std::vector<VirtualObject> all = inWorld(objects());
    const auto truth = twin::rayCast(all, kPose, lens().scaledTo(kOutput), LensProjection::kNear);
    expectAlike(depthOf(renderer.render(all, kPose)), truth);
    std::reverse(all.begin(), all.end());
    expectAlike(depthOf(renderer.render(all, kPose)), truth);
}

TEST_F(Preview, SurfacesAroundAndBehindTheCameraAreDrawnCorrectly) {
    // The model of this lens projects rays from far beyond the picture's corners back into the
    // picture.
    CameraModel folding = plainRig(kVideo, kVideo).video;
    folding.fx = folding.fy = 130;
    folding.distortion = {-0.17, 0, 0, 0, 0};
    // The surfaces are a wall beside the camera, a wall 13 mm from the camera, and a floor that
    // begins behind the camera. The tolerance is 5 %, because a surface is drawn as flat cells. The
    // lens shows straight edges as curves, and the cells do not follow these. Near the camera, this
    // changes depth by a few percent.
    for (const CameraModel& camera : {lens(), folding}) {
        PreviewRenderer renderer(camera, kOutput);
        for (const VirtualObject& o : inWorld({
                 object(VirtualShape::Quad, {3, 2, 0}, turned({0.1, 1.3, 0.2}, {-0.4, 0.1, 0.5})),
                 object(VirtualShape::Quad, {0.05, 0.05, 0}, turned({0, 1.2, 0}, {0.01, 0, 0.01})),
                 object(VirtualShape::Quad, {4, 4, 0}, turned({1.45, 0.1, 0}, {0, 0.5, 0.5})),
             }))
            expectAlike(depthOf(renderer.render(std::array{o}, kPose)),
                        twin::rayCast({o}, kPose, camera.scaledTo(kOutput), LensProjection::kNear),
                        0.05);
    }
}

TEST_F(Preview, ObjectsThatAreOutOfViewOrNotFiniteAreNotDrawn) {
    PreviewRenderer renderer(lens(), kOutput);
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const auto box = [](const Eigen::Vector3d& at, const Eigen::Vector3d& size) {
        return object(VirtualShape::Box, size, {Eigen::Quaterniond::Identity(), at});
    };
    const Eigen::Vector3d unit(0.5, 0.5, 0.5);
    ASSERT_TRUE(drewAnything([&] { renderer.render(inWorld({box({0, 0, 2}, unit)}), kPose); }));
    for (const VirtualObject& o :
         inWorld({box({0, 0, -2}, unit), box({4, 0, 2}, unit), box({0, -9, 1}, unit),
                  box({0, kNan, 2}, unit), box({0, 0, kInfinite}, unit), box({0, 0, 1e6}, unit),
                  box({0, 0, 2}, {kNan, 1, 1}), box({0, 0, 2}, {1, kInfinite, 1})}))
        EXPECT_FALSE(drewAnything([&] {
            EXPECT_TRUE(renderer.render(std::array{o}, kPose).bounds.empty());
        })) << o.T_world_object.translation.transpose();
    EXPECT_FALSE(drewAnything([&] { renderer.render({}, kPose); }));
    RigidTransform broken = kPose;
    broken.translation.x() = kNan;
    EXPECT_TRUE(renderer.render(inWorld({box({0, 0, 2}, unit)}), broken).bounds.empty());
}

/// Smallest and largest distance between a side of the layer's bounds and the covered pixels [px].
std::array<int, 2> slackOf(const VirtualLayer& layer) {
    const twin::DepthPicture z = depthOf(layer);
    PixelRect covered{kOutput.width, kOutput.height, 0, 0};
    for (int y = 0; y < kOutput.height; ++y)
        for (int x = 0; x < kOutput.width; ++x)
            if (z.at(x, y) > 0)
                covered = {std::min(covered.x0, x), std::min(covered.y0, y),
                           std::max(covered.x1, x + 1), std::max(covered.y1, y + 1)};
    const PixelRect& b = layer.bounds;
    const auto [least, most] =
        std::minmax({covered.x0 - b.x0, covered.y0 - b.y0, b.x1 - covered.x1, b.y1 - covered.y1});
    return {least, most};
}

TEST_F(Preview, TheLayersBoundsEncloseCoveredPixelsTightly) {
    PreviewRenderer renderer(lens(), kOutput);
    struct Case {
        Eigen::Vector2d shift;
        int most;  // limit [px]; as wide as a mesh cell if the picture's border cuts the object
    };
    for (const Case& c :
         {Case{{0, 0}, 3}, Case{{-0.7, 0.1}, 16}, Case{{0.7, -0.5}, 16}, Case{{0.1, 0.6}, 16}}) {
        VirtualObject o = objects()[2];
        o.size *= 0.7;
        o.T_world_object.translation.head<2>() += c.shift;
        const VirtualLayer& layer = renderer.render(inWorld({o}), kPose);
        const PixelRect& b = layer.bounds;
        EXPECT_TRUE(b.x0 >= 0 && b.y0 >= 0 && b.x1 <= kOutput.width && b.y1 <= kOutput.height);
        const auto [least, most] = slackOf(layer);
        EXPECT_GE(least, 0) << c.shift.transpose();
        EXPECT_LE(most, c.most) << c.shift.transpose();
    }
}

TEST_F(Preview, NothingOfEarlierFramesIsVisible) {
    PreviewRenderer renderer(lens(), kOutput), fresh(lens(), kOutput);
    const std::vector<VirtualObject> all = inWorld(objects());
    renderer.render(all, kPose);
    const VirtualLayer& layer = renderer.render(std::span(all).subspan(1, 1), kPose);
    const VirtualLayer& alone = fresh.render(std::span(all).subspan(1, 1), kPose);
    EXPECT_EQ(layer.bounds, alone.bounds);
    EXPECT_EQ(layer.colour->readRgba8(), alone.colour->readRgba8());
    EXPECT_EQ(depthOf(layer).z, depthOf(alone).z);
    const auto empty = renderer.render({}, kPose).colour->readRgba8();
    EXPECT_EQ(std::count(empty.begin(), empty.end(), 0), static_cast<long>(empty.size()));
}

/// Red of a plain quad in front of the camera, 0 to 255. `angle`: between the quad's normal and the
/// light [rad].
int litQuad(double angle, double ambient) {
    PreviewRenderer renderer(
        lens(), kOutput,
        {.towards = kPose.rotation * Eigen::Vector3d(0, std::sin(angle), -std::cos(angle)),
         .ambient = ambient});
    VirtualObject o = object(VirtualShape::Quad, {1, 1, 0}, turned({0.1, 0, 0}, {0, 0, 1}));
    o.T_world_object.rotation = Eigen::Quaterniond::Identity();
    o.colours = {Eigen::Vector3f{0.8F, 0.8F, 0.8F}, Eigen::Vector3f{0.8F, 0.8F, 0.8F}};
    const auto rgba = renderer.render(inWorld({o}), kPose).colour->readRgba8();
    return rgba[4UL * (200UL * kOutput.width + 280)];
}

TEST_F(Preview, ShadingFollowsLambertsLawPlusAmbientLight) {
    for (const double degrees : {0.0, 30.0, 60.0, 85.0, 120.0})
        for (const double ambient : {0.0, 0.35, 1.0}) {
            const double angle = degrees * std::numbers::pi / 180;
            const double wanted =
                0.8 * std::lerp(std::max(0.0, std::cos(angle)), 1.0, ambient) * 255;
            EXPECT_NEAR(litQuad(angle, ambient), wanted, 0.6) << degrees << " " << ambient;
        }
}

TEST_F(Preview, ColoursAlternateBetweenTheSquaresOfACheckerboard) {
    const CameraModel flat = plainRig(kVideo, kVideo).video;
    PreviewRenderer renderer(flat, kOutput, {.ambient = 1});
    VirtualObject o = object(VirtualShape::Quad, {0.6, 0.6, 0}, {});
    o.T_world_object.translation = {0, 0, 1};
    o.colours = {Eigen::Vector3f{1, 0, 0}, Eigen::Vector3f{0, 1, 0}};
    o.squares = 3;
    const auto rgba = renderer.render(inWorld({o}), kPose).colour->readRgba8();
    const CameraModel camera = flat.scaledTo(kOutput);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const Eigen::Vector2d p = camera.project({0.2 * i, 0.2 * j});
            const auto at = 4 * (std::lround(p.y()) * kOutput.width + std::lround(p.x()));
            const bool first = (i + j) % 2 == 0;
            EXPECT_EQ(rgba[at], first ? 255 : 0) << i << " " << j;
            EXPECT_EQ(rgba[at + 1], first ? 0 : 255);
            EXPECT_EQ(rgba[at + 3], 255);
        }
}

}  // namespace
}  // namespace mfar
