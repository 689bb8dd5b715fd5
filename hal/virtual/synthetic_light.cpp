#include "hal/virtual/synthetic_light.h"

#include "hal/virtual/synthetic_hash.h"
#include "hal/virtual/synthetic_ray.h"
#include "hal/virtual/synthetic_textures.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <thread>

namespace mfar::synthetic {
namespace {

constexpr int kAtlas = 1024;
constexpr double kSlack = 1e-3;  // margin around bounding spheres for rounding errors [m]
// Number of rays per texel towards the key light and the sky. Neighbouring texels use different
// rays and are blurred afterwards.
constexpr int kKeyRays = 12, kSkyRays = 16;

struct SurfacePoint {
    Eigen::Vector3d position, normal;  ///< in the primitive's frame; `position` in metres
};

/// Returns the point of a primitive's face with the face coordinates (s, t) in [-1, 1]^2. chart()
/// in synthetic_tables.glsl computes these coordinates from a point.
SurfacePoint surfacePoint(const Primitive& p, int axis, double sign, double s, double t) {
    Eigen::Vector3d unit, normal;
    if (p.shape == Shape::Cylinder && axis < 2) {
        const double angle = s * std::numbers::pi;
        unit = {std::sin(angle), -std::cos(angle), t};
        normal = {unit.x(), unit.y(), 0};
    } else {
        unit[axis] = sign;
        unit[(axis + 1) % 3] = s;
        unit[(axis + 2) % 3] = t;
        normal = Eigen::Vector3d::Unit(axis) * sign;
        if (p.shape == Shape::Ellipsoid) normal = unit = unit.normalized();
    }
    return {unit.cwiseProduct(p.half), normal.cwiseQuotient(p.half).normalized()};
}

class Baker {
public:
    Baker(const World& world, cv::Mat4b& texels)
        : world_(world), texels_(texels), solids_(still(world), 0) {
        const Eigen::Vector3d& l = world.light.towards;
        side_ = l.unitOrthogonal();
        up_ = l.cross(side_);
    }

    void bakeFace(int index, int axis, bool positive, cv::Rect area) const {
        const Primitive& p = world_.primitives[index];
        const int n = area.width;
        cv::Mat3f light(n, n);
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const SurfacePoint at = surfacePoint(p, axis, positive ? 1 : -1,
                                                     (2. * i + 1) / n - 1, (2. * j + 1) / n - 1);
                const Eigen::Vector3d e =
                    lightAt(index, p.T_world_prim * at.position,
                            p.T_world_prim.rotation * at.normal, hash(i, j, 3 * axis + positive));
                light(j, i) = cv::Vec3f(cv::Vec3d(e.x(), e.y(), e.z()));
            }
        }
        // Removes the noise of ray sampling and hardly changes the shadows.
        if (n >= 12) cv::GaussianBlur(light, light, {0, 0}, 0.9, 0.9, cv::BORDER_REPLICATE);
        cv::Mat4b out = texels_(area);
        eachPixel(out, [&](cv::Vec4b& o, const int* q) {
            for (int k = 0; k < 3; ++k)
                o[k] = cv::saturate_cast<unsigned char>(light(q)[k] * 255 / LightMap::kFullScale);
        });
    }

private:
    /// Moves the moving objects far away, so that they cast no shadows and reflect no light in the
    /// light map.
    static World still(const World& world) {
        World out = world;
        for (Primitive& p : out.primitives)
            if (p.moves) p.T_world_prim.translation.z() = -1e6;
        return out;
    }

    Eigen::Vector3d lightAt(int index, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                            std::uint64_t seed) const {
        const Eigen::Vector3d origin = point + 1e-5 * normal;
        const Lighting& light = world_.light;
        const double turn = hashUnit(seed), shift = hashUnit(mix(seed));
        double key = 0;
        if (normal.dot(light.towards) > 0) {
            const auto between = towardsLight(origin);
            int seen = 0;
            for (int i = 0; i < kKeyRays; ++i) {
                const double r = light.spread * std::sqrt((i + shift) / kKeyRays);
                const double a = 2 * std::numbers::pi * (i * 0.61803399 + turn);
                const Eigen::Vector3d towards =
                    light.towards + r * (std::cos(a) * side_ + std::sin(a) * up_);
                if (!solids_.blocked({origin, towards}, 1e9, -1, between)) ++seen;
            }
            key = normal.dot(light.towards) * seen / kKeyRays;
        }
        return light.key * key + skyAt(index, origin, normal, turn, shift);
    }

