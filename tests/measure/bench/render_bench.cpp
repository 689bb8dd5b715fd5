#include "tests/measure/bench/render_bench.h"

#include "pipeline/render/lens_rays.h"
#include "pipeline/render/path_tracer.h"
#include "pipeline/render/ray_scene.h"
#include "tests/measure/eval/stopwatch.h"
#include "tests/render/render_scenes.h"

#if MFAR_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace mfar::bench {
namespace {

using namespace render_scenes;

constexpr std::uint32_t kErrorSamples = 16;

class BareEmbree {
public:
    explicit BareEmbree(const Mesh& mesh)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), mesh.positions.size()));
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), mesh.triangles.size()));
        for (const Eigen::Vector3f& p : mesh.positions)
            vertices = std::copy_n(p.data(), 3, vertices);
        for (const auto& t : mesh.triangles)
            indices = std::copy_n(t.data(), 3, indices);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~BareEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    int hits(const std::vector<Ray>& rays) const {
        int found = 0;
        for (const Ray& ray : rays) {
            RTCRayHit query{};
            std::copy_n(ray.origin.data(), 3, &query.ray.org_x);
            std::copy_n(ray.direction.data(), 3, &query.ray.dir_x);
            query.ray.tfar = std::numeric_limits<float>::infinity();
            query.ray.mask = 0xFFFFFFFFU;
            query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if MFAR_EMBREE_MAJOR >= 4
            rtcIntersect1(scene_, &query);
#else
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            rtcIntersect1(scene_, &context, &query);
#endif
            found += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
        return found;
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

std::vector<Ray> cameraRays(const RenderView& view, const LensRays& lens) {
    const Eigen::Matrix3f R_world_camera =
        view.T_world_camera.rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f eye = view.T_world_camera.translation.cast<float>();
    std::vector<Ray> out;
    for (int y = 0; y < view.camera.size.height; ++y)
        for (int x = 0; x < view.camera.size.width; ++x)
            out.push_back(
                {eye, R_world_camera *
                          lens.at(static_cast<float>(x), static_cast<float>(y)).homogeneous()});
    return out;
}

std::shared_ptr<Scene> sunlit(const Mesh& mesh) {
    auto out = std::make_shared<Scene>();
    Material paint;
    paint.baseColour = {0.7F, 0.6F, 0.5F, 1};
    paint.metallic = 0;
    paint.roughness = 0.6F;
    out->objects.push_back(objectOf(modelOf(mesh, paint)));
    out->lighting.sun = Sun{Eigen::Vector3f(0.5F, -0.2F, 1).normalized(), {3, 3, 3}, 0.1F};
    return out;
}

RayRates ratesOn(int rings, bool quick) {
    const Mesh mesh = sphere({0, 0, 0}, 1, rings);
    const Size size = quick ? Size{160, 120} : Size{640, 480};
    const RenderView view = lookingAt({0, -4, 0}, {0, 0, 0}, size, 1.4 * size.width);
    const LensRays lens(view.camera);
    const BareEmbree bare(mesh);
    RayScene scene;
    scene.add(mesh.positions, mesh.triangles);
    scene.commit();
    PathTracerOptions directly;
    directly.maxDepth = 1;
    const PathTracer tracer(sunlit(mesh), directly);
    const std::vector<Ray> rays = cameraRays(view, lens);
    std::vector<RayHit> hits(rays.size());
    double bareMs = 1e9, ourMs = 1e9, sampleMs = 1e9;
    int found = 0;
    for (int run = 0; run < (quick ? 2 : 9); ++run) {
        bareMs = std::min(bareMs, eval::wallMs([&] { found += bare.hits(rays); }));
        ourMs = std::min(ourMs, eval::wallMs([&] {
                             const std::vector<Ray> made = cameraRays(view, lens);
                             scene.firstOfEach(made, hits);
                         }));
        sampleMs =
            std::min(sampleMs, eval::wallMs([&] { static_cast<void>(traced(tracer, view, 2)); }));
    }
    const double thousands = static_cast<double>(rays.size()) / 1000;
    return {static_cast<int>(mesh.triangles.size()), found > 0 ? thousands / bareMs : 0,
            thousands / ourMs, 2 * thousands / sampleMs};
}

Eigen::Vector3f seen(const Film::Means& m) {
    return m.objectShare * m.object;
}

double rmse(const Film& film, const Film& truth) {
    double squares = 0;
    const std::vector<std::uint32_t> pixels = allPixels(film.size());
    for (const std::uint32_t p : pixels)
        squares += (seen(film.means(p)) - seen(truth.means(p))).squaredNorm() / 3;
    return std::sqrt(squares / static_cast<double>(pixels.size()));
}

SamplingError errorOf(const char* name, const std::shared_ptr<const Scene>& scene, int depth,
                      const RenderView& view, bool quick) {
    PathTracerOptions ours, chance, other;
    ours.maxDepth = chance.maxDepth = other.maxDepth = depth;
    chance.independentSamples = true;
    other.seed = 1;
    const Film truth = traced(PathTracer(scene, other), view, quick ? 64 : 512);
    return {name, rmse(traced(PathTracer(scene, ours), view, kErrorSamples), truth),
            rmse(traced(PathTracer(scene, chance), view, kErrorSamples), truth)};
}

std::vector<SamplingError> errors(bool quick) {
    const Size size = quick ? Size{16, 12} : Size{160, 120};
    const double focal = 0.95 * size.width;
    const RenderView wide = lookingAt({0.5, -3, 2}, {0, 0, 0.4}, size, focal);
    const RenderView close = lookingAt({0.5, -3, 2}, {0, -0.2, 0.8}, size, 25 * focal);
    auto scene = sunlit(sphere({0, 0, 0.5F}, 0.5F, 48));
    scene->objects.push_back(sunlit(square(4, 0))->objects.front());
    auto outside = std::make_shared<Scene>(*scene);
    outside->lighting.environment = unevenLight();
    return {errorOf("sun, surfaces only", scene, 1, close, quick),
            errorOf("sun, whole picture", scene, 1, wide, quick),
            errorOf("sun, indirect light", scene, 5, wide, quick),
            errorOf("sun, indirect light, surfaces only", scene, 5, close, quick),
            errorOf("sun and environment", outside, 1, wide, quick),
            errorOf("sun and environment, indirect light", outside, 5, wide, quick)};
}

}  // namespace

RenderFigures measureRender(bool quick) {
    RenderFigures out;
    for (const int rings : quick ? std::vector{16} : std::vector{16, 64, 250})
        out.rates.push_back(ratesOn(rings, quick));
    out.errors = errors(quick);
    return out;
}

}  // namespace mfar::bench
