#include "pipeline/simd/moving_mirrors.h"

#include "pipeline/warp/mirror_looks.h"

#include <algorithm>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kMirrorRows = 8;
constexpr std::size_t kSpare = 8;  // padding of a picture's arrays, which vectors read [entries]

template <class T>
void copyPadded(const std::vector<T>& from, std::vector<T>& to) {
    to.resize(from.size() + kSpare);
    std::ranges::copy(from, to.begin());
}

}  // namespace

MovingMirrors::MovingMirrors(const CameraModel& layer, Rows<const float> rayX,
                             Rows<const float> rayY, std::shared_ptr<Workers> workers)
    : layer_(layer), rayX_(rayX), rayY_(rayY), workers_(std::move(workers)) {}

void MovingMirrors::setTracedPicture(const TracedPicture& traced) {
    traced_ = &traced;
    moves_ =
        !traced.light.empty() && !traced.gloss.empty() && traced.mirrors && traced.camera == layer_;
    if (!moves_) return;
    if (mirrors_ != traced.mirrors) {
        mirrors_ = traced.mirrors;
        prepareTables();
    }
    copyPadded(traced.packed, packed_);
    copyPadded(traced.gloss, gloss_);
    copyPadded(traced.light, light_);
    parts_.assign(light_.size(), {});
    eye_ = traced.T_world_camera.translation;
    const MirrorInput input = inputFor(eye_);
    forRows([&](int y) { splitMirrored(rowAt(y), input, firstOf(light_, y), firstOf(parts_, y)); });
}

std::span<const LightWords> MovingMirrors::lightFor(const Eigen::Vector3d& eye) {
    if (!moves_) return traced_->light;
    if (eye != eye_) {
        eye_ = eye;
        const MirrorInput input = inputFor(eye);
        forRows(
            [&](int y) { joinMirrored(rowAt(y), input, firstOf(parts_, y), firstOf(light_, y)); });
    }
    return std::span(light_).first(traced_->light.size());
}

void MovingMirrors::prepareTables() {
    const std::vector<MirrorLight::Table>& tables = mirrors_->tables;
    tables_.clear();
    for (const MirrorLight::Table& table : tables) {
        tables_.push_back(static_cast<std::int32_t>(table.first));
        tables_.push_back(table.edge);
    }
    tableOf_.clear();
    shareOf_.clear();
    alphaOf_.clear();
    for (const MirrorLook& look : mirrorLooks(*mirrors_)) {
        tableOf_.push_back(static_cast<std::int32_t>(look.table));
        shareOf_.push_back(look.share);
        alphaOf_.push_back(look.alpha);
    }
}

MirrorInput MovingMirrors::inputFor(const Eigen::Vector3d& eye) const {
    MirrorInput out{mirrors_->texels.data(),
                    tables_.data(),
                    tableOf_.data(),
                    shareOf_.data(),
                    alphaOf_.data(),
                    {},
                    {},
                    mirrors_->least,
                    traced_->exposure,
                    {},
                    {}};
    const RigidTransform& T = traced_->T_world_camera;
    const Eigen::Matrix3d axes = T.rotation.normalized().toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
        out.sun[i] = mirrors_->towardsSun[static_cast<std::size_t>(i)];
        out.irradiance[i] = mirrors_->sunIrradiance[static_cast<std::size_t>(i)];
        out.eye[i] = static_cast<float>(eye[i] - T.translation[i]);
        for (int axis = 0; axis < 3; ++axis)
            out.axes[axis][i] = static_cast<float>(axes(i, axis));
    }
    return out;
}

MirrorRow MovingMirrors::rowAt(int y) const {
    const PixelRect& where = traced_->bounds;
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * layer_.size.width + where.x0;
    return {where.x1 - where.x0, packed_.data() + first, gloss_.data() + first, rayX_[y] + where.x0,
            rayY_[y] + where.x0};
}

template <class Body>
void MovingMirrors::forRows(const Body& body) const {
    mfar::forRows(workers_.get(), traced_->bounds.y0, traced_->bounds.y1, kMirrorRows, body);
}

}  // namespace mfar::simd
