#include "pipeline/depth/depth_filter.h"
#include "pipeline/depth/depth_stage.h"
#include "pipeline/depth/edge_snap.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace mfar::stress {
namespace {

std::shared_ptr<Workers> depthWorkers() {
    static const auto shared = std::make_shared<Workers>(2);
    return shared;
}

InverseDepthField fieldOf(Context& c, Size size, double unit, double spoilt) {
    InverseDepthField out(size);
    const double inverseDepth = c.hostile.logarithmic(0.1, 10) / unit;
    for (std::size_t i = 0; i < out.inverseDepth.size(); ++i) {
        if (c.hostile.chance(0.2)) continue;
        out.inverseDepth[i] = static_cast<float>(inverseDepth * c.hostile.real(0.9, 1.1));
        out.variance[i] =
            static_cast<float>(std::pow(inverseDepth * c.hostile.logarithmic(1e-4, 0.3), 2));
        if (c.hostile.chance(spoilt)) out.inverseDepth[i] = static_cast<float>(c.hostile.bad());
        if (c.hostile.chance(spoilt)) out.variance[i] = static_cast<float>(c.hostile.bad());
    }
    return out;
}

/// All inverse depths must be finite, and no value may be negative or NaN. The variance of unknown
/// depth is infinite.
void checkField(Context& c, const InverseDepthField& field) {
    for (std::size_t i = 0; i < field.inverseDepth.size(); ++i) {
        c.checks.within(field.inverseDepth[i], 0, 3.4e38, "filtered inverse depth");
        c.checks.require(field.variance[i] >= 0, "filtered variance is negative or NaN");
        c.checks.require(field.filled[i] <= 1, "mark of a filled pixel is neither 0 nor 1");
    }
}

void hostileFilter(Context& c) {
    const CameraModel camera = c.hostile.camera(c.size(1, 100));
    DepthFilter filter(camera, depthWorkers());
    const double unit = c.hostile.logarithmic(1e-6, 1e3);
    const double spoilt = c.hostile.pick({0.0, 0.02, 0.5});
    for (int frame = 0; frame < 6; ++frame) {
        RigidTransform T = c.hostile.chance(0.7) ? c.hostile.gentle(unit) : c.hostile.motion(unit);
        if (c.hostile.chance(0.1)) T = c.hostile.spoilt(T);
        filter.predict(T, c.hostile.chance(0.1) ? c.hostile.bad() : 0.033);
        checkField(c, filter.field());
        filter.fuse(fieldOf(c, camera.size, unit, spoilt),
                    {0, 0, camera.size.width, camera.size.height});
        checkField(c, filter.field());
        c.checks.through("DepthFilter", pixelsOf(camera.size));
    }
}

// Depth that the filter moves with the camera must equal the plane's depth from the camera's new
// position, in any unit of length.
void carriedDepth(Context& c) {
    const Size size{c.hostile.integer(20, 90), c.hostile.integer(20, 70)};
    CameraModel camera = c.hostile.camera(size);
    camera.distortion = {};
    const double unit = c.hostile.pick({1e-3, 1.0, 1e3});
    DepthFilter filter(camera, depthWorkers());
    InverseDepthField plane(size);
    const double inverseDepth = 0.5 / unit;
    std::ranges::fill(plane.inverseDepth, static_cast<float>(inverseDepth));
    std::ranges::fill(plane.variance, static_cast<float>(std::pow(0.01 * inverseDepth, 2)));
    filter.predict({}, 0.03);
    filter.fuse(plane, {0, 0, size.width, size.height});
    RigidTransform ahead;
    // The filter adds up small motions before it moves its depths. This motion is long enough to
    // move them at once.
    const double way = c.hostile.real(0.15, 0.4) * c.hostile.pick({-1, 1});
    ahead.translation = unit * Eigen::Vector3d(way, 0, way);
    filter.predict(ahead, 0.03);
    const double wanted = 1 / (2 * unit - ahead.translation.z());
    const InverseDepthField& field = filter.field();
    long known = 0;
    for (std::size_t i = 0; i < field.inverseDepth.size(); ++i) {
        if (!field.isKnown(i)) continue;
        ++known;
        c.checks.within(field.inverseDepth[i] / wanted, 1 - 2e-5, 1 + 2e-5,
                        "inverse depth carried to the next frame");
        c.checks.within(std::sqrt(field.variance[i]) / wanted, 0.005, 0.02,
                        "relative sigma of carried depth");
    }
    c.checks.within(static_cast<double>(known) / static_cast<double>(pixelsOf(size)), 0.3, 1,
                    "share of the pixels with carried depth");
    c.checks.through("DepthFilter", pixelsOf(size));
}

void hostileStage(Context& c) {
    const CameraModel camera = c.hostile.camera(c.size(1, 120));
    const Size size = camera.size;
    DepthStage stage(camera, depthWorkers());
    const double unit = c.hostile.pick({1e-6, 1e-3, 1.0, 1.0, 1e3});
    Pose pose{{}, c.hostile.motion(unit)};
    for (int frame = 0; frame < 5; ++frame) {
        pose.time = pose.time + std::chrono::milliseconds(c.hostile.pick({33, 0, -33, 1000000}));
        pose.T_world_video = c.hostile.chance(0.8) ? pose.T_world_video * c.hostile.gentle(unit)
                                                   : c.hostile.motion(unit);
        Pose told = pose;
        if (c.hostile.chance(0.15)) told.T_world_video = c.hostile.spoilt(told.T_world_video);
        told.covariance = c.hostile.covariance();
        const int x = c.hostile.integer(0, size.width - 1),
                  y = c.hostile.integer(0, size.height - 1);
        const PixelRect where{x, y, c.hostile.integer(x, size.width),
                              c.hostile.integer(y, size.height)};
        stage.run(c.hostile.luma(size), told, {}, where);
        checkField(c, stage.field());
        c.checks.through("DepthStage", pixelsOf(size));
    }
}

void hostileEdges(Context& c) {
    const Size half = c.size(1, 50);
    const Size size{2 * half.width, 2 * half.height};
    EdgeSnap snap(size, depthWorkers());
    for (int i = 0; i < 2; ++i) {
        const InverseDepthField in = fieldOf(c, size, c.hostile.logarithmic(1e-6, 1e3), 0.02);
        const int x = c.hostile.integer(0, size.width - 1),
                  y = c.hostile.integer(0, size.height - 1);
        const PixelRect where{x, y, c.hostile.integer(x, size.width),
                              c.hostile.integer(y, size.height)};
        const InverseDepthField& out = snap.run(in, c.hostile.picture(size).view(), where);
        for (std::size_t p = 0; p < out.inverseDepth.size(); ++p)
            if (out.isKnown(p)) {
                c.checks.within(out.inverseDepth[p], 0, 3.4e38,
                                "inverse depth after edges were moved");
                c.checks.within(out.variance[p], 0, 3.4e38, "variance after edges were moved");
            }
        c.checks.through("EdgeSnap", pixelsOf(size));
    }
}

}  // namespace

std::vector<Case> depthCases() {
    return {{"depth-filter", hostileFilter, true},
            {"depth-carried", carriedDepth},
            {"depth-stage", hostileStage, true},
            {"edges", hostileEdges, true}};
}

}  // namespace mfar::stress
