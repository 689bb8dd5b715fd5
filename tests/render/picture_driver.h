#pragma once

#include "pipeline/slices/traced_pictures.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace mfar::traced_pictures {

inline constexpr Size kTracedSize{48, 36};

[[nodiscard]] inline std::shared_ptr<const PictureScene>
prepared(const std::shared_ptr<const Scene>& scene, std::uint64_t objects, std::uint64_t light) {
    auto out = std::make_shared<PictureScene>();
    out->tracer = std::make_shared<PathTracer>(scene);
    out->source = scene;
    out->balls = objectBalls(*scene);
    out->shaded = catcherBall(*scene);
    out->objects = objects;
    out->light = light;
    return out;
}

[[nodiscard]] inline std::shared_ptr<const PictureScene> preparedStillLife(std::uint64_t objects,
                                                                           std::uint64_t light) {
    return prepared(render_scenes::stillLife(), objects, light);
}

/// Policies for tests. kPlain has no noise filter and no history, so it samples every pixel.
/// kProduct has filter and history, as in the daemon.
inline constexpr TracedPolicy kPlain{{4, 0.2}, 8, false, false};
inline constexpr TracedPolicy kProduct{{4, 0.2}, 8, true, true};

/// Runs the steps of a renderer's threads one by one and keeps each shown picture.
class Driver {
public:
    explicit Driver(const SliceOptions& slices, const TracedPolicy& policy = kPlain)
        : pictures(slices, policy) {
        pictures.setScene(preparedStillLife(1, 1));
    }

    void look(double azimuth, Timestamp time = {}) {
        const RenderView view = render_scenes::viewFrom(size, azimuth);
        pictures.look(view, view, time);
    }
    bool step() {
        if (pictures.toBegin()) {
            pictures.begin();
            return true;
        }
        if (pictures.toShow()) {
            RenderedPicture& out = shown.emplace_back();
            pictures.beginShow({}, out);
            while (!pictures.resolver().complete()) {
                const PictureResolver::Portion rows = pictures.resolver().next(100);
                pictures.resolver().run(rows);
                pictures.resolver().done(rows);
            }
            pictures.endShow(out, showMs);
            return true;
        }
        const TracedPictures::Portion portion = pictures.next(1000);
        if (portion.slice.pixels.empty()) return false;
        pictures.trace(portion);
        pictures.done(portion, {}, portionMs);
        tracedMs += portionMs;
        return true;
    }
    void settle() {
        while (step()) {
        }
    }
    void untilShown(std::size_t pictures) {
        while (shown.size() < pictures)
            ASSERT_TRUE(step());
    }
    [[nodiscard]] bool shows(double azimuth) const {
        const RigidTransform there = render_scenes::viewFrom(kTracedSize, azimuth).T_world_camera;
        return !shown.empty() && shown.back().T_world_camera.translation == there.translation;
    }

    Size size = kTracedSize;
    // Pretended processor times [ms]. With 0, a picture is shown as soon as it is good enough.
    double portionMs = 0, showMs = 0;
    double tracedMs = 0;  ///< sum over all portions so far
    TracedPictures pictures;
    std::vector<RenderedPicture> shown;
};

inline constexpr SliceOptions kThirtyTwo{Slicing::Time, 32, 1, 0, 2};

}  // namespace mfar::traced_pictures
