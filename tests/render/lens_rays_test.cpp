#include "pipeline/render/lens_rays.h"
#include "pipeline/render/view_bounds.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar {
namespace {

CameraModel wideLens() {
    return {{321, 243}, 200, 205, 163.2, 118.7, {-0.28, 0.07, 0.001, -0.0007, 0}};
}

TEST(LensRays, RaysMatchUnprojectToWithinATwentiethOfAPixel) {
    for (const CameraModel& camera :
         {wideLens(), CameraModel{{7, 5}, 6, 6, 3, 2, {}}, CameraModel{{1, 1}, 1, 1, 0, 0, {}}}) {
        const LensRays rays(camera);
        double worst = 0;
        for (double y = -0.5; y < camera.size.height; y += 1.7)
            for (double x = -0.5; x < camera.size.width; x += 1.3) {
                const Eigen::Vector2f ray = rays.at(static_cast<float>(x), static_cast<float>(y));
                const Eigen::Vector2d error =
                    camera.project(ray.cast<double>()) - Eigen::Vector2d(x, y);
                worst = std::max(worst, error.norm());
            }
        EXPECT_LT(worst, 0.05);
    }
}

TEST(LensRays, PixelsInContainsAllPixelsWithRaysInTheBox) {
    const CameraModel camera = wideLens();
    const LensRays rays(camera);
    const Eigen::Vector2f least{-0.3F, 0.1F}, most{0.05F, 0.2F};
    const PixelRect found = rays.pixelsIn(least, most);
    int outside = 0, inside = 0;
    for (int y = 0; y < camera.size.height; ++y)
        for (int x = 0; x < camera.size.width; ++x) {
            const Eigen::Vector2f ray = rays.at(static_cast<float>(x), static_cast<float>(y));
            if ((ray.array() < least.array()).any() || (ray.array() > most.array()).any()) continue;
            ++inside;
            outside += x < found.x0 || x >= found.x1 || y < found.y0 || y >= found.y1;
        }
    EXPECT_GT(inside, 500);
    EXPECT_EQ(outside, 0);
    EXPECT_LT(found.area(), 3 * inside);
}

TEST(ViewBounds, BoxBehindTheCameraHasEmptyBounds) {
    const RenderView view{wideLens(), {}};
    const LensRays rays(view.camera);
    EXPECT_TRUE(
        pixelsOfBox({Eigen::Vector3f(-1, -1, -3), Eigen::Vector3f(1, 1, -1)}, view, rays).empty());
    EXPECT_TRUE(pixelsOfBox({}, view, rays).empty());
}

TEST(ViewBounds, BoxAroundTheCameraCoversThePicture) {
    const RenderView view{wideLens(), {}};
    const LensRays rays(view.camera);
    EXPECT_EQ(pixelsOfBox({Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(1, 1, 1)}, view, rays),
              (PixelRect{0, 0, 321, 243}));
}

TEST(ViewBounds, BoundsContainEveryPointOfABox) {
    const RenderView view{wideLens(), {}};
    const LensRays rays(view.camera);
    const Eigen::AlignedBox3f box(Eigen::Vector3f(0.1F, -0.2F, -0.5F),
                                  Eigen::Vector3f(0.3F, 0.1F, 2));
    const PixelRect found = pixelsOfBox(box, view, rays);
    for (float x = 0.1F; x <= 0.3F; x += 0.02F)
        for (float y = -0.2F; y <= 0.1F; y += 0.03F)
            for (float z = 0.5F; z <= 2; z += 0.1F) {
                const Eigen::Vector2d p = view.camera.project(Eigen::Vector2d(x / z, y / z));
                if (p.x() < 0 || p.y() < 0 || p.x() > 320 || p.y() > 242) continue;
                EXPECT_TRUE(p.x() >= found.x0 && p.x() < found.x1 && p.y() >= found.y0 &&
                            p.y() < found.y1)
                    << p.transpose();
            }
}

TEST(LensRays, InvalidCamerasAreDetected) {
    EXPECT_TRUE(isSound(wideLens()));
    CameraModel camera = wideLens();
    camera.fx = 0;
    EXPECT_FALSE(isSound(camera));
    camera = wideLens();
    camera.distortion[3] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(isSound(camera));
    camera = wideLens();
    camera.size = {0, 4};
    EXPECT_FALSE(isSound(camera));
    EXPECT_FALSE(isSound(CameraModel{}));
}

}  // namespace
}  // namespace mfar
