#include "pipeline/render/environment_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace mfar {
namespace {

constexpr double kEvenLight = 1e-3;
constexpr float kTurn = 2 * std::numbers::pi_v<float>;

double accumulate(std::span<const double> weights, float* shares) {
    double sum = 0;
    for (const double w : weights)
        sum += w;
    double before = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        shares[i] = sum > 0 ? static_cast<float>(before / sum) : 0;
        before += weights[i];
    }
    shares[weights.size()] = 1;
    return sum;
}

struct Drawn {
    int index;
    float rest;
};

Drawn drawFrom(std::span<const float> shares, float u) {
    const auto after = std::upper_bound(shares.begin() + 1, shares.end() - 1, u);
    const auto index = after - shares.begin() - 1;
    const float low = shares[index], high = shares[index + 1];
    const float rest = high > low ? (u - low) / (high - low) : 0.5F;
    return {static_cast<int>(index), std::clamp(rest, 0.0F, 1 - 0x1p-24F)};
}

float brightness(const Eigen::Vector3f& rgb) {
    return 0.2126F * rgb.x() + 0.7152F * rgb.y() + 0.0722F * rgb.z();
}

}  // namespace

EnvironmentLight::EnvironmentLight(std::shared_ptr<const Environment> environment)
    : environment_(std::move(environment)) {
    if (!environment_) return;
    size_ = environment_->size;
    const auto width = static_cast<std::size_t>(size_.width);
    for (int row = 0; row <= size_.height; ++row)
        tops_.push_back(
            std::cos(kTurn / 2 * static_cast<float>(row) / static_cast<float>(size_.height)));
    rows_.resize(static_cast<std::size_t>(size_.height) + 1);
    texels_.resize((width + 1) * static_cast<std::size_t>(size_.height));
    // Interpolation spreads the light of a texel over half of each neighbouring texel. So the
    // probability of a texel is computed from its brightness after interpolation.
    std::vector<double> brightnesses;
    double sum = 0;
    for (int row = 0; row < size_.height; ++row)
        for (int column = 0; column < size_.width; ++column) {
            brightnesses.push_back(meanBrightness(column, row));
            sum += brightnesses.back() * (heightOf(row) - heightOf(row + 1));
        }
    const double mean = sum / (2.0 * size_.width);
    dark_ = !(sum > 0);
    for (double& b : brightnesses)
        b = std::max(0.0, b - (1 + kEvenLight) * mean);
    std::vector<double> rowWeights;
    for (int row = 0; row < size_.height; ++row) {
        const auto first = static_cast<std::size_t>(row) * width;
        const double rowSum = accumulate(std::span(brightnesses).subspan(first, width),
                                         &texels_[static_cast<std::size_t>(row) * (width + 1)]);
        rowWeights.push_back(rowSum * (heightOf(row) - heightOf(row + 1)));
    }
    sampled_ = accumulate(rowWeights, rows_.data()) > 0;
}

float EnvironmentLight::meanBrightness(int column, int row) const {
    float sum = 0;
    for (const float dx : {0.25F, 0.75F})
        for (const float dy : {0.25F, 0.75F})
            sum += brightness(
                interpolated({static_cast<float>(column) + dx, static_cast<float>(row) + dy}));
    return sum / 4;
}

LightSample EnvironmentLight::sample(const Eigen::Vector2f& u) const {
    const auto width = static_cast<std::size_t>(size_.width);
    const auto [row, down] = drawFrom(rows_, u.y());
    const auto [column, right] = drawFrom(
        std::span(texels_).subspan(static_cast<std::size_t>(row) * (width + 1), width + 1), u.x());
    const float z = heightOf(row) + down * (heightOf(row + 1) - heightOf(row));
    const float across = (static_cast<float>(column) + right) / static_cast<float>(size_.width);
    const float phi = kTurn * (across - 0.5F);
    const float r = std::sqrt(std::max(0.0F, 1 - z * z));
    LightSample out;
    out.direction = {r * std::cos(phi), r * std::sin(phi), z};
    out.radiance = interpolated(
        {across * static_cast<float>(size_.width),
         std::acos(std::clamp(z, -1.0F, 1.0F)) / (kTurn / 2) * static_cast<float>(size_.height)});
    out.density = density(column, row);
    return out;
}

Eigen::Vector2f EnvironmentLight::place(const Eigen::Vector3f& direction) const {
    const float across = std::atan2(direction.y(), direction.x()) / kTurn + 0.5F;
    const float down = std::acos(std::clamp(direction.z(), -1.0F, 1.0F)) / (kTurn / 2);
    return {across * static_cast<float>(size_.width), down * static_cast<float>(size_.height)};
}

Eigen::Vector3f EnvironmentLight::interpolated(const Eigen::Vector2f& at) const {
    const auto texel = [&](int column, int row) -> const Eigen::Vector3f& {
        const int wrapped = column < 0 ? column + size_.width
                                       : (column >= size_.width ? column - size_.width : column);
        const int kept = std::clamp(row, 0, size_.height - 1);
        return environment_
            ->radiance[static_cast<std::size_t>(kept) * static_cast<std::size_t>(size_.width) +
                       static_cast<std::size_t>(wrapped)];
    };
    const float x = std::clamp(at.x() - 0.5F, -0.5F, static_cast<float>(size_.width) - 0.5F);
    const float y = std::clamp(at.y() - 0.5F, -0.5F, static_cast<float>(size_.height) - 0.5F);
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const float a = x - static_cast<float>(column), b = y - static_cast<float>(row);
    const Eigen::Vector3f top = texel(column, row) * (1 - a) + texel(column + 1, row) * a;
    const Eigen::Vector3f bottom =
        texel(column, row + 1) * (1 - a) + texel(column + 1, row + 1) * a;
    return top * (1 - b) + bottom * b;
}

float EnvironmentLight::density(int column, int row) const {
    const auto r = static_cast<std::size_t>(row);
    const std::size_t i =
        r * (static_cast<std::size_t>(size_.width) + 1) + static_cast<std::size_t>(column);
    const float share = (rows_[r + 1] - rows_[r]) * (texels_[i + 1] - texels_[i]);
    const float angle =
        kTurn / static_cast<float>(size_.width) * (heightOf(row) - heightOf(row + 1));
    return share / angle;
}

Eigen::Vector3f EnvironmentLight::radiance(const Eigen::Vector3f& direction) const {
    return environment_ ? interpolated(place(direction)) : Eigen::Vector3f(0, 0, 0);
}

float EnvironmentLight::density(const Eigen::Vector3f& direction) const {
    return sampled_ ? densityAt(place(direction)) : 0;
}

float EnvironmentLight::densityAt(const Eigen::Vector2f& at) const {
    return density(std::clamp(static_cast<int>(at.x()), 0, size_.width - 1),
                   std::clamp(static_cast<int>(at.y()), 0, size_.height - 1));
}

EnvironmentLight::Seen EnvironmentLight::seen(const Eigen::Vector3f& direction) const {
    if (dark_) return {};
    const Eigen::Vector2f at = place(direction);
    return {interpolated(at), sampled_ ? densityAt(at) : 0};
}

}  // namespace mfar
