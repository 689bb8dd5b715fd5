#pragma once

#include "base/mirror_light.h"
#include "pipeline/render/far_light.h"
#include "pipeline/render/microfacet.h"
#include "pipeline/warp/traced_picture.h"

#include <Eigen/Geometry>

#include <bit>
#include <memory>
#include <random>
#include <vector>

namespace mfar::test {

inline constexpr Size kMirrorPicture{21, 40};
/// Light in the table of roughness 1, divided by that of roughness 0.
inline constexpr float kTwice = 2;

inline CameraModel mirrorCamera() {
    return {kMirrorPicture, 30, 30, 9.5, 18.5, {-0.1, 0.02, 0, 0, 0}};
}

inline Eigen::Vector3f lightFrom(const Eigen::Vector3f& direction) {
    return direction + Eigen::Vector3f::Constant(1.5F);
}

inline MirrorLight smoothLight() {
    MirrorLight out;
    for (const float roughness : {0.0F, 1.0F}) {
        const DirectionTable table(129);
        out.tables.push_back(
            {roughness, table.edge(), static_cast<std::uint32_t>(out.texels.size())});
        for (int row = 0; row < table.edge(); ++row)
            for (int column = 0; column < table.edge(); ++column) {
                const Eigen::Vector3f light =
                    (roughness > 0 ? kTwice : 1) * lightFrom(table.direction(column, row));
                out.texels.push_back(packedLight({light.x(), light.y(), light.z()}));
            }
    }
    return out;
}

inline MirrorLight smoothLightAndSun() {
    MirrorLight out = smoothLight();
    const Eigen::Vector3f sun = Eigen::Vector3f(-0.2F, 0.4F, -0.9F).normalized();
    out.towardsSun = {sun.x(), sun.y(), sun.z()};
    out.sunIrradiance = {30, 30, 30};
    out.leastSunAlpha = 0.005F;
    return out;
}

/// A traced picture whose pixels mirror the given light, each with its own normal, roughness and
/// distance. Their light must be set with setLight().
struct MirrorSurfaces {
    std::vector<Eigen::Vector3f> points, normals;
    std::vector<float> roughness;
    TracedPicture traced;

    explicit MirrorSurfaces(const MirrorLight& mirrors) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> any(-1, 1);
        traced.camera = mirrorCamera();
        traced.T_world_camera = {Eigen::Quaterniond(Eigen::AngleAxisd(
                                     2.1, Eigen::Vector3d(0.3, 0.8, -0.5).normalized())),
                                 {0.4, -0.2, 0.7}};
        traced.mirrors = std::make_shared<const MirrorLight>(mirrors);
        traced.exposure = 0.5F;
        traced.bounds = {0, 0, kMirrorPicture.width, kMirrorPicture.height};
        const Eigen::Matrix3f axes =
            traced.T_world_camera.rotation.toRotationMatrix().cast<float>();
        for (int y = 0; y < kMirrorPicture.height; ++y)
            for (int x = 0; x < kMirrorPicture.width; ++x) {
                const float z = std::bit_cast<float>(std::bit_cast<std::uint32_t>(2 + any(random)) &
                                                     0xFFFFFF00U);
                const Eigen::Vector3f ray =
                    axes *
                    mirrorCamera().unproject(Eigen::Vector2d(x, y)).homogeneous().cast<float>();
                Eigen::Vector3f n =
                    Eigen::Vector3f(any(random), any(random), any(random)).normalized();
                if (n.dot(ray) > 0) n = -n;
                n = (n - 0.7F * ray.normalized()).normalized();
                normals.push_back(n);
                points.push_back(traced.T_world_camera.translation.cast<float>() + z * ray);
                roughness.push_back(0.5F + 0.5F * any(random));
                traced.packed.push_back(std::bit_cast<std::uint32_t>(z) | 7U);
                traced.gloss.push_back(packedGloss({n.x(), n.y(), n.z()}, roughness.back(), 1, 1));
            }
        traced.light.resize(points.size());
    }
    [[nodiscard]] Eigen::Vector3f seenFrom(const Eigen::Vector3d& eye, std::size_t i) const {
        return (eye.cast<float>() - points[i]).normalized();
    }
    /// Light that pixel `i` mirrors from the sky of smoothLight() to `eye`, times the exposure.
    [[nodiscard]] Eigen::Vector3f skyFor(const Eigen::Vector3d& eye, std::size_t i) const {
        const Eigen::Vector3f wo = seenFrom(eye, i);
        const Eigen::Vector3f towards = 2 * normals[i].dot(wo) * normals[i] - wo;
        const float width = roughness[i] * roughness[i];
        return 0.5F * (1 + width * (kTwice - 1)) * lightFrom(towards);
    }
    /// Mirrored light of sky and sun. The sun's irradiance is the same in all channels.
    [[nodiscard]] Eigen::Vector3f skyAndSunFor(const Eigen::Vector3d& eye, std::size_t i) const {
        const auto& towards = traced.mirrors->towardsSun;
        const Eigen::Vector3f sun(towards[0], towards[1], towards[2]), wo = seenFrom(eye, i);
        const float o = normals[i].dot(wo), to = normals[i].dot(sun);
        Eigen::Vector3f sky = skyFor(eye, i);
        if (!(to > 0)) return sky;
        const Ggx ggx(alphaOf(roughness[i]));
        const Eigen::Vector3f local = frameAround(normals[i]).transpose() * (wo + sun).normalized();
        const float irradiance = traced.mirrors->sunIrradiance[0];
        return sky.array() + 0.5F * irradiance * ggx.density(local) * ggx.visibility(o, to) * to;
    }
    void setLight(std::size_t i, const Eigen::Vector3f& specular) {
        traced.light[i] =
            packedWords({{0.1F, 0.2F, 0.3F}, {specular.x(), specular.y(), specular.z()}, 0.5F});
    }
};

}  // namespace mfar::test
