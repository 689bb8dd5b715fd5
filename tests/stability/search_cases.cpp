#include "pipeline/epipolar/epipolar_flow.h"
#include "pipeline/epipolar/field_filters.h"
#include "pipeline/epipolar/relative_pose.h"
#include "pipeline/epipolar/semi_global.h"
#include "pipeline/flow/cell_field.h"
#include "tests/flow/flow_scene.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace mfar::stress {
namespace {

std::shared_ptr<Workers> workers() {
    static const auto shared = std::make_shared<Workers>(2);
    return shared;
}

void checkSearch(Context& c, const EpipolarSearch& search) {
    const PixelRect area = search.area();
    const Size size{area.x1 - area.x0, area.y1 - area.y0};
    c.checks.through("EpipolarSearch", pixelsOf(size));
    c.checks.require(search.s().size() == static_cast<std::size_t>(pixelsOf(size)),
                     "the field of inverse depths has a wrong size");
    // The limit is relative to the length of the translation, which may be 1e18 in an invalid pose.
    c.checks.within(search.pixelsPerUnit(), 0, 1e9 * search.translation().cast<double>().norm(),
                    "pixels per unit of inverse depth");
    c.checks.within(search.normalError(), 0, 1e7, "expected distance from epipolar lines [px]");
    for (const float s : search.s())
        c.checks.within(s * search.pixelsPerUnit(), -2e4, 2e4,
                        "inverse depth times pixels per unit [px]");
}

std::vector<float> predictionFor(Context& c, Size area) {
    std::vector<float> out;
    if (c.hostile.chance(0.5)) return out;
    const double unit = c.hostile.logarithmic(1e-6, 1e6);
    for (long i = pixelsOf(cellsOf(area)); i > 0; --i)
        out.push_back(static_cast<float>(c.hostile.chance(0.05) ? c.hostile.bad()
                                                                : unit * c.hostile.real(-1, 1)));
    return out;
}

void hostileSearch(Context& c) {
    const CameraModel camera = c.hostile.camera(c.size(1, 150));
    const StereoRig rig{camera, c.hostile.camera(c.hostile.size(2, 200)), {}};
    EpipolarOptions options;
    options.longestParallax = c.hostile.pick({0.8, 0.1, 0.01});
    EpipolarSearch search(rig, workers(), options);
    search.setStill(c.hostile.picture(rig.still.size).view());
    for (int i = 0; i < 2; ++i) {
        if (c.hostile.chance(0.3)) {
            const int x = c.hostile.integer(0, camera.size.width - 1);
            const int y = c.hostile.integer(0, camera.size.height - 1);
            search.setArea({x, y, c.hostile.integer(x + 1, camera.size.width),
                            c.hostile.integer(y + 1, camera.size.height)});
        }
        const PixelRect area = search.area();
        RigidTransform T = c.hostile.motion(c.hostile.pick({1e-6, 1.0, 1e3}));
        if (c.hostile.chance(0.2)) T = c.hostile.spoilt(T);
        std::optional<Matrix6> covariance;
        if (c.hostile.chance(0.5)) covariance = c.hostile.covariance();
        (void)search.run(c.hostile.luma(camera.size), T, covariance,
                         predictionFor(c, {area.x1 - area.x0, area.y1 - area.y0}));
        checkSearch(c, search);
    }
}

double medianErrorOf(const test::View& view) {
    EpipolarSearch search({view.camera, view.camera, {}}, workers());
    search.setStill(test::viewOf(view.still()));
    if (!search.run(view.video(), view.T_still_video)) return 1e9;
    return test::errorsOf(search, view).median;
}

// The search must find a plane, in any unit of length and also with exchanged views.
void planeSearch(Context& c) {
    const Size size{c.hostile.integer(100, 160), c.hostile.integer(90, 130)};
    CameraModel camera = c.hostile.camera(size);
    camera.fx = camera.fy = 0.95 * size.width;
    test::View view{camera, {{{{0, 0, 1}, 2}}, 18, 100}, c.hostile.gentle()};
    view.T_still_video.translation *= 0.2 / view.T_still_video.translation.norm();
    c.checks.within(medianErrorOf(view), 0, 0.45, "median error of a plane [px]");
    const LumaImage video = view.video(), still = view.still();
    EpipolarSearch metres({camera, camera, {}}, workers()), other({camera, camera, {}}, workers());
    metres.setStill(viewOf(still));
    other.setStill(viewOf(still));
    RigidTransform scaled = view.T_still_video;
    const double unit = c.hostile.pick({0x1p-20, 0x1p-10, 0x1p10});
    scaled.translation *= unit;
    c.checks.require(
        metres.run(video, view.T_still_video) == other.run(video, scaled),
        "the search runs in the original world but not in a scaled one, or the reverse");
    checkSearch(c, metres);
    for (std::size_t i = 0; i < metres.s().size(); ++i)
        c.checks.within(metres.s()[i] - other.s()[i] * unit, -1e-5, 1e-5,
                        "inverse depth in a scaled world");
    EpipolarSearch back({camera, camera, {}}, workers());
    back.setStill(viewOf(video));
    if (!back.run(still, view.T_still_video.inverse()))
        c.checks.fail("the search with exchanged views does not run");
    checkSearch(c, back);
    const Eigen::Vector3d normal = view.T_still_video.rotation * Eigen::Vector3d::UnitZ();
    const double distance = 2 + normal.dot(view.T_still_video.translation);
    const test::View turned{camera, {{{normal, distance}}, 18, 100}, view.T_still_video.inverse()};
    const auto errors = test::errorsOf(back, turned);
    if (errors.pixels > 2000)
        c.checks.within(errors.median, 0, 0.45, "median error of exchanged views [px]");
}

void hostileFlowOfPoses(Context& c) {
    const StereoRig rig{c.hostile.camera(c.size(1, 120)), c.hostile.camera(c.hostile.size(1, 200)),
                        c.hostile.motion(0.05)};
    EpipolarOptions options;
    EpipolarFlow flow(rig, workers(), options);
    const auto pose = [&] {
        Pose out{{}, c.hostile.chance(0.7) ? c.hostile.gentle() : c.hostile.motion()};
        if (c.hostile.chance(0.2)) out.T_world_video = c.hostile.spoilt(out.T_world_video);
        out.covariance = c.hostile.covariance();
        return out;
    };
    flow.setStill(c.hostile.picture(rig.still.size).view(), pose());
    for (int frame = 0; frame < 3; ++frame) {
        const int left = c.hostile.integer(0, rig.video.size.width - 1);
        const int top = c.hostile.integer(0, rig.video.size.height - 1);
        const PixelRect where{left, top, c.hostile.integer(left + 1, rig.video.size.width),
                              c.hostile.integer(top + 1, rig.video.size.height)};
        const TestPicture video = c.hostile.picture(rig.video.size);
        if (c.hostile.chance(0.5))
            flow.run(video.view(), pose());
        else
            flow.run(video.view(), pose(), where);
        checkSearch(c, flow.search());
        c.checks.within(flow.unit(), 1e-300, 1e300,
                        "length of the search's unit, in units of the poses");
        for (const auto& v : flow.forward())
            for (const float x : v)
                c.checks.within(x, -2e4, 2e4, "flow of a cell");
        for (const auto& v : flow.occlusion())
            c.checks.within(v[0], 0, 1e4, "two-way error of a cell [px]");
        for (const float v : flow.flow())
            c.checks.within(v, -2e4, 2e4, "flow of a pixel");
        for (const float s : flow.sOf(flow.forward()))
            c.checks.require(std::isfinite(s), "inverse depth of a cell is not finite");
        c.checks.require(std::isfinite(flow.offLine(0, 0, 1, 1)),
                         "distance from the epipolar line is not finite");
        c.checks.through("EpipolarFlow", pixelsOf(rig.video.size));
    }
}

void hostileRefinement(Context& c) {
    std::vector<RayMatch> matches;
    PosePrior prior{c.hostile.motion().translation, c.hostile.covariance()};
    if (c.hostile.chance(0.1)) prior.translation.x() = c.hostile.bad();
    const RigidTransform truth = c.hostile.gentle();
    const bool far = c.hostile.chance(0.2);
    for (int i = c.hostile.integer(0, 300); i > 0; --i) {
        const Eigen::Vector2d ray(c.hostile.real(-1, 1), c.hostile.real(-1, 1));
        const double inverseDepth = far ? 0 : c.hostile.real(0, 1);
        const Eigen::Vector3d p =
            truth.rotation * ray.homogeneous() + inverseDepth * truth.translation;
        RayMatch match{ray, p.head<2>() / p.z()};
        if (c.hostile.chance(0.1)) match.still.x() += c.hostile.real(-1, 1);
        if (c.hostile.chance(0.02)) match.still.y() = c.hostile.bad();
        if (c.hostile.chance(0.02)) match.video.y() = c.hostile.bad();
        matches.push_back(match);
    }
    const PoseRefinement out = refineRelativePose(matches, prior, c.hostile.logarithmic(1, 1e4));
    c.checks.require(isFinite(out.motion), "a refined pose that is not finite");
    c.checks.within(out.motion.rotation.norm(), 1 - 1e-9, 1 + 1e-9, "norm of a rotation");
    c.checks.within(out.normalBefore, 0, 1e7,
                    "distance from the epipolar lines before the refinement");
    c.checks.within(out.normalAfter, 0, 1e7,
                    "distance from the epipolar lines after the refinement");
    c.checks.tried("refineRelativePose", static_cast<long>(matches.size()));
}

// From matches without errors, the refinement must find the rotation that the prior pose lacks.
void exactRefinement(Context& c) {
    const Eigen::Vector3d translation = 0.2 * c.hostile.direction();
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(c.hostile.real(0.005, 0.02), c.hostile.direction()));
    PosePrior prior{translation, Matrix6::Identity() * 1e-4};
    prior.covariance.bottomRightCorner<3, 3>() *= 1e-2;
    std::vector<RayMatch> matches;
    for (int i = 0; i < 300; ++i) {
        const Eigen::Vector2d ray(c.hostile.real(-0.5, 0.5), c.hostile.real(-0.4, 0.4));
        const Eigen::Vector3d p = turn * ray.homogeneous() + c.hostile.real(0.2, 1) * translation;
        matches.push_back({ray, p.head<2>() / p.z()});
    }
    const PoseRefinement out = refineRelativePose(matches, prior, 600);
    c.checks.tried("refineRelativePose", 300);
    // In rare cases the rotation moves the matches only along their epipolar lines. Then there is
    // nothing to correct.
    if (!out.accepted && out.normalBefore < 1.1 * kExactEnough) return;
    c.checks.require(out.accepted, "exact matches that are not accepted");
    c.checks.within(out.motion.rotation.angularDistance(turn), 0, 5e-4,
                    "rotation error with exact matches [rad]");
    c.checks.within(out.normalAfter, 0, 0.05,
                    "distance of exact matches from their epipolar lines [px]");
}

