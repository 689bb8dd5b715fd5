#include "pipeline/models/environment_map.h"
#include "pipeline/models/light_estimate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

namespace mfar {
namespace {

using Radiance = std::function<Eigen::Vector3f(const Eigen::Vector3f&)>;

constexpr Size kSmall{64, 48};
const CameraModel kLens{kSmall, 56, 56, 31.5, 23.5, {}};

std::uint8_t encoded(float linear) {
    const float v = std::clamp(linear, 0.0F, 1.0F);
    const float s = v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255 * s));
}

std::vector<std::uint8_t> seenFrom(const RigidTransform& T_world_camera, const Radiance& light) {
    std::vector<std::uint8_t> out;
    for (int y = 0; y < kSmall.height; ++y) {
        for (int x = 0; x < kSmall.width; ++x) {
            const Eigen::Vector2d ray =
                kLens.unproject({static_cast<double>(x), static_cast<double>(y)});
            const Eigen::Vector3d d =
                T_world_camera.rotation * Eigen::Vector3d(ray.x(), ray.y(), 1).normalized();
            const Eigen::Vector3f rgb = light(d.cast<float>());
            out.insert(out.end(), {encoded(rgb.x()), encoded(rgb.y()), encoded(rgb.z()), 255});
        }
    }
    return out;
}

class Watcher {
public:
    explicit Watcher(const LightEstimatorOptions& options = {}) : estimator(options) {}

    void look(const RigidTransform& T_world_camera, const Radiance& light) {
        const std::vector<std::uint8_t> pixels = seenFrom(T_world_camera, light);
        time_ = time_ + std::chrono::milliseconds(33);
        estimator.add({pixels.data(), kSmall, 256, PixelFormat::Rgba8}, kLens, T_world_camera,
                      time_);
    }
    LightEstimate estimate() const { return estimator.estimate().value(); }

    LightEstimator estimator;

private:
    Timestamp time_{};
};

RigidTransform lookingAlong(const Eigen::Vector3d& direction) {
    const Eigen::Vector3d d = direction.normalized();
    // The smallest rotation from z to d. Eigen's FromTwoVectors() is not used, because compiling it
    // takes 12 s.
    return {Eigen::Quaterniond(1 + d.z(), -d.y(), d.x(), 0).normalized(), {1, 2, 3}};
}

RigidTransform lookingDown() {
    return lookingAlong({0.2, 0.5, -1});
}

std::vector<RigidTransform> allAround() {
    std::vector<RigidTransform> out;
    constexpr int kViews = 80;
    for (int i = 0; i < kViews; ++i) {
        const double z = 1 - (2 * i + 1.0) / kViews, turn = i * 2.399963;
        const double r = std::sqrt(1 - z * z);
        out.push_back(lookingAlong({r * std::cos(turn), r * std::sin(turn), z}));
    }
    return out;
}

double degreesBetween(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::acos(std::clamp<double>(a.dot(b), -1, 1)) * 180 / std::numbers::pi;
}

// Smooth light that nine spherical harmonics represent exactly.
const Eigen::Vector3f kFrom = Eigen::Vector3f(0.5F, -0.4F, 0.7F).normalized();
Eigen::Vector3f smoothLight(const Eigen::Vector3f& d) {
    return Eigen::Vector3f(0.4F, 0.35F, 0.3F) * (1 + 0.8F * d.dot(kFrom));
}

