#include "tests/measure/triangulation/triangulation.h"

#include "tests/measure/triangulation/lens_step.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace mfar {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr double kShortest = 1e-9;     // shorter baselines count as zero [m]
constexpr double kLongestLine = 1e30;  // longer baselines and distances could overflow floats [m]
constexpr float kLargestInverseDepth = 1e6F;  // larger inverse depths count as unknown [1/m]
constexpr float kNearPlane = 0.05F;  // least z of a ray (x, y, 1) of view b, rotated into view a
constexpr float kNoAngle = 1e-9F;    // rays at a smaller angle count as parallel [normalised units]

std::size_t pixelsOf(Size size) {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

SplitVector split(const Eigen::Vector2d& v) {
    const Vector2f head = onGrid(v.cast<float>());
    return {head, (v - head.cast<double>()).cast<float>()};
}

std::vector<SplitVector> raysOf(const CameraModel& camera) {
    std::vector<SplitVector> rays;
    rays.reserve(pixelsOf(camera.size));
    Eigen::Vector2d ray(0, 0);
    for (int y = 0; y < camera.size.height; ++y)
        for (int x = 0; x < camera.size.width; ++x) {
            ray = camera.unproject({x, y}, ray);
            rays.push_back(split(ray));
        }
    return rays;
}

/// Motion from view a to view b, in camera coordinates of view a.
struct Motion {
    Eigen::Matrix3f turnHead = Eigen::Matrix3f::Zero(), turnTail = turnHead;  // R_a_b - I
    Vector3f baselineHead{0, 0, 0}, baselineTail{0, 0, 0};  // baseline scaled to length 1
    float length = 1;                                       // true length of the baseline [m]

    Motion() = default;
    /// A zero baseline gives zero parallax everywhere, so all depths are unknown.
    explicit Motion(const RigidTransform& T_b_a) {
        const Eigen::Matrix3d R_a_b = T_b_a.rotation.normalized().toRotationMatrix().transpose();
        const Eigen::Vector3d baseline = R_a_b * T_b_a.translation;
        const double norm = baseline.norm();
        if (!R_a_b.allFinite() || !(norm > kShortest && norm < kLongestLine)) return;
        const auto put = [](double value, float& head, float& tail) {
            const SplitVector s = split({value, 0});
            head = s.head.x();
            tail = s.tail.x();
        };
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j)
                put(R_a_b(i, j) - (i == j ? 1 : 0), turnHead(i, j), turnTail(i, j));
            put(baseline[i] / norm, baselineHead[i], baselineTail[i]);
        }
        length = static_cast<float>(norm);
    }
};

/// Parallax of a pixel in normalised coordinates of view a, after the rotation is removed. At
/// inverse depth s, with a baseline of length 1, u = s e / (1 + s b.z).
struct Parallax {
    Vector2f ray;  // ray of the pixel in view a
    Vector2f u;    // flow that remains after the rotation is removed
    Vector2f e;    // direction of the epipolar line: b.xy - ray b.z
    Vector3f b;    // unit baseline, or zero
};

float crossOf(const Vector2f& a, const Vector2f& b) {
    return a.x() * b.y() - a.y() * b.x();
}

float squaredNormal(const Vector2f& ray, const Vector2f& v) {
    const float z = crossOf(ray, v);
    return v.squaredNorm() + z * z;
}

/// Flow from the ray `a` of view a to the ray `b` of view b, after the rotation is removed. Empty
/// unless z of `b`, rotated into view a, exceeds kNearPlane.
std::optional<Vector2f> residualFlow(const Motion& motion, const SplitVector& a,
                                     const SplitVector& b) {
    const Vector3f head3 = b.head.homogeneous();
    const Vector3f ray3 = (b.head + b.tail).eval().homogeneous();
    const Vector3f turned = motion.turnHead * head3;
    const Vector3f rest = motion.turnTail * ray3 + motion.turnHead.leftCols<2>() * b.tail;
    const float z = 1 + turned.z() + rest.z();
    if (!(z > kNearPlane)) return std::nullopt;
    const float coarse = onGrid(Vector2f::Constant(turned.z())).x();
    const Vector2f exact = (b.head - a.head) + turned.head<2>() - a.head * coarse;
    const Vector2f rounded = (b.tail - a.tail) + rest.head<2>() -
                             a.head * ((turned.z() - coarse) + rest.z()) -
                             a.tail * (turned.z() + rest.z());
    return (exact + rounded) / z;
}

class PixelDepth {
public:
    PixelDepth(const CameraModel& b, const Motion& motion, const TriangulationOptions& options)
        : motion_(motion), method_(options.method),
          focal_(static_cast<float>(std::sqrt(b.fx * b.fy))),
          flowSigma_(static_cast<float>(options.flowSigma)),
          mostDistance_(static_cast<float>(std::min(options.maxRayDistance, kLongestLine))) {}

