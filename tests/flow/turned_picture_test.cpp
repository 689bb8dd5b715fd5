#include "pipeline/epipolar/turned_picture.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr double kBeyond = 0.8;

CameraModel folding() {
    return {{161, 119}, 150, 150, 80, 59, {-0.3, 0, 0, 0, 0}};
}

Eigen::Matrix3d turn(double x, double y, double z) {
    return test::motion({x, y, z}, {0, 0, 0}).rotation.toRotationMatrix();
}

double grey(double x, double y) {
    return 128 + 50 * std::sin(0.11 * x) + 50 * std::cos(0.13 * y + 0.02 * x);
}

LumaImage smoothPicture(Size size) {
    LumaImage out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.row(y)[x] = static_cast<std::uint8_t>(std::lround(grey(x, y)));
    return out;
}

struct Canvas {
    TurnedPicture placed;
    LumaImage picture;
    std::vector<std::uint8_t> seen;
};

Canvas turned(const CameraModel& camera, const Eigen::Matrix3d& rotation) {
    Canvas out;
    Workers workers(2);
    out.placed.place(camera, camera, camera, rotation, kBeyond);
    if (out.placed.size() == Size{}) return out;
    out.placed.draw(smoothPicture(camera.size), workers, out.picture, out.seen);
    return out;
}

/// The position in the picture that shows a pixel of the rotated camera; far outside if the picture
/// does not show it.
Eigen::Vector2d source(const CameraModel& camera, const Eigen::Matrix3d& rotation,
                       const Eigen::Vector2d& pixel) {
    constexpr double kNowhere = -1e6;
    const Eigen::Vector2d ray = camera.unproject(pixel);
    if ((camera.project(ray) - pixel).norm() > 1e-3) return {kNowhere, kNowhere};
    const Eigen::Vector3d p = rotation * ray.homogeneous();
    if (!(p.z() > 0)) return {kNowhere, kNowhere};
    const Eigen::Vector2d at = camera.project(p.hnormalized());
    // The lens model also projects rays from far outside back into the picture. These rays are
    // excluded.
    const bool real = (camera.unproject(at) - p.hnormalized()).norm() < 1e-3;
    return real ? at : Eigen::Vector2d(kNowhere, kNowhere);
}

double depthInside(Size size, const Eigen::Vector2d& at) {
    return std::min({at.x(), at.y(), size.width - 1 - at.x(), size.height - 1 - at.y()});
}

struct Agreement {
    int shown = 0, missing = 0, invented = 0;
    double worst = 0;  // largest difference [grey levels]
};

// Pixels within two pixels of the picture's border may count as seen or as unseen.
Agreement compare(const CameraModel& camera, const Eigen::Matrix3d& rotation,
                  const Canvas& canvas) {
    Agreement out;
    const Size size = canvas.placed.size();
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const Eigen::Vector2d at = source(
                camera, rotation, {x + canvas.placed.origin().x, y + canvas.placed.origin().y});
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            const double inside = depthInside(camera.size, at);
            out.invented += inside < -2 && canvas.seen[i] != 0;
            out.missing += inside > 2 && canvas.seen[i] == 0;
            if (inside < 2 || canvas.seen[i] == 0) continue;
            ++out.shown;
            out.worst =
                std::max(out.worst, std::abs(canvas.picture.pixels[i] - grey(at.x(), at.y())));
        }
    }
    return out;
}

/// Number of pixels of the rotated camera that show the source picture but lie outside the canvas.
/// Samples every third pixel of the camera's frame, widened by kBeyond picture widths on each side.
int leftOff(const CameraModel& camera, const Eigen::Matrix3d& rotation, const Canvas& canvas) {
    const int reach = static_cast<int>(kBeyond * camera.size.width) - 1;
    const auto [ox, oy] = canvas.placed.origin();
    int count = 0;
    for (int y = -reach; y < camera.size.height + reach; y += 3) {
        for (int x = -reach; x < camera.size.width + reach; x += 3) {
            if (depthInside(camera.size, source(camera, rotation, {x, y})) < 2) continue;
            count += x < ox || y < oy || x >= ox + canvas.placed.size().width ||
                     y >= oy + canvas.placed.size().height;
        }
    }
    return count;
}

TEST(TurnedPicture, WithoutRotationThePictureIsUnchanged) {
    const CameraModel camera = test::oddPlain();
    const Canvas canvas = turned(camera, Eigen::Matrix3d::Identity());
    const LumaImage picture = smoothPicture(camera.size);
    const auto [ox, oy] = canvas.placed.origin();
    for (int y = 0; y < camera.size.height; ++y) {
        for (int x = 0; x < camera.size.width; ++x) {
            ASSERT_TRUE(x - ox < canvas.picture.size.width && y - oy < canvas.picture.size.height);
            ASSERT_NEAR(canvas.picture.row(y - oy)[x - ox], picture.row(y)[x], 1);
            ASSERT_EQ(
                canvas.seen[static_cast<std::size_t>(y - oy) * canvas.picture.size.width + x - ox],
                1);
        }
    }
}

