#include "pipeline/models/tangent_frames.h"

#include <Eigen/Geometry>

#include <cmath>

namespace mfar {
namespace {

constexpr float kShortest = 1e-20F;  ///< a vector with a smaller squared length counts as zero

std::vector<Eigen::Vector3f> normalsOf(const Mesh& mesh) {
    if (!mesh.normals.empty()) return mesh.normals;
    std::vector<Eigen::Vector3f> normals(mesh.positions.size(), Eigen::Vector3f::Zero());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Eigen::Vector3f& p = mesh.positions[a];
        const Eigen::Vector3f area = (mesh.positions[b] - p).cross(mesh.positions[c] - p);
        for (const std::uint32_t i : {a, b, c})
            normals[i] += area;
    }
    for (Eigen::Vector3f& n : normals)
        n = n.squaredNorm() > kShortest ? Eigen::Vector3f(n.normalized())
                                        : Eigen::Vector3f::UnitZ();
    return normals;
}

}  // namespace

Eigen::Vector3f anyOrthogonal(const Eigen::Vector3f& unit) {
    const Eigen::Vector3f other =
        std::abs(unit.x()) < 0.7F ? Eigen::Vector3f::UnitX() : Eigen::Vector3f::UnitY();
    return (other - unit * unit.dot(other)).normalized();
}

void addTangents(Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    std::vector<Eigen::Vector3f> alongU(count, Eigen::Vector3f::Zero()), alongV = alongU;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Eigen::Vector3f e1 = mesh.positions[b] - mesh.positions[a],
                              e2 = mesh.positions[c] - mesh.positions[a];
        const Eigen::Vector2f d1 = mesh.uvs[b] - mesh.uvs[a], d2 = mesh.uvs[c] - mesh.uvs[a];
        const float area = d1.x() * d2.y() - d2.x() * d1.y();
        if (!(std::abs(area) > 0)) continue;
        // The vectors are multiplied by the sign of the area instead of divided by the area. Larger
        // triangles then have more weight, and nothing overflows.
        const Eigen::Vector3f u = std::copysign(1.0F, area) * (e1 * d2.y() - e2 * d1.y()),
                              v = std::copysign(1.0F, area) * (e2 * d1.x() - e1 * d2.x());
        for (const std::uint32_t i : {a, b, c}) {
            alongU[i] += u;
            alongV[i] += v;
        }
    }
    const std::vector<Eigen::Vector3f> normals = normalsOf(mesh);
    mesh.tangents.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3f& n = normals[i];
        Eigen::Vector3f t = alongU[i] - n * n.dot(alongU[i]);
        // The negated comparison also handles NaN.
        if (!(t.squaredNorm() > kShortest) || !t.allFinite()) t = anyOrthogonal(n);
        t.normalize();
        const float sign = n.cross(t).dot(alongV[i]) > 0 ? -1.0F : 1.0F;
        mesh.tangents[i] << t, sign;
    }
}

}  // namespace mfar
