#include "pipeline/epipolar/epipolar_lens.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mfar {
namespace {

CameraModel pincushion() {
    return {{161, 119}, 150, 150, 80, 59, {0.15, 0.03, 0, 0, 0.01}};
}

// A lens model that is valid only a little beyond the picture's corners. It would project rays from
// farther outside back into the picture.
CameraModel fisheye() {
    return {{161, 119}, 110, 110, 80, 59, {-0.17, 0, 0, 0, 0}};
}

double rimOf(const CameraModel& camera) {
    double rim = 0;
    for (const double x : {0.0, camera.size.width - 1.0})
        for (const double y : {0.0, camera.size.height - 1.0})
            rim = std::max(rim, camera.unproject({x, y}).norm());
    return rim;
}

TEST(EpipolarLens, RaysMatchThePixelsOfEveryPyramidLevel) {
    for (const CameraModel& camera :
         {test::oddPlain(), test::oddBarrel(), pincushion(), fisheye()}) {
        Size size = camera.size;
        for (int level = 0; level < 4; ++level) {
            const EpipolarLens lens(camera, level);
            ASSERT_EQ(lens.size(), size);
            const double scale = 1 << level;
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    // A pixel of this level covers scale x scale pixels. Its ray goes through their
                    // common centre.
                    const Eigen::Vector2d ray = camera.unproject(
                        {scale * x + 0.5 * (scale - 1), scale * y + 0.5 * (scale - 1)});
                    const std::size_t p = static_cast<std::size_t>(y) * size.width + x;
                    ASSERT_NEAR(lens.rayX(p), ray.x(), 1e-6);
                    ASSERT_NEAR(lens.rayY(p), ray.y(), 1e-6);
                }
            }
            size = {(size.width + 1) / 2, (size.height + 1) / 2};
        }
    }
}

TEST(EpipolarLens, CopiesShareRaysUntilOneIsCropped) {
    const EpipolarLens whole(fisheye(), 1);
    EpipolarLens part = whole;
    EXPECT_EQ(part.raysX().data(), whole.raysX().data());
    const auto copied = [](const auto& rays) { return std::vector(rays.begin(), rays.end()); };
    const std::vector<float> x = copied(whole.raysX()), y = copied(whole.raysY());
    const Size size = whole.size();
    for (const PixelRect& pixels :
         {PixelRect{2, 1, 9, 6}, PixelRect{0, 3, 4, 5}, PixelRect{1, 0, size.width, 2}}) {
        part.cover(whole, pixels);
        EXPECT_EQ(whole.raysX(), x);
        EXPECT_EQ(whole.raysY(), y);
        ASSERT_EQ(part.size(), (Size{pixels.x1 - pixels.x0, pixels.y1 - pixels.y0}));
        const std::size_t last = part.raysX().size() - 1;
        const std::size_t same =
            static_cast<std::size_t>(pixels.y1 - 1) * size.width + pixels.x1 - 1;
        EXPECT_EQ(part.rayX(last), x[same]);
        EXPECT_EQ(part.rayY(last), y[same]);
    }
    part.cover(whole, {0, 0, size.width, size.height});
    EXPECT_EQ(part.raysX().data(), whole.raysX().data());
}

TEST(EpipolarLens, ProjectsAsTheCameraDoesWithinThePicture) {
    std::mt19937 random(3);
    for (const CameraModel& camera :
         {test::oddPlain(), test::oddBarrel(), pincushion(), fisheye()}) {
        std::uniform_real_distribution<double> x(-0.5, camera.size.width - 0.5);
        std::uniform_real_distribution<double> y(-0.5, camera.size.height - 0.5);
        for (int level = 0; level < 3; ++level) {
            const EpipolarLens lens(camera, level);
            for (int i = 0; i < 2000; ++i) {
                const Eigen::Vector2d ray = camera.unproject({x(random), y(random)});
                if (ray.norm() > rimOf(camera)) continue;
                const Eigen::Vector2d fine = camera.project(ray);
                const auto p =
                    lens.project(static_cast<float>(ray.x()), static_cast<float>(ray.y()));
                ASSERT_NEAR(p.x, (fine.x() + 0.5) / (1 << level) - 0.5, 1e-3);
                ASSERT_NEAR(p.y, (fine.y() + 0.5) / (1 << level) - 0.5, 1e-3);
            }
        }
    }
}