    /// Returns the cosine-weighted light from the sky. A solid within reach() hides a part of the
    /// sky and reflects coloured light instead.
    Eigen::Vector3d skyAt(int index, const Eigen::Vector3d& origin, const Eigen::Vector3d& normal,
                          double turn, double shift) const {
        const Eigen::Vector3d side = normal.unitOrthogonal(), up = normal.cross(side);
        const auto around = withinReach(origin, normal);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int i = 0; i < kSkyRays; ++i) {
            const double u = (i + shift) / kSkyRays;
            const double a = 2 * std::numbers::pi * (i * 0.61803399 + turn);
            const Eigen::Vector3d d =
                std::sqrt(u) * (std::cos(a) * side + std::sin(a) * up) + std::sqrt(1 - u) * normal;
            const auto hit = solids_.cast({origin, d}, reach(), around);
            if (!hit) {
                sum += world_.light.ambient * (0.75 + 0.45 * d.z());
                continue;
            }
            const Primitive& other = world_.primitives[hit->primitive];
            const Eigen::Vector3d& tint = world_.materials[other.materials[hit->axis]].tint;
            if (hit->primitive != index)
                sum += 0.42 * tint.cwiseProduct(world_.light.ambient + 0.35 * world_.light.key);
        }
        return sum / kSkyRays;
    }

    std::vector<int> towardsLight(const Eigen::Vector3d& point) const {
        std::vector<int> out;
        for (int i = 0; i < solids_.size(); ++i) {
            const Eigen::Vector3d to = solids_.pose(i).translation - point;
            const double along = to.dot(world_.light.towards), radius = solids_.radius(i) + kSlack;
            const double aside = (to - along * world_.light.towards).norm();
            if (along + radius > 0 && aside < radius + world_.light.spread * (along + radius))
                out.push_back(i);
        }
        return out;
    }

    std::vector<int> withinReach(const Eigen::Vector3d& point,
                                 const Eigen::Vector3d& normal) const {
        std::vector<int> out;
        for (int i = 0; i < solids_.size(); ++i) {
            const Eigen::Vector3d to = solids_.pose(i).translation - point;
            const double radius = solids_.radius(i) + kSlack;
            if (to.dot(normal) > -radius && to.norm() < reach() + radius) out.push_back(i);
        }
        return out;
    }

    /// Returns the largest distance at which a solid hides the sky [m]. Without this limit, closed
    /// rooms would be dark.
    double reach() const { return 0.45 * (world_.target - world_.eye).norm(); }

    const World& world_;
    cv::Mat4b& texels_;
    Snapshot solids_;
    Eigen::Vector3d side_, up_;
};

/// Arranges the 3 x 2 faces of every primitive in the light map, row after row. Returns for each
/// primitive the rectangle of its faces [texels].
std::vector<cv::Rect> layOut(const World& world) {
    std::vector<cv::Rect> out;
    int x = 0, y = 0, rowHeight = 0;
    for (const Primitive& p : world.primitives) {
        const cv::Size block(3 * p.lightTexels, 2 * p.lightTexels);
        if (x + block.width > kAtlas) {
            x = 0;
            y += rowHeight;
            rowHeight = 0;
        }
        if (y + block.height > kAtlas) throw std::logic_error("light map atlas is full");
        out.push_back({x, y, block.width, block.height});
        x += block.width;
        rowHeight = std::max(rowHeight, block.height);
    }
    return out;
}

cv::Mat4b bakeTexels(const World& world, const std::vector<cv::Rect>& blocks) {
    cv::Mat4b texels(kAtlas, kAtlas, cv::Vec4b::all(255));
    const Baker baker(world, texels);
    const int count = static_cast<int>(blocks.size());
    const auto bakeEvery = [&](int first, int step) {
        for (int i = first; i < count; i += step) {
            const int n = world.primitives[i].lightTexels;
            for (int face = 0; face < 6; ++face)
                baker.bakeFace(i, face / 2, face % 2 == 1,
                               {blocks[i].x + face / 2 * n, blocks[i].y + face % 2 * n, n, n});
        }
    };
    std::jthread other(bakeEvery, 1, 2);
    bakeEvery(0, 2);
    other.join();
    return texels;
}

}  // namespace

LightMap bakeLight(const World& world, const TexelStore& store) {
    const std::vector<cv::Rect> blocks = layOut(world);
    LightMap map;
    for (const cv::Rect& b : blocks)
        map.faces.push_back(Eigen::Vector4f(static_cast<float>(b.x), static_cast<float>(b.y),
                                            static_cast<float>(b.width) / 3,
                                            static_cast<float>(b.height) / 2) /
                            kAtlas);
    map.texels = store.get(lightKey(world), kAtlas, [&] { return bakeTexels(world, blocks); });
    return map;
}

}  // namespace mfar::synthetic
