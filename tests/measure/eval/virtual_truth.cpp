#include "tests/measure/eval/virtual_truth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar::eval {
namespace {

// Smallest ratio of inverse depths that counts as clearly in front.
constexpr double kClearlyBefore = 1.1;

struct LocalRay {
    Eigen::Vector3d origin, direction;
};

LocalRay localRay(const VirtualObject& object, const RigidTransform& T_world_camera,
                  const Eigen::Vector2d& ray) {
    const RigidTransform T_object_camera = object.T_world_object.inverse() * T_world_camera;
    Eigen::Vector3d size = object.size;
    if (object.shape == VirtualShape::Quad) size.z() = 1;
    return {T_object_camera.translation.cwiseQuotient(size),
            (T_object_camera.rotation * ray.homogeneous()).cwiseQuotient(size)};
}

double throughSphere(const LocalRay& r) {
    const double a = r.direction.squaredNorm(), b = r.direction.dot(r.origin);
    const double root = b * b - a * (r.origin.squaredNorm() - 0.25);
    return root > 0 ? (-b - std::sqrt(root)) / a : 0;
}

double throughBox(const LocalRay& r) {
    double in = -HUGE_VAL, out = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        if (r.direction[k] == 0 && std::abs(r.origin[k]) > 0.5) return 0;
        if (r.direction[k] == 0) continue;
        const double a = (-0.5 - r.origin[k]) / r.direction[k];
        const double b = (0.5 - r.origin[k]) / r.direction[k];
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
    }
    return in < out ? in : 0;
}

double throughQuad(const LocalRay& r) {
    if (r.direction.z() == 0) return 0;
    const double t = -r.origin.z() / r.direction.z();
    const Eigen::Vector2d at = (r.origin + t * r.direction).head<2>();
    return at.cwiseAbs().maxCoeff() <= 0.5 ? t : 0;
}

}  // namespace

// The ray has z = 1 in camera coordinates, so its parameter t is the depth.
double surfaceDepth(const VirtualObject& object, const RigidTransform& T_world_camera,
                    const Eigen::Vector2d& ray) {
    const LocalRay local = localRay(object, T_world_camera, ray);
    double t = 0;
    switch (object.shape) {
    case VirtualShape::Sphere: t = throughSphere(local); break;
    case VirtualShape::Box: t = throughBox(local); break;
    case VirtualShape::Quad: t = throughQuad(local); break;
    }
    return t > 0 ? t : 0;
}

VirtualTruth virtualTruth(std::span<const VirtualObject> objects, const CameraModel& video,
                          const RigidTransform& T_world_video, const FloatImage& real) {
    CV_Assert(real.size == video.size);
    VirtualTruth out{cv::Mat(video.size.height, video.size.width, CV_8U, cv::Scalar(0)), {}, {}};
    out.visible = out.silhouette.clone();
    out.undecided = out.silhouette.clone();
    for (int y = 0; y < video.size.height; ++y) {
        for (int x = 0; x < video.size.width; ++x) {
            const Eigen::Vector2d ray = video.unproject({x, y});
            double nearest = 0;
            for (const VirtualObject& object : objects)
                if (const double z = surfaceDepth(object, T_world_video, ray); z > 0)
                    nearest = std::max(nearest, 1 / z);
            if (nearest > 0) out.silhouette.at<std::uint8_t>(y, x) = 255;
            if (nearest > 0 && nearest >= real.at(x, y)) out.visible.at<std::uint8_t>(y, x) = 255;
            if (nearest > 0 && nearest < kClearlyBefore * real.at(x, y))
                out.undecided.at<std::uint8_t>(y, x) = 255;
        }
    }
    return out;
}

}  // namespace mfar::eval