/// Median of 3x3 values. Values outside the field repeat its border.
float medianAround(const std::vector<float>& in, Size size, long at) {
    const int x = static_cast<int>(at % size.width), y = static_cast<int>(at / size.width);
    std::array<float, 9> values{};
    for (int i = 0; i < 9; ++i) {
        const int column = std::clamp(x + i % 3 - 1, 0, size.width - 1);
        const int row = std::clamp(y + i / 3 - 1, 0, size.height - 1);
        values[static_cast<std::size_t>(i)] =
            in[static_cast<std::size_t>(row) * size.width + column];
    }
    std::ranges::nth_element(values, values.begin() + 4);
    return values[4];
}

void hostileFilters(Context& c) {
    const Size size = c.size(1, 130);
    std::vector<float> in(pixelsOf(size)), out(in.size());
    for (float& v : in)
        v = static_cast<float>(c.hostile.chance(0.02) ? c.hostile.extreme()
                                                      : c.hostile.real(-100, 100));
    median3x3(in, size, *workers(), out);
    LocalRange range;
    localRange(in, size, c.hostile.integer(0, 8), range);
    for (std::size_t i = 0; i < in.size(); ++i)
        c.checks.require(range.low[i] <= in[i] && in[i] <= range.high[i],
                         "a value lies outside its local range");
    const std::size_t step = in.size() / 2000 + 1;
    for (std::size_t i = 0; i < in.size(); i += step)
        c.checks.require(out[i] == medianAround(in, size, static_cast<long>(i)),
                         "a 3x3 median differs from its definition");
    c.checks.through("median3x3", pixelsOf(size));
}