    [[nodiscard]] TriangulatedPoint at(const SplitVector& a, const SplitVector& b) const {
        const auto u = residualFlow(motion_, a, b);
        if (!u) return {0, kUnknownSigma, 0, 0};
        const Vector3f baseline = motion_.baselineHead + motion_.baselineTail;
        const Vector2f e = (motion_.baselineHead.head<2>() - a.head * motion_.baselineHead.z()) +
                           (motion_.baselineTail.head<2>() - a.head * motion_.baselineTail.z() -
                            a.tail * baseline.z());
        const Parallax s{a.head + a.tail, *u, e, baseline};
        const float unit = method_ == TriangulationMethod::Midpoint ? fromMidpoint(s) : fromFlow(s);
        const float inverseDepth = unit / motion_.length, distance = rayDistance(s);
        const bool known =
            inverseDepth > 0 && inverseDepth < kLargestInverseDepth && distance <= mostDistance_;
        return {known ? inverseDepth : 0, known ? sigmaOf(s) : kUnknownSigma, epipolarResidual(s),
                distance};
    }

private:
    /// Returns the inverse depth s, the solution of u = s e / (1 + s b.z): s = (u . e) / d, where d
    /// is |e|^2 - b.z (u . e). Returns 0 unless d is above 0.
    [[nodiscard]] static float fromFlow(const Parallax& s) {
        const float along = s.u.dot(s.e), d = s.e.squaredNorm() - s.b.z() * along;
        return d > 0 ? along / d : 0;
    }

    /// Inverse depth of the midpoint of the shortest line between both rays, as in the paper. The
    /// ends of the line are computed from the common normal n of the rays. n is computed from
    /// Parallax::u, because u is small: the product of two nearly parallel rays would be
    /// inaccurate. Returns 0 if an end or the midpoint is behind its camera.
    [[nodiscard]] static float fromMidpoint(const Parallax& s) {
        const Vector3f n(-s.u.y(), s.u.x(), crossOf(s.ray, s.u));
        const Vector3f first = s.ray.homogeneous();
        const Vector3f second = (s.ray + s.u).eval().homogeneous();
        const Vector3f c = -s.b;
        const float lengths = n.squaredNorm();
        const float onFirst = c.cross(second).dot(n);  // distance along the first ray, times |n|^2
        const float onSecond = c.cross(first).dot(n);
        const float z = 0.5F * (onFirst + onSecond + lengths * c.z());
        return onFirst > 0 && onSecond > 0 && z > 0 ? lengths / z : 0;
    }

    [[nodiscard]] float epipolarResidual(const Parallax& s) const {
        const float along = s.e.norm();
        return focal_ * (along > kNoAngle ? crossOf(s.e, s.u) / along : s.u.norm());
    }

    /// Distance between the two rays [m]: the length of the baseline times |b . n| / |n|, where
    /// n = ray x (u, 0) is normal to both rays. For parallel rays: times |b x ray| / |ray|. For
    /// b, ray and u, see Parallax.
    [[nodiscard]] float rayDistance(const Parallax& s) const {
        const float n2 = squaredNormal(s.ray, s.u), apart = crossOf(s.u, s.e);
        const float square = n2 > kNoAngle * kNoAngle
                                 ? apart * apart / n2
                                 : squaredNormal(s.ray, s.e) / (1 + s.ray.squaredNorm());
        return motion_.length * std::sqrt(square);
    }

    /// Standard deviation of the result of fromFlow(), to first order in the flow's error. No other
    /// method that finds depth from this flow has a smaller one.
    [[nodiscard]] float sigmaOf(const Parallax& s) const {
        const float ee = s.e.squaredNorm(), d = ee - s.b.z() * s.u.dot(s.e);
        const float sigma = flowSigma_ / focal_ * std::sqrt(ee) * ee / (d * d) / motion_.length;
        return sigma < kUnknownSigma ? sigma : kUnknownSigma;
    }

    const Motion& motion_;
    TriangulationMethod method_;
    float focal_, flowSigma_, mostDistance_;
};

}  // namespace

Triangulation::Triangulation(const CameraModel& a, const CameraModel& b)
    : a_(a), b_(b), raysA_(raysOf(a)), raysB_(raysOf(b)), points_(pixelsOf(a.size)) {}

const std::vector<TriangulatedPoint>& Triangulation::run(std::span<const float> flow,
                                                         const RigidTransform& T_b_a,
                                                         const TriangulationOptions& options) {
    if (flow.size() != 2 * points_.size())
        throw std::invalid_argument("the flow must have two numbers for each pixel of view a");
    const Motion motion(T_b_a);
    const PixelDepth depth(b_, motion, options);
    const Vector2f focal(static_cast<float>(b_.fx), static_cast<float>(b_.fy));
    const Vector2f end(static_cast<float>(b_.size.width) - 0.5F,
                       static_cast<float>(b_.size.height) - 0.5F);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const std::size_t column = i % a_.size.width, row = i / a_.size.width;
        const Vector2f p(static_cast<float>(column), static_cast<float>(row));
        const Vector2f f(flow[2 * i], flow[2 * i + 1]), q = p + f;
        points_[i] = {0, kUnknownSigma, 0, 0};
        if (!(q.x() >= -0.5F && q.y() >= -0.5F && q.x() <= end.x() && q.y() <= end.y())) continue;
        // Adds the remaining fraction of a pixel to the ray of the nearest pixel.
        const Vector2f whole = (f.array() + 0.5F).floor();
        const Vector2f last = end.array() - 0.5F;
        const Vector2f pixel = (p + whole).cwiseMax(Vector2f::Zero()).cwiseMin(last);
        const Vector2f fraction = (f - whole) + (p + whole - pixel);
        SplitVector b = raysB_[static_cast<std::size_t>(pixel.y()) * b_.size.width +
                               static_cast<std::size_t>(pixel.x())];
        const SplitVector step = undistortStep(b_, b.head + b.tail, fraction.cwiseQuotient(focal));
        b.head += step.head;
        b.tail += step.tail;
        points_[i] = depth.at(raysA_[i], b);
    }
    return points_;
}

}  // namespace mfar