TEST(EpipolarLens, RaysProjectBackToTheirPixels) {
    for (const CameraModel& camera :
         {test::oddPlain(), test::oddBarrel(), pincushion(), fisheye()}) {
        const EpipolarLens lens(camera, 1);
        for (int y = 0; y < lens.size().height; ++y) {
            for (int x = 0; x < lens.size().width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * lens.size().width + x;
                const auto p = lens.project(lens.rayX(i), lens.rayY(i));
                ASSERT_NEAR(p.x, x, 1e-3);
                ASSERT_NEAR(p.y, y, 1e-3);
            }
        }
    }
}

// As the angle between a ray and the optical axis grows, the ray's projection must never move back
// towards the centre of the picture.
TEST(EpipolarLens, ProjectionNeverFoldsBack) {
    for (const CameraModel& camera :
         {test::oddPlain(), test::oddBarrel(), pincushion(), fisheye()}) {
        const EpipolarLens lens(camera, 0);
        const auto centre = lens.project(0, 0);
        for (int a = 0; a < 64; ++a) {
            const double angle = 2 * std::numbers::pi * a / 64;
            double last = -1;
            for (double r = 0; r < 50; r = r * 1.02 + 0.005) {
                const auto p = lens.project(static_cast<float>(r * std::cos(angle)),
                                            static_cast<float>(r * std::sin(angle)));
                const double far = std::hypot(p.x - centre.x, p.y - centre.y);
                ASSERT_GE(far, last - 0.01) << "radius " << r;
                last = far;
            }
        }
    }
}

TEST(EpipolarLens, RaysBeyondTheCornersStayOutsideThePicture) {
    for (const CameraModel& camera :
         {test::oddPlain(), test::oddBarrel(), pincushion(), fisheye()}) {
        const EpipolarLens lens(camera, 0);
        for (const double r : {1.05, 1.3, 2.0, 5.0, 1e3, 1e6}) {
            for (int a = 0; a < 64; ++a) {
                const double angle = 2 * std::numbers::pi * a / 64;
                const auto p =
                    lens.project(static_cast<float>(r * rimOf(camera) * std::cos(angle)),
                                 static_cast<float>(r * rimOf(camera) * std::sin(angle)));
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
                EXPECT_TRUE(p.x < 0 || p.y < 0 || p.x > camera.size.width - 1.0F ||
                            p.y > camera.size.height - 1.0F)
                    << p.x << ',' << p.y << " at " << r;
            }
        }
    }
}

TEST(EpipolarLens, InverseDepthInTheSecondViewDeterminesThePixel) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const CameraModel& camera : {test::oddPlain(), test::oddBarrel()}) {
        const EpipolarLens lens(camera, 0);
        for (int i = 0; i < 1000; ++i) {
            const Eigen::Vector2d r(0.3 * unit(random), 0.25 * unit(random));
            const Eigen::Vector3d t(0.2 * unit(random), 0.2 * unit(random), 0.5 * unit(random));
            const double z = 2 + unit(random);
            const Eigen::Vector3d moved = z * r.homogeneous() + t;
            const double s = 1 / (z + t.z());
            EXPECT_NEAR(s / (1 - s * t.z()), 1 / z, 1e-12);
            const Eigen::Vector2d ray = r + s * (t.head<2>() - r * t.z());
            ASSERT_LT((ray - moved.hnormalized()).norm(), 1e-12);
            if (ray.norm() > rimOf(camera)) continue;
            const auto p = lens.project(static_cast<float>(ray.x()), static_cast<float>(ray.y()));
            const Eigen::Vector2d truth = camera.project(moved.hnormalized());
            ASSERT_NEAR(p.x, truth.x(), 1e-3);
            ASSERT_NEAR(p.y, truth.y(), 1e-3);
        }
    }
}

}  // namespace
}  // namespace mfar
