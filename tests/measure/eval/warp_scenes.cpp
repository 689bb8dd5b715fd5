#include "tests/measure/eval/warp_scenes.h"

#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/models/environment_map.h"
#include "pipeline/models/gltf_model.h"
#include "pipeline/models/showpiece.h"
#include "pipeline/render/picture_resolver.h"
#include "pipeline/scene/scene_bounds.h"
#include "pipeline/scene/scene_parts.h"
#include "tests/measure/eval/report.h"
#include "tests/render/still_life.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <thread>

namespace mfar::eval {
namespace {

// Elevation [degrees] and focal length [picture widths] of the camera.
constexpr double kElevation = 35, kFocal = 1.2;
constexpr double kFill = 0.6;  // diameter of the objects' bounding sphere / picture's height

Scene sceneOf(Model model) {
    Scene scene;
    scene.objects = partsOf({std::make_shared<const Model>(std::move(model)), {}, 1});
    scene.catcher.positions = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
    scene.catcher.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.lighting.environment = std::make_shared<const Environment>(studioEnvironment());
    scene.lighting.sun = Sun{};
    return scene;
}

std::vector<std::uint32_t> pixelsIn(const PixelRect& r, int width) {
    std::vector<std::uint32_t> out;
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x)
            out.push_back(static_cast<std::uint32_t>(y * width + x));
    return out;
}

}  // namespace

PathTracerOptions tracerOptions(bool truth) {
    PathTracerOptions out;
    out.shadowReach = kShadowReach;
    out.fireflyClamp = 1;  // also for the truth, so that clamping does not count as an error
    if (truth) out.seed = 7;
    return out;
}

std::vector<std::string> warpSceneNames() {
    return {"still-life", "showpiece"};
}

std::vector<std::string> sceneLabels(const std::vector<std::string>& scenes) {
    std::vector<std::string> stems;
    for (const std::string& scene : scenes)
        stems.push_back(std::filesystem::path(scene).stem().string());
    std::vector<std::string> out;
    for (std::size_t i = 0; i < scenes.size(); ++i)
        out.push_back(std::ranges::count(stems, stems[i]) == 1 ? stems[i] : scenes[i]);
    return out;
}

std::string fileStemOf(std::string label) {
    std::ranges::replace(label, '/', '-');
    return label;
}

std::shared_ptr<const Scene> warpScene(const std::string& name) {
    if (name == "still-life") return render_scenes::stillLife();
    if (name == "showpiece") return std::make_shared<const Scene>(sceneOf(showpiece()));
    if (!std::filesystem::exists(name))
        throw EvalError(
            fmt::format("'{}' is neither a scene (still-life, showpiece) nor a glTF file", name));
    try {
        return std::make_shared<const Scene>(sceneOf(loadGltf(name)));
    } catch (const ModelError& e) {
        throw EvalError(e.what());
    }
}

RenderView warpView(const Scene& scene, Size size, double degrees) {
    const Eigen::AlignedBox3d box = boundsOf(scene);
    const double azimuth = degrees * std::numbers::pi / 180;
    const double elevation = kElevation * std::numbers::pi / 180;
    const Eigen::Vector3d back(std::cos(elevation) * std::sin(azimuth),
                               -std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
    const double focal = kFocal * size.width;
    const double distance = focal * box.diagonal().norm() / (kFill * size.height);
    const Eigen::Vector3d z = -back, x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Matrix3d R;
    R << x, z.cross(x), z;
    return {{size,
             focal,
             focal,
             0.5 * (size.width - 1),
             0.5 * (size.height - 1),
             {-0.1, 0.02, 0, 0, 0}},
            {Eigen::Quaterniond(R).normalized(), box.center() + distance * back}};
}

RenderedPicture tracePixels(const PathTracer& tracer, const RenderView& view,
                            std::span<const std::uint32_t> pixels, int samples) {
    Film film(view.camera.size);
    const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> workers;
        for (std::size_t i = 0; i < threads; ++i) {
            const std::size_t first = pixels.size() * i / threads;
            const auto part = pixels.subspan(first, pixels.size() * (i + 1) / threads - first);
            workers.emplace_back([&, part] { tracer.trace(view, part, samples, film); });
        }
    }
    RenderedPicture out;
    resolve(film, view, {}, out);
    out.mirrors = tracer.mirrorLight();
    return out;
}

RenderedPicture tracePicture(const PathTracer& tracer, const RenderView& view, int samples) {
    return tracePixels(tracer, view, pixelsIn(tracer.bounds(view), view.camera.size.width),
                       samples);
}

}  // namespace mfar::eval