TEST(SphericalHarmonics, AreOrthonormal) {
    Eigen::Matrix<double, 9, 9> products = Eigen::Matrix<double, 9, 9>::Zero();
    constexpr int kRows = 200;
    const double step = std::numbers::pi / kRows;
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < 2 * kRows; ++x) {
            const float u = (x + 0.5F) / (2 * kRows), v = (y + 0.5F) / kRows;
            const Eigen::Vector<double, 9> h =
                harmonicsAt(environmentDirection(u, v)).cast<double>();
            products += step * step * std::sin((y + 0.5) * step) * h * h.transpose();
        }
    }
    EXPECT_LT((products - Eigen::Matrix<double, 9, 9>::Identity()).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(LightEstimate, LightIsFoundOnceAllDirectionsWereSeen) {
    Watcher watcher;
    for (const RigidTransform& T : allAround())
        watcher.look(T, smoothLight);
    const LightEstimate estimate = watcher.estimate();
    EXPECT_LT(degreesBetween(estimate.mainDirection, kFrom), 3);
    for (const RigidTransform& T : allAround()) {
        const Eigen::Vector3f d = (T.rotation * Eigen::Vector3d::UnitZ()).cast<float>();
        const Eigen::Vector3f truth = smoothLight(d);
        EXPECT_LT((radianceOf(estimate.radiance, d) - truth).norm(), 0.1F * 0.35F * 1.73F);
    }
    // Light from a single direction has a directionality of 1; this light has 0.8 / 3.
    EXPECT_NEAR(estimate.directionality, 0.8 / 3, 0.03);
}

TEST(LightEstimate, IfOnlyATableWasSeenLightComesFromAbove) {
    Watcher watcher;
    for (int i = 0; i < 10; ++i)
        watcher.look(lookingDown(), [](const auto&) { return Eigen::Vector3f(0.3F, 0.25F, 0.2F); });
    const LightEstimate estimate = watcher.estimate();
    EXPECT_GT(estimate.mainDirection.z(), 0.9F);
    const Eigen::Vector3f up = radianceOf(estimate.radiance, {0, 0, 1}),
                          down = radianceOf(estimate.radiance, {0, 0, -1});
    EXPECT_LT((down - Eigen::Vector3f(0.3F, 0.25F, 0.2F)).norm(), 0.1F) << down.transpose();
    EXPECT_GT(up.x(), 1.3F * down.x());
    EXPECT_NEAR(up.x() / up.z(), 1.5F, 0.1F) << "the light must have the table's colour";
}

TEST(LightEstimate, ALampInViewGivesTheMainDirectionOfLight) {
    const Eigen::Vector3f lamp = Eigen::Vector3f(-0.6F, 0.3F, 0.5F).normalized();
    const Radiance room = [&](const Eigen::Vector3f& d) {
        return Eigen::Vector3f::Constant(d.dot(lamp) > 0.9F ? 1.0F : 0.05F).eval();
    };
    Watcher watcher;
    for (const RigidTransform& T : allAround())
        watcher.look(T, room);
    const LightEstimate estimate = watcher.estimate();
    EXPECT_LT(degreesBetween(estimate.mainDirection, lamp), 5);
    const Lighting lighting = lightingOf(estimate);
    ASSERT_TRUE(lighting.sun);
    EXPECT_LT(degreesBetween(lighting.sun->towards, lamp), 5);
    EXPECT_GT(lighting.sun->irradiance.minCoeff(), 0);
}

TEST(LightEstimate, LightOutOfViewIsRemembered) {
    Watcher watcher;
    for (const RigidTransform& T : allAround())
        watcher.look(T, smoothLight);
    for (int i = 0; i < 150; ++i)
        watcher.look(lookingDown(), smoothLight);
    EXPECT_LT(degreesBetween(watcher.estimate().mainDirection, kFrom), 3);
}

TEST(LightEstimate, OneFlashChangesTheEstimateLittle) {
    Watcher watcher;
    for (int i = 0; i < 100; ++i)
        watcher.look(lookingDown(), smoothLight);
    const float before = watcher.estimate().radiance(0, 1);
    watcher.look(lookingDown(), [](const auto&) { return Eigen::Vector3f(1, 1, 1); });
    const float flash = watcher.estimate().radiance(0, 1);
    EXPECT_NEAR(flash, before, 0.06F * before);
    EXPECT_GT(flash, before);
}

TEST(LightEstimate, TheEstimateFollowsAChangeOfLight) {
    Watcher watcher;
    const auto level = [](float v) {
        return [v](const Eigen::Vector3f&) { return Eigen::Vector3f(v, v, v); };
    };
    for (int i = 0; i < 30; ++i)
        watcher.look(lookingDown(), level(0.1F));
    const float dark = watcher.estimate().radiance(0, 0);
    for (int i = 0; i < 91; ++i)  // 3 s, the time constant of the estimator
        watcher.look(lookingDown(), level(0.5F));
    const float share = (watcher.estimate().radiance(0, 0) / dark - 1) / 4;
    EXPECT_NEAR(share, 1 - std::exp(-1.0F), 0.02F);
}

TEST(LightEstimate, FramesOfACoveredLensOrWithInvalidPoseOrTimeAreSkipped) {
    Watcher watcher;
    EXPECT_FALSE(watcher.estimator.estimate());
    watcher.look(lookingDown(), [](const auto&) { return Eigen::Vector3f(0, 0, 0); });
    EXPECT_FALSE(watcher.estimator.estimate()) << "a covered lens must give no estimate";
    watcher.look(lookingDown(), smoothLight);
    const SphericalLight before = watcher.estimate().radiance;
    RigidTransform broken = lookingDown();
    broken.rotation.x() = NAN;
    const std::vector<std::uint8_t> white(256UL * 48, 255);
    const ImageView view{white.data(), kSmall, 256, PixelFormat::Rgba8};
    watcher.estimator.add(view, kLens, broken, Timestamp::fromSeconds(5));
    watcher.estimator.add(view, kLens, lookingDown(), Timestamp::fromSeconds(0));
    EXPECT_EQ(watcher.estimate().radiance, before);
    EXPECT_THROW(watcher.estimator.add({nullptr, kSmall, 256, PixelFormat::Rgba8}, kLens,
                                       lookingDown(), Timestamp::fromSeconds(6)),
                 std::invalid_argument);
    EXPECT_THROW(LightEstimator({.smoothingS = 0}), std::invalid_argument);
    EXPECT_THROW(LightEstimator({.memoryS = 0}), std::invalid_argument);
    EXPECT_THROW(LightEstimator({.surfaceAlbedo = NAN}), std::invalid_argument);
}

TEST(LightEstimate, EveryFormatGivesTheSameLight) {
    const Size size{64, 48};
    const auto estimateOfFrame = [&](const ImageView& view) {
        LightEstimator estimator;
        estimator.add(view, kLens.scaledTo(size), lookingDown(), Timestamp{1});
        return estimator.estimate().value().radiance;
    };
    const std::size_t pixels = 64UL * 48;
    const std::vector<std::uint8_t> grey(pixels * 4, 120);
    const ImageView rgba{grey.data(), size, 256, PixelFormat::Rgba8};
    const SphericalLight wanted = estimateOfFrame(rgba);
    ImageView view = rgba;
    view.format = PixelFormat::Bgra8;
    EXPECT_EQ(estimateOfFrame(view), wanted);
    view = {grey.data(), size, 64, PixelFormat::Gray8};
    EXPECT_EQ(estimateOfFrame(view), wanted);
    const std::vector<std::uint8_t> neutral(pixels, 128);
    for (const PixelFormat format : {PixelFormat::Nv12, PixelFormat::Yuv420}) {
        view = {grey.data(), size, 64, format};
        view.range = YuvRange::Full;
        view.chroma = {PlaneView{neutral.data(), 64}, PlaneView{neutral.data(), 64}};
        EXPECT_LT((estimateOfFrame(view) - wanted).norm(), 1e-5F);
    }
    std::vector<std::uint8_t> yuyv(pixels * 2, 128);
    for (std::size_t i = 0; i < pixels; ++i)
        yuyv[2 * i] = 120;
    view = {yuyv.data(), size, 128, PixelFormat::Yuyv};
    view.range = YuvRange::Full;
    EXPECT_LT((estimateOfFrame(view) - wanted).norm(), 1e-5F);
}

TEST(Lighting, TheEnvironmentIsNeverNegativeAndASingleLampBecomesTheSun) {
    LightEstimate estimate;
    estimate.radiance = harmonicsAt({0, 0, 1}) * Eigen::RowVector3f(3, 3, 3);
    estimate.mainDirection = {0, 0, 1};
    estimate.directionality = 1;
    const Lighting lighting = lightingOf(estimate);
    ASSERT_TRUE(lighting.sun);
    EXPECT_NEAR(lighting.sun->irradiance.x(), 3, 1e-4F);
    for (const Eigen::Vector3f& light : lighting.environment->radiance) {
        ASSERT_GE(light.minCoeff(), 0);
        EXPECT_LT(light.maxCoeff(), 1e-4F) << "all light comes from the sun";
    }
    estimate.directionality = 0.05F;
    EXPECT_FALSE(lightingOf(estimate).sun);
}

}  // namespace
}  // namespace mfar