TEST(TurnedPicture, TheRotatedPictureMatchesDirectProjection) {
    for (const CameraModel& camera : {test::oddPlain(), test::oddBarrel(), folding()}) {
        for (const Eigen::Matrix3d& rotation :
             {turn(0, 0, 0), turn(3, -4, 2), turn(-12, 8, 20), turn(0, 0, 90), turn(0, 0, 180),
              turn(5, 25, -30), turn(0, -40, 0), turn(25, 0, 0), turn(-20, 35, 120)}) {
            const Canvas canvas = turned(camera, rotation);
            ASSERT_GT(canvas.placed.size().width, 0);
            const Agreement found = compare(camera, rotation, canvas);
            EXPECT_GT(found.shown, 500);
            const bool folds = camera.distortion[1] == 0 && camera.distortion[0] < 0;
            EXPECT_LT(found.worst, folds ? 15 : 3) << rotation;
            EXPECT_LE(found.missing, folds ? found.shown / 12 : 0) << rotation;
            EXPECT_EQ(found.invented, 0) << rotation;
            EXPECT_EQ(leftOff(camera, rotation, canvas), 0) << rotation;
        }
    }
}

TEST(TurnedPicture, TheCanvasIsOnTheSideToWhichTheCameraRotated) {
    const CameraModel camera = test::oddPlain();
    const Canvas left = turned(camera, turn(0, 38, 0));
    EXPECT_LT(left.placed.origin().x, -camera.size.width / 4);
    EXPECT_LT(left.placed.origin().x + left.placed.size().width, camera.size.width);
    const Canvas right = turned(camera, turn(0, -38, 0));
    EXPECT_GT(right.placed.origin().x, 0);
    EXPECT_GT(right.placed.origin().x + right.placed.size().width, 5 * camera.size.width / 4);
}

TEST(TurnedPicture, TheCanvasIsAlignedAndEndsWithinTheGivenMarginOfThePicture) {
    for (const CameraModel& camera : {test::oddPlain(), test::oddBarrel(), folding()}) {
        const double reach = kBeyond * camera.size.width;
        for (int y = -80; y <= 80; y += 10) {
            for (int z = 0; z < 360; z += 45) {
                const Canvas canvas = turned(camera, turn(7, y, z));
                if (canvas.placed.size() == Size{}) continue;
                const auto [ox, oy] = canvas.placed.origin();
                EXPECT_EQ(ox % TurnedPicture::kAlign, 0);
                EXPECT_EQ(oy % TurnedPicture::kAlign, 0);
                EXPECT_GT(ox, -reach - TurnedPicture::kAlign);
                EXPECT_GT(oy, -reach - TurnedPicture::kAlign);
                EXPECT_LE(ox + canvas.placed.size().width, camera.size.width + reach + 1);
                EXPECT_LE(oy + canvas.placed.size().height, camera.size.height + reach + 1);
            }
        }
    }
}

TEST(TurnedPicture, AroundASmallPartTheCanvasReachesAsFarAsAroundTheWholePicture) {
    for (const CameraModel& camera : {test::oddPlain(), test::oddBarrel()}) {
        CameraModel part = camera;
        part.size = {8, 8};
        part.cx = part.cy = 3.5;
        TurnedPicture canvas;
        canvas.place(part, camera, camera, Eigen::Matrix3d::Identity(), camera.size.width);
        EXPECT_GE(canvas.size().width, camera.size.width);
        EXPECT_GE(canvas.size().height, camera.size.height);
    }
}

TEST(TurnedPicture, PointsBehindTheCameraAreUnseen) {
    for (const CameraModel& camera : {test::oddPlain(), test::oddBarrel(), folding()}) {
        for (const Eigen::Matrix3d& rotation :
             {turn(0, 180, 0), turn(180, 0, 0), turn(0, 150, 0), turn(0, -145, 40)}) {
            const Canvas canvas = turned(camera, rotation);
            EXPECT_EQ(canvas.placed.size(), Size{}) << rotation;
        }
    }
}

TEST(TurnedPicture, CanBeReusedForAnotherRotation) {
    const CameraModel camera = test::oddBarrel();
    Canvas canvas = turned(camera, turn(0, 20, 30));
    Workers workers(3);
    canvas.placed.place(camera, camera, camera, turn(0, 180, 0), kBeyond);
    EXPECT_EQ(canvas.placed.size(), Size{});
    canvas.placed.place(camera, camera, camera, turn(2, 3, 4), kBeyond);
    canvas.placed.draw(smoothPicture(camera.size), workers, canvas.picture, canvas.seen);
    const Canvas fresh = turned(camera, turn(2, 3, 4));
    EXPECT_EQ(canvas.picture.pixels, fresh.picture.pixels);
    EXPECT_EQ(canvas.seen, fresh.seen);
}

}  // namespace
}  // namespace mfar
