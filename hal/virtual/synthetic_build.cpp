#include "hal/virtual/synthetic_build.h"

#include "hal/virtual/synthetic_textures.h"

#include <cassert>
#include <cmath>

namespace mfar::synthetic {
namespace {

// Side of the plate that carries a tag, including a white rim of one cell [cells].
constexpr double kPlateCells = kTagCells + 2;
constexpr double kPlateThickness = 0.004;

Eigen::Quaterniond aboutZ(double yaw) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

Eigen::Quaterniond axes(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
    Eigen::Matrix3d m;
    m << x, y, x.cross(y);
    return Eigen::Quaterniond(m);
}

/// Returns the smallest rotation that turns the z axis into this direction. Eigen's
/// FromTwoVectors() has the same result, but takes 12 s to compile, because it instantiates a
/// singular value decomposition for opposite vectors.
Eigen::Quaterniond fromZ(const Eigen::Vector3d& direction) {
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), to = direction.normalized();
    const double cosine = to.dot(z);
    if (cosine < -1 + 1e-12) return {0, 1, 0, 0};
    const double s = std::sqrt((1 + cosine) * 2);
    Eigen::Quaterniond out;
    out.vec() = z.cross(to) * (1 / s);
    out.w() = s * 0.5;
    return out;
}

}  // namespace

int Builder::material(const Material& m) {
    world.materials.push_back(m);
    return static_cast<int>(world.materials.size()) - 1;
}

int Builder::sheet(Layer layer, double width, double height, const Eigen::Vector3d& tint,
                   double gloss) {
    return material({layer, {1 / width, 1 / height}, {0.5, 0.5}, tint, 0.05, gloss});
}

int Builder::tiled(Layer layer, double perMetre, const Eigen::Vector3d& tint, double variation,
                   double gloss) {
    // Each material uses another part of its texture, so that no two surfaces look alike.
    const double shift = 0.37 * static_cast<double>(world.materials.size());
    return material({layer, {perMetre, perMetre}, {shift, 0.7 * shift}, tint, variation, gloss});
}

Primitive& Builder::box(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double yaw,
                        std::array<int, 3> materials) {
    assert(world.primitives.size() < kMaxPrimitives);
    world.primitives.push_back({Shape::Box, {aboutZ(yaw), centre}, size / 2, materials});
    return world.primitives.back();
}

Primitive& Builder::cylinder(const Eigen::Vector3d& centre, double radius, double height, int side,
                             int caps) {
    Primitive& p = box(centre, {2 * radius, 2 * radius, height}, 0, {side, side, caps});
    p.shape = Shape::Cylinder;
    return p;
}

Primitive& Builder::rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                        int m) {
    Primitive& p = cylinder((from + to) / 2, radius, (to - from).norm(), m, m);
    p.T_world_prim.rotation = fromZ(to - from);
    return p;
}

Primitive& Builder::ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii,
                              double yaw, int m) {
    Primitive& p = box(centre, 2 * radii, yaw, m);
    p.shape = Shape::Ellipsoid;
    return p;
}

int Builder::tagMaterial(int id, double plate) {
    Material m;
    m.layer = Layer::Tags;
    m.repeats = {0.5 / plate, 0.5 / plate};
    const int column = id % 2;
    const int row = id / 2;
    m.offset = {0.25 + 0.5 * column, 0.25 + 0.5 * row};
    m.variation = 0;
    return material(m);
}

void Builder::standingTag(int id, const Eigen::Vector3d& centre, double size, double yaw) {
    const double plate = size * kPlateCells / kTagCells;
    const int white = tiled(Layer::Enamel, 20, {0.8, 0.8, 0.78});
    box(centre, {plate, kPlateThickness, plate}, yaw, {white, tagMaterial(id, plate), white})
        .lightTexels = 24;
    const Eigen::Quaterniond turn = aboutZ(yaw);
    const Eigen::Vector3d front = centre - turn * Eigen::Vector3d(0, kPlateThickness / 2, 0);
    world.tags.push_back(
        {id, size, {turn * axes(Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitZ()), front}});
}

void Builder::lyingTag(int id, const Eigen::Vector3d& centre, double size, double yaw) {
    const double plate = size * kPlateCells / kTagCells;
    const int white = tiled(Layer::Enamel, 20, {0.8, 0.8, 0.78});
    box(centre, {plate, plate, kPlateThickness}, yaw, {white, white, tagMaterial(id, plate)})
        .lightTexels = 24;
    const Eigen::Vector3d top = centre + Eigen::Vector3d(0, 0, kPlateThickness / 2);
    world.tags.push_back(
        {id, size, {aboutZ(yaw) * axes(Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY()), top}});
}

void Builder::lyingBook(const Eigen::Vector3d& bottom, const Eigen::Vector3d& size, double yaw,
                        const Eigen::Vector3d& tint) {
    const int cover = sheet(Layer::Cover, size.x(), size.y(), tint, 0.4);
    const int sheets = tiled(Layer::Edges, 8, {1, 1, 1}, 0.1);
    constexpr double kBoard = 0.003;
    const Eigen::Vector3d up{0, 0, 1};
    const Eigen::Vector3d board{size.x(), size.y(), kBoard};
    const Eigen::Vector3d block{size.x() - 0.006, size.y() - 0.008, size.z() - 2 * kBoard};
    box(bottom + up * kBoard / 2, board, yaw, cover);
    box(bottom + up * size.z() / 2, block, yaw, sheets);
    box(bottom + up * (size.z() - kBoard / 2), board, yaw, cover).lightTexels = 24;
}

void Builder::standingBook(const Eigen::Vector3d& bottom, const Eigen::Vector3d& size, double yaw,
                           const Eigen::Vector3d& tint) {
    const int spine = sheet(Layer::Spine, size.x(), size.z(), tint, 0.35);
    const int side = sheet(Layer::Cover, size.y(), size.z(), tint, 0.4);
    const int sheets = tiled(Layer::Edges, 8, {1, 1, 1}, 0.1);
    box(bottom + Eigen::Vector3d(0, 0, size.z() / 2), size, yaw, {side, spine, sheets})
        .lightTexels = 16;
}

}  // namespace mfar::synthetic
