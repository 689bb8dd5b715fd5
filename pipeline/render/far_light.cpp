#include "pipeline/render/far_light.h"

#include "pipeline/render/microfacet.h"
#include "pipeline/render/sobol.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr float kFullSphere = 4 * std::numbers::pi_v<float>;
// Number of steps between texels along one side of the finest pyramid level. At the poles, a step
// is 0.45 degrees.
constexpr int kFinest = 256;
constexpr int kCoarsest = 8;
constexpr int kDiffuseEdge = 16;
// Number of steps between texels along one side of the pyramid level from which irradiance is
// computed.
constexpr int kIntegrated = 32;
constexpr int kSamples = 64;

/// Roughness and resolution of a table of mirrored light. For a roughness below that of the first
/// table, light is interpolated between the first table and the unfiltered light.
struct MirrorLevel {
    float roughness;
    int edge;
};
constexpr std::array<MirrorLevel, 6> kMirrorLevels = {
    {{0.25F, 128}, {0.4F, 64}, {0.55F, 32}, {0.7F, 32}, {0.85F, 16}, {1, 16}}};

float signOf(float x) {
    return x < 0 ? -1.0F : 1.0F;
}

/// Weight of texel i along one axis in a sum over all directions. On the border of the table, most
/// directions have two texels (see DirectionTable). So a border texel has the weight 1/2.
float partOfBorder(int i, int edge) {
    return i == 0 || i == edge - 1 ? 0.5F : 1.0F;
}

float solidAngle(const Eigen::Vector3f& direction, int edge) {
    const float step = 2.0F / static_cast<float>(edge - 1);
    const float norm1 = direction.lpNorm<1>();
    return step * step * norm1 * norm1 * norm1;
}

}  // namespace

DirectionTable::DirectionTable(int edge)
    : edge_(edge), values_(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge),
                           Eigen::Vector3f::Zero()) {}

Eigen::Vector3f DirectionTable::direction(int column, int row) const {
    const float scale = 2.0F / static_cast<float>(edge_ - 1);
    const float x = scale * static_cast<float>(column) - 1;
    const float y = scale * static_cast<float>(row) - 1;
    const float z = 1 - std::abs(x) - std::abs(y);
    if (z >= 0) return Eigen::Vector3f(x, y, z).normalized();
    return Eigen::Vector3f((1 - std::abs(y)) * signOf(x), (1 - std::abs(x)) * signOf(y), z)
        .normalized();
}

Eigen::Vector3f DirectionTable::operator()(const Eigen::Vector3f& direction) const {
    const Eigen::Vector3f p = direction / direction.lpNorm<1>();
    float x = p.x(), y = p.y();
    if (p.z() < 0) {
        x = (1 - std::abs(p.y())) * signOf(p.x());
        y = (1 - std::abs(p.x())) * signOf(p.y());
    }
    const float half = 0.5F * static_cast<float>(edge_ - 1);
    const float u = std::clamp((x + 1) * half, 0.0F, 2 * half);
    const float v = std::clamp((y + 1) * half, 0.0F, 2 * half);
    const int column = std::min(static_cast<int>(u), edge_ - 2);
    const int row = std::min(static_cast<int>(v), edge_ - 2);
    const float a = u - static_cast<float>(column), b = v - static_cast<float>(row);
    return (1 - b) * ((1 - a) * at(column, row) + a * at(column + 1, row)) +
           b * ((1 - a) * at(column, row + 1) + a * at(column + 1, row + 1));
}

FarLight::FarLight(const EnvironmentLight& environment, const Lighting& lighting,
                   const ShadowCatcher& catcher)
    : environment_(environment), dark_(environment.dark()), hasGround_(!catcher.positions.empty()),
      diffuse_(kDiffuseEdge) {
    if (lighting.sun && hasGround_) {
        const Sun& sun = *lighting.sun;
        const float height = sun.towards.normalized().z();
        if (height > 0) {
            ground_ = catcher.albedo.cwiseProduct(sun.irradiance) *
                      (height * std::numbers::inv_pi_v<float>);
            dark_ = false;
        }
    }
    if (dark_) return;
    const Eigen::Vector3f sunlit = ground_;
    Pyramid light = pyramid();
    makeDiffuse(light);
    if (hasGround_) {
        // The ground does not light itself, because no part of it is above its own horizon.
        ground_ = sunlit + catcher.albedo.cwiseProduct(diffuse_({0, 0, 1}));
        light = pyramid();
        makeDiffuse(light);
    }
    makeMirrored(light);
    for (const Eigen::Vector3f& axis :
         {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(0, 0, 1)})
        brightness_ += (diffuse_(axis) + diffuse_(-axis)).mean() / 6;
}

