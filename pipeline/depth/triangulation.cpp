#include "pipeline/depth/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

constexpr const char* kWrongSize = "flow does not have the size of the view";
constexpr double kGrid = 4096;         // of heads, see triangulation.glsl
constexpr double kShortest = 1e-9;     // baseline [m]
constexpr double kLongestLine = 1e30;  // finite in single precision [m]

struct Split {
    float head, tail;
};

Split split(double value) {
    const double head = std::round(value * kGrid) / kGrid;
    return {static_cast<float>(head), static_cast<float>(value - head)};
}

gpu::Texture raysOf(const CameraModel& camera) {
    std::vector<float> rays;
    rays.reserve(4UL * camera.size.width * camera.size.height);
    Eigen::Vector2d ray(0, 0);
    for (int y = 0; y < camera.size.height; ++y)
        for (int x = 0; x < camera.size.width; ++x) {
            ray = camera.unproject({x, y}, ray);
            const Split u = split(ray.x()), v = split(ray.y());
            rays.insert(rays.end(), {u.head, v.head, u.tail, v.tail});
        }
    gpu::Texture out(camera.size, gpu::TexelFormat::Rgba32F);
    out.upload(rays);
    return out;
}

void put(float (&head)[4], float (&tail)[4], const Eigen::Vector3d& values) {
    for (int i = 0; i < 3; ++i) {
        const Split s = split(values[i]);
        head[i] = s.head;
        tail[i] = s.tail;
    }
}

}  // namespace

Triangulation::Triangulation(const CameraModel& a, const CameraModel& b)
    : a_(a), b_(b), raysA_(raysOf(a)), raysB_(raysOf(b)), flow_(a.size, gpu::TexelFormat::Rg32F),
      points_(pixels() * sizeof(TriangulatedPoint)), fromFlow_("depth_from_flow.comp"),
      midpoint_("depth_midpoint.comp") {}

std::size_t Triangulation::pixels() const {
    return static_cast<std::size_t>(a_.size.width) * a_.size.height;
}

Triangulation::Params Triangulation::params(const RigidTransform& T_b_a,
                                            const TriangulationOptions& options) const {
    Params p{};
    std::ranges::copy(std::array{a_.size.width, a_.size.height, b_.size.width, b_.size.height},
                      p.sizes);
    const auto& d = b_.distortion;
    const auto f = [](double value) { return static_cast<float>(value); };
    std::ranges::copy(std::array{f(b_.fx), f(b_.fy), f(d[0]), f(d[1])}, p.lensB);
    std::ranges::copy(std::array{f(d[2]), f(d[3]), f(d[4])}, p.tangentialB);
    p.tune[0] = f(options.flowSigma);
    p.tune[1] = f(std::sqrt(b_.fx * b_.fy));
    p.tune[2] = f(std::min(options.maxRayDistance, kLongestLine));
    p.baselineHead[3] = 1;
    const Eigen::Matrix3d R_a_b = T_b_a.rotation.normalized().toRotationMatrix().transpose();
    const Eigen::Vector3d baseline = R_a_b * T_b_a.translation;
    const double length = baseline.norm();
    // A zero baseline gives zero parallax everywhere: nothing is known.
    if (!R_a_b.allFinite() || !(length > kShortest && length < kLongestLine)) return p;
    for (int i = 0; i < 3; ++i)
        put(p.turnHead[i], p.turnTail[i], R_a_b.row(i) - Eigen::Matrix3d::Identity().row(i));
    put(p.baselineHead, p.baselineTail, baseline / length);
    p.baselineHead[3] = f(length);
    return p;
}

void Triangulation::run(const gpu::Texture& flow, const RigidTransform& T_b_a,
                        const TriangulationOptions& options) {
    if (flow.size() != a_.size) throw std::invalid_argument(kWrongSize);
    auto& pass = options.method == TriangulationMethod::Midpoint ? midpoint_ : fromFlow_;
    pass.run(params(T_b_a, options),
             {gpu::sampler(0, flow), gpu::sampler(1, raysA_), gpu::sampler(2, raysB_),
              gpu::storage(0, points_)},
             {gpu::groupsFor(a_.size.width, 16), gpu::groupsFor(a_.size.height, 4), 1});
}

void Triangulation::run(std::span<const float> flow, const RigidTransform& T_b_a,
                        const TriangulationOptions& options) {
    if (flow.size() != 2 * pixels()) throw std::invalid_argument(kWrongSize);
    flow_.upload(flow);
    run(flow_, T_b_a, options);
}

std::vector<TriangulatedPoint> Triangulation::read() const {
    return points_.read<TriangulatedPoint>(pixels());
}

}  // namespace mfar
