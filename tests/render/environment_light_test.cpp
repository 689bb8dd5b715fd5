#include "pipeline/render/environment_light.h"
#include "pipeline/render/sobol.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

using render_scenes::unevenLight;

/// Integral of f(direction) over the sphere, by the midpoint rule.
template <typename F>
auto overSphere(F f) {
    constexpr int kHeights = 256, kPhis = 512;
    auto sum = f(Eigen::Vector3f(0, 0, 1));
    sum *= 0;
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kPhis; ++j) {
            const float z = 1 - 2 * (static_cast<float>(i) + 0.5F) / kHeights;
            const float phi = 2 * static_cast<float>(M_PI) * (static_cast<float>(j) + 0.5F) / kPhis;
            const float r = std::sqrt(1 - z * z);
            sum += f(Eigen::Vector3f(r * std::cos(phi), r * std::sin(phi), z)) *
                   static_cast<float>(4 * M_PI / (kHeights * kPhis));
        }
    return sum;
}

TEST(EnvironmentLight, FollowsTheDocumentedOrientation) {
    auto picture = std::make_shared<Environment>();
    picture->size = {8, 4};
    picture->radiance.assign(32, {0, 0, 0});
    picture->radiance[0 * 8 + 2] = {1, 0, 0};  // near +z (up)
    picture->radiance[1 * 8 + 5] = {0, 1, 0};  // between +x and +y
    picture->radiance[2 * 8 + 0] = {0, 0, 1};  // below the horizon, from -x towards -y
    const EnvironmentLight light(picture);
    const auto at = [&](float u, float v) {
        const float theta = v * static_cast<float>(M_PI);
        const float phi = (2 * u - 1) * static_cast<float>(M_PI);
        return light.radiance(
            {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    };
    EXPECT_NEAR(at(2.5F / 8, 0.5F / 4).x(), 1, 1e-3F);
    EXPECT_NEAR(at(5.5F / 8, 1.5F / 4).y(), 1, 1e-3F);
    EXPECT_NEAR(at(0.5F / 8, 2.5F / 4).z(), 1, 1e-3F);
    EXPECT_GT(light.radiance(Eigen::Vector3f(1, 1, 0.3F).normalized()).y(), 0.3F);
    EXPECT_GT(light.radiance(Eigen::Vector3f(-1, -0.4F, -0.4F).normalized()).z(), 0.3F);
    // The picture is interpolated across its left and right borders.
    EXPECT_NEAR(at(0, 2.5F / 4).z(), 0.5F, 1e-3F);
}

TEST(EnvironmentLight, DensityIntegratesToOne) {
    const EnvironmentLight light(unevenLight());
    EXPECT_NEAR(overSphere([&](const Eigen::Vector3f& d) { return light.density(d); }), 1, 0.005);
}

TEST(EnvironmentLight, SamplesHaveTheDensityAndRadianceOfTheirDirection) {
    const EnvironmentLight light(unevenLight());
    int same = 0;
    for (std::uint32_t i = 0; i < 512; ++i) {
        const LightSample s = light.sample(PixelSampler(0, 0, i, false).pair(0));
        EXPECT_NEAR(s.direction.norm(), 1, 1e-5F);
        EXPECT_NEAR((light.radiance(s.direction) - s.radiance).norm(), 0,
                    0.02F * s.radiance.norm());
        // Rounding may move a sample into the next texel.
        same += std::abs(light.density(s.direction) - s.density) < 1e-3F * s.density;
    }
    EXPECT_GE(same, 508);
}

TEST(EnvironmentLight, SamplesAndUniformDirectionsTogetherGiveTheIntegral) {
    const EnvironmentLight light(unevenLight());
    const Eigen::Vector3f expected =
        overSphere([&](const Eigen::Vector3f& d) { return light.radiance(d); });
    constexpr float kEven = 1 / (4 * static_cast<float>(M_PI));
    Eigen::Vector3f sum{0, 0, 0};
    for (std::uint32_t i = 0; i < 4096; ++i) {
        const PixelSampler sampler(0, 0, i, false);
        const LightSample s = light.sample(sampler.pair(0));
        sum += s.radiance / (s.density + kEven) / 4096;
        const Eigen::Vector2f u = sampler.pair(1);
        const float z = 2 * u.y() - 1, r = std::sqrt(1 - z * z);
        const float phi = 2 * static_cast<float>(M_PI) * u.x();
        const Eigen::Vector3f d{r * std::cos(phi), r * std::sin(phi), z};
        sum += light.radiance(d) / (light.density(d) + kEven) / 4096;
    }
    EXPECT_NEAR((sum - expected).norm(), 0, 0.01F * expected.norm());
    EXPECT_EQ(light.density({0, 0, -1}), 0);
    EXPECT_GT(light.density({0, 0, 1}), 0);
}

TEST(EnvironmentLight, MissingEnvironmentIsDark) {
    EXPECT_TRUE(EnvironmentLight(nullptr).dark());
    EXPECT_EQ(EnvironmentLight(nullptr).radiance({0, 0, 1}), Eigen::Vector3f(0, 0, 0));
    EXPECT_TRUE(EnvironmentLight(render_scenes::evenLight(0)).dark());
    EXPECT_EQ(EnvironmentLight(render_scenes::evenLight(0)).density({0, 0, 1}), 0);
}

TEST(EnvironmentLight, UniformEnvironmentIsNotSampled) {
    auto picture = std::make_shared<Environment>();
    picture->size = {1, 1};
    picture->radiance = {{2, 2, 2}};
    for (const EnvironmentLight& light :
         {EnvironmentLight(picture), EnvironmentLight(render_scenes::evenLight(2))}) {
        EXPECT_FALSE(light.dark());
        EXPECT_FALSE(light.sampled());
        EXPECT_EQ(light.density({0, 0.6F, 0.8F}), 0);
        EXPECT_NEAR((light.radiance({0, 0.6F, 0.8F}) - Eigen::Vector3f(2, 2, 2)).norm(), 0, 1e-5F);
    }
}

}  // namespace
}  // namespace mfar
