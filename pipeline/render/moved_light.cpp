#include "pipeline/render/moved_light.h"

#include "base/luminance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

// Smaller motions count as no motion [rad], [m].
constexpr double kLeastTurn = 1e-5, kLeastWay = 1e-6;
// Smaller motions of two objects relative to each other count as no motion [rad], [radii]. They are
// computed with larger rounding errors.
constexpr float kLeastRelativeMotion = 1e-3F;
// Assumed standard deviation of a single sample, relative to the light.
constexpr float kNoise = 0.5F;
// The light that a moved object receives from lights and objects at rest is assumed to change by
// this share if the object moves by its radius or turns by a radian.
constexpr float kOwnChange = 0.5F;
// The sun's shadow is expected up to this angle outside of the ball around an object [rad].
constexpr float kPenumbra = 0.03F;
constexpr float kLeastLight = 1e-6F;

}  // namespace

float MovedLight::Ball::way() const {
    return (now - before).norm() / std::max(radius, 1e-6F);
}

float MovedLight::Ball::fresh() const {
    return std::min(1.0F, way() + turn);
}

struct MovedLight::Sight {
    Eigen::Vector3f towards{0, 0, 1};
    float sine = 1;  ///< sine of the ball's angular radius

    Sight(const Eigen::Vector3f& point, const Eigen::Vector3f& centre, float radius) {
        const Eigen::Vector3f way = centre - point;
        const float distance = way.norm();
        if (!(distance > 0)) return;
        towards = way / distance;
        sine = std::min(1.0F, radius / distance);
    }
    [[nodiscard]] bool covers(const Eigen::Vector3f& direction, float margin) const {
        const float angle = std::acos(std::clamp(towards.dot(direction), -1.0F, 1.0F));
        return angle < std::asin(sine) + margin;
    }
};

float stillWorth(float count, float change) {
    const float bias = change / kNoise;
    return count / (1 + count * bias * bias);
}

MovedLight::MovedLight(std::span<const Object> objects, const SunLight& sun, const FarLight& far)
    : sun_(sun), far_(far) {
    for (const Object& o : objects) {
        const RigidTransform T = o.T_world_before * o.T_world_now.inverse();
        const double turn = o.T_world_before.rotation.angularDistance(o.T_world_now.rotation);
        const Eigen::Vector3d before = o.T_world_before * o.own.centre,
                              now = o.T_world_now * o.own.centre;
        if (!(turn > kLeastTurn || (now - before).norm() > kLeastWay)) continue;
        Moved& moved = moved_.emplace_back();
        moved.id = o.id;
        moved.ball = {before.cast<float>(), now.cast<float>(), static_cast<float>(o.own.radius),
                      static_cast<float>(turn), o.glow};
        moved.T_before_now =
            Eigen::Translation3f(T.translation.cast<float>()) * T.rotation.cast<float>();
        balls_.push_back(moved.ball);
    }
    for (Moved& own : moved_)
        own.others = othersOf(own, moved_);
}

std::vector<MovedLight::Ball> MovedLight::othersOf(const Moved& own, std::span<const Moved> moved) {
    std::vector<Ball> out;
    for (const Moved& other : moved) {
        if (other.id == own.id) continue;
        Ball ball = other.ball;
        ball.before = own.T_before_now.inverse() * ball.before;
        ball.turn =
            Eigen::AngleAxisf(own.T_before_now.linear().transpose() * other.T_before_now.linear())
                .angle();
        if (ball.turn > kLeastRelativeMotion || ball.way() > kLeastRelativeMotion)
            out.push_back(ball);
    }
    return out;
}

const MovedLight::Moved* MovedLight::find(std::uint8_t id) const {
    const auto found = std::ranges::find(moved_, id, &Moved::id);
    return found == moved_.end() ? nullptr : &*found;
}

void MovedLight::follow(std::uint8_t id, Eigen::Vector3f& point, Eigen::Vector3f& normal,
                        Eigen::Vector3f& eye) const {
    const Moved* moved = find(id);
    if (moved == nullptr) return;
    point = moved->T_before_now * point;
    normal = moved->T_before_now.linear() * normal;
    eye = moved->T_before_now * eye;
}

/// Returns the irradiance that a surface loses because the ball blocks distant light, divided by
/// pi: that of the sky and that of the sun.
MovedLight::Blocked MovedLight::blocked(const Sight& sight, const Eigen::Vector3f& normal) const {
    // The result is an upper limit: a ball that is partly below the surface's horizon hides less.
    const float facing = std::clamp(normal.dot(sight.towards) + sight.sine, 0.0F, 1.0F);
    const float sky =
        far_.dark() ? 0 : luminanceOf<float>(far_.mirrored(sight.towards, std::sqrt(sight.sine)));
    Blocked out{sight.sine * sight.sine * facing * sky, 0};
    const float sunFacing = normal.dot(sun_.towards());
    if (!sun_.dark() && sunFacing > 0 &&
        sight.covers(sun_.towards(), sun_.angularRadius() + kPenumbra))
        out.sun = luminanceOf<float>(sun_.irradiance()) * sunFacing / std::numbers::pi_v<float>;
    return out;
}

float MovedLight::diffuseChange(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const {
    return diffuseChange(balls_, point, normal);
}

float MovedLight::diffuseChange(std::span<const Ball> balls, const Eigen::Vector3f& point,
                                const Eigen::Vector3f& normal) const {
    float sum = 0;
    for (const Ball& ball : balls) {
        const Sight before(point, ball.before, ball.radius), now(point, ball.now, ball.radius);
        const float fresh = ball.fresh();
        const float glow = ball.glow * std::max(before.sine * before.sine, now.sine * now.sine);
        const Blocked was = blocked(before, normal), is = blocked(now, normal);
        sum += fresh * (std::max(was.sky, is.sky) + glow);
        // At a point, the whole sun is visible or hidden. This changes in the share `fresh` of the
        // shadow's area, so the RMS change over this area is the root of `fresh`.
        sum += std::sqrt(fresh) * std::max(was.sun, is.sun);
    }
    const float sun = std::max(normal.dot(sun_.towards()), 0.0F) *
                      luminanceOf<float>(sun_.irradiance()) / std::numbers::pi_v<float>;
    return sum / std::max(luminanceOf<float>(far_.diffuse(normal)) + sun, kLeastLight);
}

MovedLight::Change MovedLight::at(const SeenSurface& seen, const Eigen::Vector3f& point,
                                  const Eigen::Vector3f& eye) const {
    const Moved* own = find(seen.hit.id);
    const std::span<const Ball> balls = own != nullptr ? own->others : balls_;
    Change out{diffuseChange(balls, point, seen.normal), 0};
    const Eigen::Vector3f view = (point - eye).normalized();
    const Eigen::Vector3f mirrored = view - 2 * seen.normal.dot(view) * seen.normal;
    const float alpha = std::max(seen.roughness * seen.roughness, 1e-3F);
    for (const Ball& ball : balls)
        for (const Eigen::Vector3f& centre : {ball.before, ball.now}) {
            const Sight sight(point, centre, ball.radius);
            if (!sight.covers(mirrored, 2 * alpha)) continue;
            const float square = sight.sine * sight.sine;
            out.specular += ball.fresh() * square / (square + alpha * alpha);
        }
    if (own == nullptr) return out;
    const float change = kOwnChange * (own->ball.turn + own->ball.way());
    return {out.diffuse + change, out.specular + change};
}

}  // namespace mfar
