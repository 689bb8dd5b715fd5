#include "pipeline/gles/view_look_up.h"

#include "base/gl/scoped_state.h"
#include "pipeline/warp/object_views.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <vector>

namespace mfar {
namespace {

constexpr int kViews = RerenderedPictures::kPictures + 1;
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
      state_(layer.camera.size, gpu::TexelFormat::Rgba8), light_(layer.camera),
      target_(std::array<const gpu::Texture*, 3>{&colour_, &depth_, &state_}),
      commands_(sizeof(HoleFiller::Command)),
      list_(sizeof(std::uint32_t) * layer.camera.size.width * layer.camera.size.height),
      still_{gpu::DrawPass<Params>("warp_look_up.frag"),
             gpu::ComputePass<Params>("warp_rest.comp")},
      restList_("warp_rest_list.comp") {
    clear({0, 0, layer.camera.size.width, layer.camera.size.height});
}

void ViewLookUp::prepareMotion() {
    constexpr const char* kMoving = "#define MOVING\n";
    if (motion_) return;
    motion_.emplace(
        Motion{{gpu::DrawPass<Params>("warp_look_up.frag", kMoving),
                gpu::ComputePass<Params>("warp_rest.comp", kMoving)},
               gpu::Texture({3, kViews * params::kSurfaceNumbers}, gpu::TexelFormat::Rgba32F)});
}

bool ViewLookUp::showsMotion(const Input& input) const {
    return motion_ && input.picture.poses.size() == input.silhouette.models().objects().size() &&
           !input.picture.poses.empty();
}

void ViewLookUp::upload(const Input& input, const RigidTransform& T_world_camera) {
    std::vector<float> texels(std::size_t{12} * kViews * params::kSurfaceNumbers);
    const auto add = [&](int view, const RigidTransform& T_world_view,
                         const std::vector<RigidTransform>& poses) {
        const std::vector<RigidTransform> views = viewsOfObjects(
            T_world_view, poses, input.silhouette.models().objects(), T_world_camera);
        for (int id = 0; id < params::kSurfaceNumbers; ++id) {
            const auto at = static_cast<std::size_t>(id);
            const params::Transform T =
                transformOf(views.empty() ? T_world_view.inverse() * T_world_camera
                                          : views[at < views.size() ? at : 0]);
            std::memcpy(
                &texels[12 * (static_cast<std::size_t>(view) * params::kSurfaceNumbers + at)], &T,
                sizeof T);
        }
    };
    add(0, input.picture.T_world_camera, input.picture.poses);
    for (const RerenderedPictures::Picture& rerendered : input.rerendered.pictures())
        if (rerendered.share > 0)
            add(1 + rerendered.slot, rerendered.T_world_camera, rerendered.poses);
    motion_->views.upload(texels);
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
    p.views[0].toView = transformOf(input.picture.T_world_camera.inverse() * T_world_camera);
    for (const RerenderedPictures::Picture& rerendered : input.rerendered.pictures()) {
        p.views[1 + rerendered.slot] = {
            transformOf(rerendered.T_world_camera.inverse() * T_world_camera),
            static_cast<float>(rerendered.share)};
        if (rerendered.share > 0) p.rerendered = std::max(p.rerendered, rerendered.slot + 1);
    }
    p.projections[0] = projectionOf(input.traced.lens());
    p.projections[1] = projectionOf(layer_);
    const Eigen::Vector4f plane =
        planeIn(input.silhouette.models().plane(), T_world_camera).cast<float>();
    p.plane = {plane.x(), plane.y(), plane.z(), plane.w()};
    p.tracedWidth = from.width;
    p.tracedHeight = from.height;
    p.width = to.width;
    p.height = to.height;
    p.texels = 4;
    p.tracedIsLit = light_.isLit() ? 1 : 0;
    p.rerenderedIsLit = input.rerenderedTextures.isLit() ? 1 : 0;
    return p;
}

void ViewLookUp::run(const Input& input, const RigidTransform& T_world_camera,
                     const PixelRect& where, const HoleFiller& holes) {
    if (where.empty()) return;
    Params p = paramsOf(input, T_world_camera);
    p.bounds = boundsOf(where);
    p.levels = holes.levels();
    std::ranges::copy(holes.wanted(), p.wanted);
    const bool moving = showsMotion(input);
    if (moving) upload(input, T_world_camera);
    light_.run(T_world_camera.translation, rays_);
    {
        const gpu::Scissor scissor(where);
        const gpu::Binding silhouette = gpu::sampler(0, input.silhouette.surface()),
                           rays = gpu::sampler(1, rays_),
                           colour = gpu::sampler(2, input.traced.colour()),
                           packed = gpu::sampler(3, input.traced.packed()),
                           diffusePaint = gpu::sampler(7, input.silhouette.diffuse()),
                           facingPaint = gpu::sampler(8, input.silhouette.facing()),
                           diffuse = gpu::sampler(9, light_.diffuse()),
                           specular = gpu::sampler(10, light_.specular());
        if (moving)
            motion_->passes.plain.run(p,
                                      {silhouette, rays, colour, packed,
                                       gpu::sampler(6, motion_->views), diffusePaint, facingPaint,
                                       diffuse, specular},
                                      target_);
        else
            still_.plain.run(
                p, {silhouette, rays, colour, packed, diffusePaint, facingPaint, diffuse, specular},
                target_);
    }
    runRest(p, input, where, holes);
}

void ViewLookUp::runRest(const Params& params, const Input& input, const PixelRect& where,
                         const HoleFiller& holes) {
    commands_.write(std::span(&HoleFiller::kEmptyList, 1));
    restList_.run(params,
                  {gpu::sampler(0, state_), gpu::storage(0, commands_), gpu::storage(1, list_)},
                  {gpu::groupsFor((where.x1 - where.x0 + 1) / 2, kListGroup),
                   gpu::groupsFor((where.y1 - where.y0 + 1) / 2, kListGroup), 1});
    const gpu::Binding silhouette = gpu::sampler(0, input.silhouette.surface()),
                       rays = gpu::sampler(1, rays_),
                       colours = gpu::sampler(2, input.traced.colour()),
                       surfaces = gpu::sampler(3, input.traced.surface()),
                       moreColours = gpu::sampler(4, input.rerenderedTextures.colour()),
                       moreSurfaces = gpu::sampler(5, input.rerenderedTextures.surface()),
                       diffusePaint = gpu::sampler(7, input.silhouette.diffuse()),
                       facingPaint = gpu::sampler(8, input.silhouette.facing()),
                       diffuse = gpu::sampler(9, light_.diffuse()),
                       specular = gpu::sampler(10, light_.specular()),
                       moreLights = gpu::sampler(11, input.rerenderedTextures.light()),
                       colour = gpu::imageWrite(0, colour_), depth = gpu::imageWrite(1, depth_),
                       state = gpu::imageWrite(2, state_), commands = gpu::storage(0, commands_),
                       list = gpu::storage(1, list_),
                       holeCommands = gpu::storage(2, holes.commands()),
                       entries = gpu::storage(3, holes.entries());
    if (showsMotion(input))
        motion_->passes.rest.runIndirect(
            params,
            {silhouette, rays, colours, surfaces, moreColours, moreSurfaces,
             gpu::sampler(6, motion_->views), diffusePaint, facingPaint, diffuse, specular,
             moreLights, colour, depth, state, commands, list, holeCommands, entries},
            commands_, 0);
    else
        still_.rest.runIndirect(params,
                                {silhouette, rays, colours, surfaces, moreColours, moreSurfaces,
                                 diffusePaint, facingPaint, diffuse, specular, moreLights, colour,
                                 depth, state, commands, list, holeCommands, entries},
                                commands_, 0);
}

}  // namespace mfar
