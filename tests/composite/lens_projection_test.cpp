#include "pipeline/composite/lens_projection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

CameraModel barrel() {
    return {{160, 120}, 150, 152, 82.5, 57.1, {-0.31, 0.08, 0.002, -0.0015, 0.004}};
}

// A lens model that is valid only a little beyond the picture's corners. It would project rays from
// farther outside back into the picture.
CameraModel folding() {
    return {{160, 120}, 110, 110, 80, 59, {-0.17, 0, 0, 0, 0}};
}

TEST(LensProjection, MatchesTheCameraModelWithinItsValidRange) {
    for (const CameraModel& camera : {barrel(), folding()}) {
        const LensProjection lens(camera);
        for (int y = 0; y < camera.size.height; y += 7)
            for (int x = 0; x < camera.size.width; x += 7) {
                const Eigen::Vector2d pixel(x, y);
                const Eigen::Vector3d p = 0.7 * camera.unproject(pixel).homogeneous();
                const Eigen::Vector3d h = lens(p);
                EXPECT_DOUBLE_EQ(h.z(), 0.7);
                EXPECT_LT((h.hnormalized() - pixel).norm(), 1e-6);
            }
    }
}

TEST(LensProjection, RaysBeyondTheValidRangeOfTheLensStayOutsideThePicture) {
    for (const CameraModel& camera : {barrel(), folding()}) {
        const LensProjection lens(camera);
        for (int i = 0; i < 360; ++i) {
            const Eigen::Vector2d direction(std::cos(i * 0.0175), std::sin(i * 0.0175));
            double before = 0;
            for (double r = lens.rim; r < 1e6; r *= 1.3) {
                const Eigen::Vector2d ray = r * direction;
                const Eigen::Vector2d pixel = lens(ray.homogeneous()).hnormalized();
                const bool inside = pixel.x() > -0.5 && pixel.y() > -0.5 &&
                                    pixel.x() < camera.size.width - 0.5 &&
                                    pixel.y() < camera.size.height - 0.5;
                EXPECT_FALSE(inside) << r << " " << i;
                const double out = (pixel - Eigen::Vector2d(camera.cx, camera.cy)).norm();
                EXPECT_GT(out, before) << r << " " << i;
                before = out;
            }
        }
    }
}

TEST(LensProjection, IsContinuousAndFiniteOutsideTheViewAndBehindTheCamera) {
    const LensProjection lens(barrel());
    for (const Eigen::Vector2d& xy :
         {Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(-2, 1), Eigen::Vector2d(1e-9, 0)}) {
        Eigen::Vector3d before = lens({xy.x(), xy.y(), 1});
        for (double z = 1; z > -1; z -= 1e-3) {
            const Eigen::Vector3d h = lens({xy.x(), xy.y(), z});
            ASSERT_TRUE(h.allFinite()) << z;
            ASSERT_LT((h - before).norm(), 1) << z;
            before = h;
        }
    }
    EXPECT_TRUE(lens({0, 0, -1}).allFinite());
    EXPECT_TRUE(lens({0, 0, 0}).allFinite());
}

}  // namespace
}  // namespace mfar