// Returns a random first label for the window of each pixel. Few windows begin at a label of `far`.
// These windows share no label with other windows, except those with the same first label.
std::vector<std::int16_t> firstLabels(Hostile& hostile, Size size, const std::array<int, 2>& far) {
    std::vector<std::int16_t> base(pixelsOf(size));
    for (auto& b : base) {
        const int usual = hostile.integer(-40, 40), which = hostile.integer(0, 1);
        b = static_cast<std::int16_t>(hostile.chance(0.05) ? far[which] : usual);
    }
    return base;
}

void hostileAggregation(Context& c) {
    const Size size = c.size(1, 100);
    const int vectors = c.hostile.integer(1, 3);
    const LumaImage guide = c.hostile.luma(size);
    const Smoothness smoothness{c.hostile.integer(1, 30), c.hostile.integer(1, 60),
                                c.hostile.real(0, 300)};
    const std::uint64_t seed = c.hostile.generator()();
    // Returns the index of the best label in the window of every pixel.
    const auto indices = [&](const std::array<int, 2>& far) {
        Hostile labels(seed);
        const std::vector<std::int16_t> base = firstLabels(labels, size, far);
        std::vector<Valley> found(base.size());
        SemiGlobal(vectors * base.size())
            .run(
                guide, base, vectors, smoothness,
                [&](int y, std::uint8_t* costs) {
                    Hostile row(seed + 1 + y);
                    for (long i = 0; i < 16L * vectors * size.width; ++i)
                        costs[i] = static_cast<std::uint8_t>(row.integer(0, 24));
                },
                *workers(), found);
        std::vector<float> out(base.size());
        std::ranges::transform(found, base, out.begin(), [](const Valley& valley, int first) {
            return vertexOf(valley) - static_cast<float>(first);
        });
        return out;
    };
    // The distance between two windows that have no label in common must have no influence.
    const std::vector<float> near = indices({-200, 300}), far = indices({-32768, 32000});
    for (std::size_t i = 0; i < far.size(); ++i) {
        c.checks.within(far[i], -0.5, 16 * vectors - 0.5, "index of a label in its search window");
        c.checks.within(far[i] - near[i], -0.01, 0.01,
                        "change of a label if windows without common labels move apart");
    }
    c.checks.through("SemiGlobal", pixelsOf(size));
}