FarLight::Pyramid FarLight::pyramid() const {
    Pyramid out;
    out.emplace_back(kFinest + 1);
    DirectionTable& finest = out.front();
    for (int row = 0; row <= kFinest; ++row)
        for (int column = 0; column <= kFinest; ++column) {
            const Eigen::Vector3f d = finest.direction(column, row);
            finest.at(column, row) = radiance(d, environment_.radiance(d));
        }
    while (out.back().edge() > kCoarsest + 1) {
        const DirectionTable& fine = out.back();
        DirectionTable coarse((fine.edge() - 1) / 2 + 1);
        const int last = fine.edge() - 1;
        const auto inside = [last](int i) { return i < 0 ? -i : (i > last ? 2 * last - i : i); };
        for (int row = 0; row < coarse.edge(); ++row)
            for (int column = 0; column < coarse.edge(); ++column) {
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        sum += static_cast<float>((2 - dx * dx) * (2 - dy * dy)) *
                               fine.at(inside(2 * column + dx), inside(2 * row + dy));
                coarse.at(column, row) = sum / 16;
            }
        out.push_back(std::move(coarse));
    }
    return out;
}

void FarLight::makeDiffuse(const Pyramid& light) {
    const DirectionTable& from = *std::ranges::find_if(
        light, [](const DirectionTable& t) { return t.edge() <= kIntegrated + 1; });
    for (int row = 0; row < kDiffuseEdge; ++row)
        for (int column = 0; column < kDiffuseEdge; ++column) {
            const Eigen::Vector3f normal = diffuse_.direction(column, row);
            Eigen::Vector3f sum = Eigen::Vector3f::Zero();
            float weights = 0;
            for (int y = 0; y < from.edge(); ++y)
                for (int x = 0; x < from.edge(); ++x) {
                    const Eigen::Vector3f d = from.direction(x, y);
                    const float cosine = d.dot(normal);
                    if (!(cosine > 0)) continue;
                    const float weight = cosine * solidAngle(d, from.edge()) *
                                         partOfBorder(x, from.edge()) *
                                         partOfBorder(y, from.edge());
                    sum += weight * from.at(x, y);
                    weights += weight;
                }
            diffuse_.at(column, row) = sum / weights;
        }
}

void FarLight::makeMirrored(const Pyramid& light) {
    struct LobeSample {
        Eigen::Vector3f direction;
        float weight;
        std::size_t level;  // pyramid level with texels of about the sample's solid angle
    };
    for (const MirrorLevel& level : kMirrorLevels) {
        const Ggx ggx(alphaOf(level.roughness));
        const Eigen::Vector3f middle{0, 0, 1};
        std::vector<LobeSample> lobe;
        for (std::uint32_t i = 0; i < kSamples; ++i) {
            const float share = (static_cast<float>(i) + 0.5F) / kSamples;
            const float turn = static_cast<float>(reversedBits(i)) * 0x1p-32F;
            const Eigen::Vector3f h = ggx.sampleNormal(middle, {turn, share});
            const Eigen::Vector3f d = 2 * h.z() * h - middle;
            if (!(d.z() > 0)) continue;
            const float angle = 1 / (kSamples * ggx.reflectedDensity(middle, h));
            std::size_t coarse = 0;
            while (coarse + 1 < light.size() &&
                   kFullSphere / std::pow(static_cast<float>(light[coarse].edge() - 1), 2.0F) <
                       angle)
                ++coarse;
            lobe.push_back({d, d.z(), coarse});
        }
        DirectionTable table(level.edge + 1);
        for (int row = 0; row <= level.edge; ++row)
            for (int column = 0; column <= level.edge; ++column) {
                const Eigen::Matrix3f frame = frameAround(table.direction(column, row));
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                float weights = 0;
                for (const LobeSample& s : lobe) {
                    sum += s.weight * light[s.level](frame * s.direction);
                    weights += s.weight;
                }
                table.at(column, row) = sum / weights;
            }
        mirrored_.push_back(std::move(table));
    }
}

MirrorLight FarLight::tables() const {
    MirrorLight out;
    const auto add = [&](float roughness, const DirectionTable& table) {
        out.tables.push_back(
            {roughness, table.edge(), static_cast<std::uint32_t>(out.texels.size())});
        for (int row = 0; row < table.edge(); ++row)
            for (int column = 0; column < table.edge(); ++column) {
                const Eigen::Vector3f& light = table.at(column, row);
                out.texels.push_back(packedLight({light.x(), light.y(), light.z()}));
            }
    };
    if (dark_) {
        add(0, DirectionTable(2));
        return out;
    }
    add(0, pyramid().front());
    for (std::size_t i = 0; i < mirrored_.size(); ++i)
        add(kMirrorLevels[i].roughness, mirrored_[i]);
    return out;
}

Eigen::Vector3f FarLight::mirrored(const Eigen::Vector3f& direction, float roughness) const {
    const auto above = std::ranges::find_if(
        kMirrorLevels, [roughness](const MirrorLevel& l) { return l.roughness >= roughness; });
    const auto i = static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(above - kMirrorLevels.begin(), kMirrorLevels.size() - 1));
    if (i == 0) {
        const float share =
            alphaOf(std::max(roughness, 0.0F)) / alphaOf(kMirrorLevels.front().roughness);
        const Eigen::Vector3f sharp = radiance(direction, environment_.radiance(direction));
        return sharp + share * (mirrored_[0](direction) - sharp);
    }
    const float low = kMirrorLevels[i - 1].roughness, high = kMirrorLevels[i].roughness;
    const float share = std::clamp((roughness - low) / (high - low), 0.0F, 1.0F);
    const Eigen::Vector3f first = mirrored_[i - 1](direction);
    return first + share * (mirrored_[i](direction) - first);
}

}  // namespace mfar
