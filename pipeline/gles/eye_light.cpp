#include "pipeline/gles/eye_light.h"

#include "base/gl/scoped_state.h"
#include "pipeline/warp/mirror_looks.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace mfar {
namespace {

constexpr Size kNone{1, 1};

/// Converts a light word to the format Rgb9E5, whose mantissas have one bit more.
std::uint32_t sharedExponent(std::uint32_t word) {
    const std::uint32_t exponent = word >> 3 * kLightBits & kLightExponent;
    std::uint32_t out = exponent << 27;
    for (int c = 0; c < 3; ++c)
        out |= (word >> c * kLightBits & 0xFFU) << (9 * c + 1);
    return out;
}

params::Row4 rowOf(const Eigen::Vector3f& v) {
    return {v.x(), v.y(), v.z(), 0};
}
params::Row4 rowOf(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2], 0};
}

gpu::Texture lightTexture(Size size) {
    return {size, gpu::TexelFormat::Rgba16F, gpu::Filter::Linear};
}

}  // namespace

EyeLight::EyeLight(const CameraModel& layer)
    : layer_(layer), diffuse_(lightTexture(kNone)), specular_(lightTexture(kNone)),
      tables_(kNone, gpu::TexelFormat::Rgb9E5, gpu::Filter::Linear),
      looks_({2, static_cast<int>(kRoughnesses)}, gpu::TexelFormat::Rgba32F),
      pass_("warp_eye_light.frag") {}

void EyeLight::setTracedPicture(const TracedPicture& traced, const TracedTextures& textures) {
    traced_ = &traced;
    textures_ = &textures;
    eye_.reset();
    if (!isLit()) return;
    if (!(diffuse_.size() == traced.camera.size)) {
        diffuse_ = lightTexture(traced.camera.size);
        specular_ = lightTexture(traced.camera.size);
        target_ = gpu::Framebuffer(std::array<const gpu::Texture*, 2>{&diffuse_, &specular_});
        clear();
    }
    if (mirrorsMove() && mirrors_ != traced.mirrors) {
        mirrors_ = traced.mirrors;
        uploadTables();
    }
}

void EyeLight::clear() const {
    constexpr std::array<GLfloat, 4> kDark{};
    target_.bind();
    for (GLint i = 0; i < 2; ++i)
        glClearBufferfv(GL_COLOR, i, kDark.data());
}

bool EyeLight::mirrorsMove() const {
    return !traced_->gloss.empty() && traced_->mirrors && traced_->camera == layer_;
}

void EyeLight::uploadTables() {
    const std::vector<MirrorLight::Table>& tables = mirrors_->tables;
    Size size{1, 0};
    std::vector<int> firstRows;
    for (const MirrorLight::Table& table : tables) {
        firstRows.push_back(size.height);
        size = {std::max(size.width, table.edge), size.height + table.edge};
    }
    std::vector<std::uint32_t> texels(static_cast<std::size_t>(size.width) * size.height);
    for (std::size_t i = 0; i < tables.size(); ++i)
        for (int y = 0; y < tables[i].edge; ++y)
            for (int x = 0; x < tables[i].edge; ++x)
                texels[static_cast<std::size_t>(firstRows[i] + y) * size.width + x] =
                    sharedExponent(
                        mirrors_->texels[tables[i].first +
                                         static_cast<std::size_t>(y) * tables[i].edge + x]);
    tables_ = gpu::Texture(size, gpu::TexelFormat::Rgb9E5, gpu::Filter::Linear);
    tables_.upload(std::span<const std::uint32_t>(texels));
    std::vector<float> looks;
    for (const MirrorLook& look : mirrorLooks(*mirrors_)) {
        const std::size_t second = std::min(look.table + 1, tables.size() - 1);
        const auto add = [&](std::size_t i, float third, float fourth) {
            looks.insert(looks.end(), {static_cast<float>(firstRows[i]),
                                       static_cast<float>(tables[i].edge), third, fourth});
        };
        add(look.table, look.share, look.alpha);
        add(second, 0, 0);
    }
    looks_.upload(std::span<const float>(looks));
}

EyeLight::Params EyeLight::paramsFor(const Eigen::Vector3d& eye) const {
    Params out{};
    if (!mirrorsMove()) return out;
    const RigidTransform& T = traced_->T_world_camera;
    const Eigen::Matrix3f rotation = T.rotation.normalized().toRotationMatrix().cast<float>();
    for (int i = 0; i < 3; ++i)
        out.axes[i] = rowOf(Eigen::Vector3f(rotation.row(i)));
    out.eye = rowOf(Eigen::Vector3f((eye - T.translation).cast<float>()));
    out.towardsSun = rowOf(mirrors_->towardsSun);
    out.irradiance = rowOf(mirrors_->sunIrradiance);
    out.least = mirrors_->least;
    out.exposure = traced_->exposure;
    out.mirrors = 1;
    return out;
}

void EyeLight::run(const Eigen::Vector3d& eye, const gpu::Texture& rays) {
    if (!isLit() || (eye_ && (*eye_ == eye || !mirrorsMove()))) return;
    eye_ = eye;
    const gpu::Scissor scissor(traced_->bounds);
    pass_.run(paramsFor(eye),
              {gpu::sampler(0, textures_->light()), gpu::sampler(1, textures_->packed()),
               gpu::sampler(2, textures_->gloss()), gpu::sampler(3, rays), gpu::sampler(4, tables_),
               gpu::sampler(5, looks_)},
              target_);
}

}  // namespace mfar
