#include "pipeline/gles/view_look_up.h"

#include "base/gl/scoped_state.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <array>
#include <span>

namespace mfar {
namespace {

constexpr int kListGroup = 8;  // width and height of a workgroup in warp_rest_list.comp

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

params::LookUpViews ViewLookUp::paramsOf(const Input& input,
                                         const RigidTransform& T_world_camera) const {
    const Size from = input.traced.picture().size(), to = colour_.size();
    Params p{};
    p.views[0].toView = transformOf(input.T_world_traced.inverse() * T_world_camera);
    for (const RerenderedPictures::Picture& rerendered : input.rerendered.pictures()) {
        p.views[1 + rerendered.slot] = {
            transformOf(rerendered.T_world_camera.inverse() * T_world_camera),
            static_cast<float>(rerendered.share)};
        if (rerendered.share > 0) p.rerendered = std::max(p.rerendered, rerendered.slot + 1);
    }
    p.projections[0] = projectionOf(input.traced.lens());
    p.projections[1] = projectionOf(layer_);
    const Eigen::Vector4f plane = planeIn(input.plane, T_world_camera).cast<float>();
    p.plane = {plane.x(), plane.y(), plane.z(), plane.w()};
    p.tracedWidth = from.width;
    p.tracedHeight = from.height;
    p.width = to.width;
    p.height = to.height;
    return p;
}

void ViewLookUp::run(const Input& input, const RigidTransform& T_world_camera,
                     const PixelRect& where, const HoleFiller& holes) {
    if (where.empty()) return;
    Params p = paramsOf(input, T_world_camera);
    p.bounds = boundsOf(where);
    p.levels = holes.levels();
    std::ranges::copy(holes.wanted(), p.wanted);
    {
        const gpu::Scissor scissor(where);
        const gpu::Texture &colour = input.traced.colour(), &packed = input.traced.packed();
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
    rest_.runIndirect(
        params,
        {gpu::sampler(0, input.silhouette), gpu::sampler(1, rays_),
         gpu::sampler(2, input.traced.colour()), gpu::sampler(3, input.traced.surface()),
         gpu::sampler(4, input.rerenderedTextures.colour()),
         gpu::sampler(5, input.rerenderedTextures.surface()), gpu::imageWrite(0, colour_),
         gpu::imageWrite(1, depth_), gpu::imageWrite(2, state_), gpu::storage(0, commands_),
         gpu::storage(1, list_), gpu::storage(2, holes.commands()),
         gpu::storage(3, holes.entries())},
        commands_, 0);
}

}  // namespace mfar
