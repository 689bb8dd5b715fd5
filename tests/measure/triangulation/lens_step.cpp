#include "tests/measure/triangulation/lens_step.h"

namespace mfar {
namespace {

using Eigen::Vector2f;

constexpr float kLeastDeterminant = 0.05F;
constexpr int kSteps = 3;

}  // namespace

SplitVector undistortStep(const CameraModel& camera, const Vector2f& r, const Vector2f& g) {
    const auto& c = camera.distortion;
    const Eigen::Vector3f k = Eigen::Vector3d(c[0], c[1], c[4]).cast<float>();
    const Vector2f t = Eigen::Vector2d(c[2], c[3]).cast<float>();
    SplitVector out{Vector2f::Zero(), Vector2f::Zero()};
    const float r2 = r.squaredNorm();
    const float bend = r2 * (k.x() + r2 * (k.y() + r2 * k.z()));
    const float slope = 2 * (k.x() + r2 * (2 * k.y() + 3 * r2 * k.z()));
    const float across = slope * r.x() * r.y() + 2 * t.dot(r);
    const float jx = 1 + bend + slope * r.x() * r.x() + 2 * t.x() * r.y() + 6 * t.y() * r.x();
    const float jy = 1 + bend + slope * r.y() * r.y() + 6 * t.x() * r.y() + 2 * t.y() * r.x();
    const float det = jx * jy - across * across;
    if (!(det > kLeastDeterminant)) return out;
    for (int i = 0; i < kSteps; ++i) {
        const Vector2f w = out.head + out.tail;
        const Vector2f squares = w.cwiseProduct(2 * r + w);
        const float d = squares.sum(), s2 = r2 + d;
        const float change =
            d * (k.x() + k.y() * (s2 + r2) + k.z() * (s2 * s2 + s2 * r2 + r2 * r2));
        const float product = r.x() * w.y() + r.y() * w.x() + w.x() * w.y();
        const Vector2f bent =
            w * (bend + change) + r * change + 2 * t * product +
            Vector2f(t.y(), t.x()).cwiseProduct(Vector2f::Constant(d) + 2 * squares);
        const Vector2f off = ((g - out.head) - out.tail) - bent;
        out.tail +=
            Vector2f(jy * off.x() - across * off.y(), jx * off.y() - across * off.x()) / det;
        const Vector2f whole = onGrid(out.tail);
        out.head += whole;
        out.tail -= whole;
    }
    return out;
}

}  // namespace mfar
