#include "pipeline/gles/view_look_up.h"

#include "base/gl/scoped_state.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <array>
#include <span>

namespace mfar {
namespace {

// Less of a surface's own texels than so much tells little of its colour there.
constexpr float kLeastWeight = 0.2F;
constexpr int kListGroup = 8;  // each way, as in the shaders

/// n . point = w, in the frame of the camera.
Eigen::Vector4d planeIn(const Eigen::Vector4d& world, const RigidTransform& T_world_camera) {
    const Eigen::Vector3d normal = T_world_camera.rotation.conjugate() * world.head<3>();
    return {normal.x(), normal.y(), normal.z(),
            world.w() - world.head<3>().dot(T_world_camera.translation)};
}

}  // namespace

ViewLookUp::ViewLookUp(const LensProjection& layer)
    : layer_(layer), rays_(rayTexture(layer.camera)),
      colour_(layer.camera.size, gpu::TexelFormat::Rgba8, gpu::Filter::Linear),
      depth_(layer.camera.size, gpu::TexelFormat::R32F),
      state_(layer.camera.size, gpu::TexelFormat::Rgba8),
      target_(std::array<const gpu::Texture*, 3>{&colour_, &depth_, &state_}),
      commands_(sizeof(HoleFiller::Command)),
      list_(sizeof(std::uint32_t) * layer.camera.size.width * layer.camera.size.height),
      plain_("warp_look_up.frag"), restList_("warp_rest_list.comp"), rest_("warp_rest.comp") {
    clear({0, 0, layer.camera.size.width, layer.camera.size.height});
}

void ViewLookUp::clear(const PixelRect& where) const {
    if (where.empty()) return;
    constexpr std::array<float, 4> kNothing{};
    target_.bind();
    const gpu::Scissor scissor(where);
    for (GLint i = 0; i < 3; ++i)
        glClearBufferfv(GL_COLOR, i, kNothing.data());
}

ViewLookUp::Params ViewLookUp::params(const Input& input,
                                      const RigidTransform& T_world_camera) const {
    const Size from = input.reference.picture().size(), to = colour_.size();
    Params p{};
    storeRows(p.toView[0], input.T_world_reference.inverse() * T_world_camera);
    for (const PatchPictures::Patch& patch : input.patches.patches()) {
        storeRows(p.toView[1 + patch.slot], patch.T_world_camera.inverse() * T_world_camera);
        p.share[patch.slot] = static_cast<float>(patch.share);
        if (patch.share > 0) p.counts[0] = std::max(p.counts[0], patch.slot + 1);
    }
    storeLens(p.pinhole[0], p.distortion[0], p.lens[0], input.reference.lens());
    storeLens(p.pinhole[1], p.distortion[1], p.lens[1], layer_);
    const Eigen::Vector4f plane = planeIn(input.plane, T_world_camera).cast<float>();
    std::copy_n(plane.data(), 4, p.plane);
    p.slack[0] = 1;
    p.slack[1] = kLeastWeight;
    p.sizes[0] = from.width;
    p.sizes[1] = from.height;
    p.sizes[2] = to.width;
    p.sizes[3] = to.height;
    return p;
}

void ViewLookUp::run(const Input& input, const RigidTransform& T_world_camera,
                     const PixelRect& where, const HoleFiller& holes) {
    if (where.empty()) return;
    Params p = params(input, T_world_camera);
    const std::array<std::int32_t, 4> bounds{where.x0, where.y0, where.x1, where.y1};
    std::copy_n(bounds.data(), 4, p.bounds);
    p.counts[1] = holes.levels();
    p.wanted = holes.wanted();
    {
        const gpu::Scissor scissor(where);
        const gpu::Texture &colour = input.reference.colour(), &packed = input.reference.packed();
        plain_.run(p,
                   {gpu::sampler(0, input.silhouette), gpu::sampler(1, rays_),
                    gpu::sampler(2, colour), gpu::sampler(3, packed)},
                   target_);
    }
    runRest(p, input, where, holes);
}

void ViewLookUp::runRest(const Params& params, const Input& input, const PixelRect& where,
                         const HoleFiller& holes) {
    constexpr HoleFiller::Command kNone{0, 1, 1, 0};
    commands_.write(std::span(&kNone, 1));
    restList_.run(params,
                  {gpu::sampler(0, state_), gpu::storage(0, commands_), gpu::storage(1, list_)},
                  {gpu::groupsFor((where.x1 - where.x0 + 1) / 2, kListGroup),
                   gpu::groupsFor((where.y1 - where.y0 + 1) / 2, kListGroup), 1});
    rest_.runIndirect(params,
                      {gpu::sampler(0, input.silhouette), gpu::sampler(1, rays_),
                       gpu::sampler(2, input.reference.colour()),
                       gpu::sampler(3, input.reference.surface()),
                       gpu::sampler(4, input.patchTextures.colour()),
                       gpu::sampler(5, input.patchTextures.surface()), gpu::imageWrite(0, colour_),
                       gpu::imageWrite(1, depth_), gpu::imageWrite(2, state_),
                       gpu::storage(0, commands_), gpu::storage(1, list_),
                       gpu::storage(2, holes.commands()), gpu::storage(3, holes.entries())},
                      commands_, 0);
}

}  // namespace mfar