void hostileLuma(Context& c) {
    const Size size = c.size(1, 120);
    const TestPicture picture = c.hostile.picture(
        size, c.hostile.pick({PixelFormat::Gray8, PixelFormat::Rgba8, PixelFormat::Bgra8}));
    LumaImage luma, half, soft, small;
    lumaOf(picture.view(), luma);
    halve(luma, half);
    smooth(luma, static_cast<float>(c.hostile.real(0, 0.333)), soft);
    const auto [low, high] = std::ranges::minmax(luma.pixels);
    for (const LumaImage* one : {&half, &soft})
        for (const std::uint8_t v : one->pixels)
            c.checks.within(v, low - 1, high + 1, "luma after halving or smoothing");
    const Size to{c.hostile.integer(1, size.width), c.hostile.integer(1, size.height)};
    shrinkLuma(picture.view(), to, *workers(), small);
    double sum = 0, shrunk = 0;
    for (const std::uint8_t v : luma.pixels)
        sum += v;
    for (const std::uint8_t v : small.pixels)
        shrunk += v;
    c.checks.within(shrunk / static_cast<double>(pixelsOf(to)) -
                        sum / static_cast<double>(pixelsOf(size)),
                    -0.6, 0.6, "error of a reduced picture's mean luma");
    c.checks.within(noiseOf(luma), 0, 427, "sigma of the luma's noise [grey levels]");
    c.checks.through("luma", pixelsOf(size));
}

}  // namespace

std::vector<Case> searchCases() {
    return {{"search", hostileSearch, true},
            {"search-plane", planeSearch},
            {"flow-of-poses", hostileFlowOfPoses, true},
            {"refinement", hostileRefinement},
            {"refinement-exact", exactRefinement},
            {"filters", hostileFilters, true},
            {"aggregation", hostileAggregation, true},
            {"luma", hostileLuma, true}};
}

}  // namespace mfar::stress
