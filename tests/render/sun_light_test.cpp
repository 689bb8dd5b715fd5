#include "pipeline/render/sobol.h"
#include "pipeline/render/sun_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

Sun sunOf(float radius) {
    return {Eigen::Vector3f(0.2F, -0.5F, 0.6F).normalized(), {3, 2, 1}, radius};
}

TEST(SunLight, SamplesGiveTheIrradianceOfASurfaceThatFacesTheSun) {
    for (const float radius : {0.00465F, 0.1F, 0.8F}) {
        const Sun sun = sunOf(radius);
        const SunLight light(sun);
        Eigen::Vector3f sum{0, 0, 0};
        for (std::uint32_t i = 0; i < 1024; ++i) {
            const LightSample s = light.sample(PixelSampler(0, 0, i, false).pair(0));
            sum += s.radiance * sun.towards.dot(s.direction) / s.density / 1024;
        }
        EXPECT_NEAR((sum - sun.irradiance).norm(), 0, 0.003F) << radius;
    }
}

TEST(SunLight, SamplesLieInTheDiscWithItsDensity) {
    for (const float radius : {0.001F, 0.3F}) {
        const Sun sun = sunOf(radius);
        const SunLight light(sun);
        for (std::uint32_t i = 0; i < 256; ++i) {
            const LightSample s = light.sample(PixelSampler(0, 0, i, false).pair(0));
            EXPECT_NEAR(s.direction.norm(), 1, 1e-5F);
            EXPECT_LE((s.direction - sun.towards).norm(), 2.001F * std::sin(radius / 2));
        }
        const LightSample middle = light.sample({0.5F, 0.5F});
        EXPECT_EQ(light.density(middle.direction), middle.density);
        EXPECT_EQ(light.radiance(middle.direction), middle.radiance);
        const double solidAngle = 2 * M_PI * (1 - std::cos(static_cast<double>(radius)));
        EXPECT_NEAR(middle.density * solidAngle, 1, 0.001);
    }
}

TEST(SunLight, IsDarkOutsideTheDisc) {
    const Sun sun = sunOf(0.05F);
    const SunLight light(sun);
    EXPECT_EQ(light.density(-sun.towards), 0);
    EXPECT_EQ(light.radiance(Eigen::Vector3f(1, 0, 0)), Eigen::Vector3f(0, 0, 0));
    EXPECT_TRUE(SunLight(std::nullopt).dark());
    EXPECT_EQ(SunLight(std::nullopt).density(sun.towards), 0);
}

}  // namespace
}  // namespace mfar
