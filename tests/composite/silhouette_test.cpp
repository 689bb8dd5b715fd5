#include "pipeline/composite/silhouette.h"
#include "pipeline/results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace mfar {
namespace {

const CameraModel kCamera{{157, 123}, 150, 152, 82.5, 57.1, {-0.28, 0.07, 0.002, -0.001, 0.004}};
const RigidTransform kPose{Eigen::Quaterniond(0.7, 0.3, -0.5, 0.4).normalized(), {1, 2, -0.5}};

VirtualObject at(const Eigen::Vector3d& inCamera, VirtualShape shape = VirtualShape::Sphere,
                 double size = 0.4) {
    VirtualObject o;
    o.shape = shape;
    o.size = size * Eigen::Vector3d(1, 1, 1);
    o.T_world_object =
        kPose * RigidTransform{Eigen::Quaterniond(0.9, 0.2, 0.1, -0.4).normalized(), inCamera};
    return o;
}

int covered(const std::vector<SurfaceRange>& tiles) {
    return static_cast<int>(
        std::count_if(tiles.begin(), tiles.end(), [](const auto& t) { return t.farthest > 0; }));
}

Eigen::Vector3d surfacePoint(VirtualShape shape, Eigen::Vector3d p) {
    if (shape == VirtualShape::Sphere) return 0.5 * p.normalized();
    if (shape == VirtualShape::Quad) return 0.5 * Eigen::Vector3d(p.x(), p.y(), 0);
    return 0.5 * p / p.cwiseAbs().maxCoeff();
}

TEST(Silhouette, EveryPixelNearASurfacePointIsCovered) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    const int margin = 5;
    Silhouette silhouette(kCamera, margin);
    const Size tiles = silhouette.tileCount();
    for (const VirtualShape shape : {VirtualShape::Box, VirtualShape::Sphere, VirtualShape::Quad}) {
        const std::vector<VirtualObject> objects{at({0.1, 0, 1.2}, shape),
                                                 at({-0.5, 0.3, 1}, shape)};
        const auto& ranges = silhouette.run(objects, kPose);
        for (int i = 0; i < 20000; ++i) {
            const VirtualObject& o = objects[i % 2];
            const Eigen::Vector3d onSurface =
                surfacePoint(shape, {unit(random), unit(random), unit(random)});
            const Eigen::Vector3d p =
                kPose.inverse() * (o.T_world_object * o.size.cwiseProduct(onSurface));
            const Eigen::Vector2d pixel =
                kCamera.project(p.hnormalized()) +
                margin * Eigen::Vector2d(std::round(unit(random)), std::round(unit(random)));
            const Eigen::Array2i tile = ((pixel.array() + 0.5) / kTileSize).floor().cast<int>();
            if (tile.x() < 0 || tile.y() < 0 || tile.x() >= tiles.width || tile.y() >= tiles.height)
                continue;
            const SurfaceRange& r = ranges[tile.y() * tiles.width + tile.x()];
            // The corners of a sphere's triangles lie on the sphere. So the triangles lie below its
            // surface, by less than two thousandths of the radius, which is 0.2 m.
            ASSERT_LE(r.nearest, p.z() + 1e-3);
            ASSERT_GE(r.farthest, p.z() - 1e-3);
        }
    }
}

TEST(Silhouette, TilesAwayFromObjectsAreNotCovered) {
    // A sphere of radius 0.1 at 2 m has a radius of about 8 px around the principal point.
    Silhouette silhouette(kCamera, 0);
    const auto& ranges =
        silhouette.run(std::vector{at({0, 0, 2}, VirtualShape::Sphere, 0.2)}, kPose);
    const Size tiles = silhouette.tileCount();
    EXPECT_EQ(tiles, (Size{10, 8}));
    for (int y = 0; y < tiles.height; ++y)
        for (int x = 0; x < tiles.width; ++x) {
            const bool near = 16 * x - 11 < 82.5 && 82.5 < 16 * x + 27 && 16 * y - 11 < 57.1 &&
                              57.1 < 16 * y + 27;
            const SurfaceRange& r = ranges[y * tiles.width + x];
            if (!near) {
                EXPECT_EQ(r.farthest, 0) << x << " " << y;
            }
            if (r.farthest > 0) {
                EXPECT_TRUE(r.nearest > 1.89 && r.farthest < 2.11);
            }
        }
    EXPECT_GT(covered(ranges), 1);
}

TEST(Silhouette, TheConfiguredMarginWidensTheSilhouette) {
    const std::vector objects{at({0, 0, 2}, VirtualShape::Sphere, 0.2)};
    int before = 0;
    for (const int margin : {0, 20, 40, 1000}) {
        Silhouette silhouette(kCamera, margin);
        const int now = covered(silhouette.run(objects, kPose));
        EXPECT_GT(now, before);
        before = now;
    }
    EXPECT_EQ(before, 80);
}

TEST(Silhouette, ObjectsOutOfViewOrWithAnInvalidPoseCoverNothing) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Silhouette silhouette(kCamera, 4);
    ASSERT_GT(covered(silhouette.run(std::vector{at({0, 0, 1})}, kPose)), 0);
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(3, 0, 1), Eigen::Vector3d(0, -4, 2),
          Eigen::Vector3d(kNan, 0, 1), Eigen::Vector3d(0, 0, 1e300),
          Eigen::Vector3d(0, 0, std::numeric_limits<double>::infinity())})
        EXPECT_EQ(covered(silhouette.run(std::vector{at(p)}, kPose)), 0) << p.transpose();
    EXPECT_EQ(covered(silhouette.run({}, kPose)), 0);
}

TEST(Silhouette, SurfacesAroundTheCameraCoverTheWholePictureAndAreCutAtTheNearPlane) {
    Silhouette silhouette(kCamera, 0);
    EXPECT_EQ(covered(silhouette.run(std::vector{at({0, 0, 0.1}, VirtualShape::Box, 3)}, kPose)),
              80);
    const auto& cut =
        silhouette.run(std::vector{at({0, 0, 0.011}, VirtualShape::Quad, 0.02)}, kPose);
    float nearest = std::numeric_limits<float>::max();
    for (const SurfaceRange& r : cut)
        if (r.farthest > 0) nearest = std::min(nearest, r.nearest);
    EXPECT_NEAR(nearest, LensProjection::kNear, 1e-6);
}

}  // namespace
}  // namespace mfar
