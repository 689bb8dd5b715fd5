// Runs both engines on the same hostile input. In each step, both engines read what GLES computed
// in the previous step. Otherwise one different decision of a search would make all later steps
// differ. Exception: the detail step of each engine reads that engine's own pictures of the still.
#include "pipeline/engine/engine.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/plan/work_plan.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace mfar::stress {
namespace {

/// Pictures of both sensors. Either both show one scene, or they are arbitrary hostile pictures.
struct Sensors {
    StereoRig rig;
    TestPicture video, still;
};

Sensors matchingSensors(Context& c) {
    const Size video{c.hostile.integer(60, 130), c.hostile.integer(50, 110)};
    const StereoRig rig = plainRig(video, {video.width * 18 / 5, video.height * 18 / 5});
    const Waves waves(static_cast<unsigned>(c.hostile.integer(1, 1 << 30)), 1.2, 60, 12, 96);
    const double step = static_cast<double>(video.width) / rig.still.size.width;
    TestPicture now = waves.shoot(video, {.shift = {c.hostile.real(-3, 3), c.hostile.real(-3, 3)}});
    return {rig, std::move(now), waves.shoot(rig.still.size, {.step = step, .footprint = step})};
}

Sensors hostileSensors(Context& c) {
    Sensors out{hostileRig(c), {}, {}};
    out.video = c.hostile.picture(out.rig.video.size);
    out.still = c.hostile.picture(out.rig.still.size);
    // Limits the contrast, so that no value leaves a byte's range when sharpening and enlarging
    // overshoot. Between passes the GPU would clamp such a value, the CPU would not.
    for (TestPicture* picture : {&out.video, &out.still})
        for (std::uint8_t& byte : picture->bytes)
            byte = static_cast<std::uint8_t>(96 + byte / 4);
    return out;
}

struct Shot {
    RgbPlanes planes;
    TileWork work;

    Shot(Context& c, const TestPicture& picture) : planes(picture.size) {
        planes.take(picture.view());
        WorkPlan plan(picture.size);
        if (c.hostile.chance(0.5)) plan.matchStructured(0.6);
        plan.update(planes, planes, true);
        work = plan.work();
    }
};

int largestDifference(Rows<const std::uint8_t> a, Rows<const std::uint8_t> b) {
    int most = 0;
    for (int y = 0; y < a.size.height; ++y)
        for (int x = 0; x < a.size.width; ++x)
            most = std::max(most, std::abs(a[y][x] - b[y][x]));
    return most;
}

int channelDifference(std::uint32_t a, std::uint32_t b) {
    int most = 0;
    for (int shift = 0; shift < 32; shift += 8)
        most = std::max(most, std::abs(static_cast<int>(a >> shift & 255U) -
                                       static_cast<int>(b >> shift & 255U)));
    return most;
}

long differingPixels(const LumaPyramid& a, const LumaPyramid& b, const LumaLevel& level) {
    const std::uint32_t* words[] = {a.words.host()[0], b.words.host()[0]};
    const auto pixel = [&](int which, int x, int y) {
        const std::uint32_t word =
            words[which][level.offset + y * level.pitch + x / 4 + kLumaMarginWords];
        return static_cast<int>(word >> (8 * (x % 4)) & 255U);
    };
    long count = 0;
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x)
            if (std::abs(pixel(0, x, y) - pixel(1, x, y)) > 1) ++count;
    return count;
}

// Share of the still pyramid's pixels that may differ. At the limit of a strong lens model's valid
// range, rounding decides whether a ray is inside this range.
constexpr double kFolded = 0.1;

void comparePyramids(Context& c, const LumaPyramid& gles, const LumaPyramid& simd) {
    for (const LumaLevel& level : gles.video)
        c.checks.within(static_cast<double>(differingPixels(gles, simd, level)), 0, 0,
                        "number of differing pixels of the video's pyramid");
    for (const LumaLevel& level : gles.still) {
        const long pixels = pixelsOf(Size{level.width, level.height});
        c.checks.within(static_cast<double>(differingPixels(gles, simd, level)), 0,
                        1 + kFolded * static_cast<double>(pixels),
                        "number of differing pixels of the still's pyramid");
    }
}

void compareStills(Context& c, const StillPictures& gles, const StillPictures& simd,
                   bool areQuiet) {
    c.checks.within(largestDifference(gles.luma.host(), simd.luma.host()), 0, 1,
                    "difference of a still's luma");
    const auto raised = gles.raised.host();
    const auto pairs = simd.pairs.host();
    int most = 0;
    for (int y = 0; y < raised.size.height; ++y)
        for (int x = 0; x < raised.size.width; ++x)
            most = std::max(most, std::abs(raised[y][x] - (pairs[y][x] & 255)));
    // Where the still's variance is near that of its noise, rounding decides how much of the noise
    // is removed.
    c.checks.within(most, 0, areQuiet ? 5 : 2, "difference of a still's raised luma");
}

void compareWeights(Context& c, const CellWeights& gles, const CellWeights& simd) {
    const auto a = gles.weighed.host(), b = simd.weighed.host();
    const auto la = gles.lookUps.host(), lb = simd.lookUps.host();
    for (int y = 0; y < a.size.height; ++y)
        for (int x = 0; x < a.size.width; ++x) {
            c.checks.within(b[y][x].weight - a[y][x].weight, -0.02, 0.02,
                            "difference of the engines' weight");
            c.checks.within(b[y][x].confidence - a[y][x].confidence, -0.02, 0.02,
                            "difference of the engines' confidence");
            // Tolerance: the GPU stores look-ups in half precision.
            const double slack = 0.01 + 1e-3 * std::abs(lb[y][x].x) + 1e-3 * std::abs(lb[y][x].y);
            c.checks.within(lb[y][x].x - la[y][x].x, -slack, slack,
                            "difference of the engines' look-ups");
            c.checks.within(lb[y][x].y - la[y][x].y, -slack, slack,
                            "difference of the engines' look-ups");
        }
}

// Share of pixels that may differ in mode blend. Unlike mode detail, this mode shows the still
// wherever forward and backward flow agree, even if the patches differ. Between two such cells the
// position in the still may jump by many pixels, which the GPU interpolates with only 8 bits.
constexpr double kJumps = 0.05;
constexpr int kRounding = 5;  // error of three GPU passes with 8 bits each [grey levels]

void compareDrawn(Context& c, SuperResMode mode, DetailStep& gles, DetailStep& simd) {
    const auto a = gles.output().host(), b = simd.output().host();
    long off = 0;
    for (int y = 0; y < a.size.height; ++y)
        for (int x = 0; x < a.size.width; ++x)
            if (channelDifference(a[y][x], b[y][x]) > kRounding) ++off;
    const double most = mode == SuperResMode::Blend ? kJumps : 0;
    c.checks.within(static_cast<double>(off) / static_cast<double>(pixelsOf(a.size)), 0, most,
                    "share of drawn pixels that differ");
}

Size outputOf(Scale scale, const StereoRig& rig) {
    return scale == Scale::Product ? rig.still.size
                                   : Size{2 * rig.video.size.width, 2 * rig.video.size.height};
}

void stepByStep(Context& c) {
    const Sensors sensors = c.hostile.chance(0.3) ? matchingSensors(c) : hostileSensors(c);
    const StereoRig& rig = sensors.rig;
    const StepSetup setup{rig, outputOf(c.scale, rig), {}, std::make_shared<Workers>(2), nullptr};
    const std::unique_ptr<Engine> engines[] = {makeGlesEngine(setup), makeSimdEngine(setup)};
    const auto mode = c.hostile.pick({SuperResMode::Detail, SuperResMode::Blend});
    const Shot shot(c, sensors.video);
    const VideoFrame frame{sensors.video.view(), shot.planes, 1};

    const double noise = c.hostile.pick({0.0, 5.0});
    const auto glesStill = engines[0]->still(), simdStill = engines[1]->still();
    const StillPictures& still = glesStill->run(sensors.still.view(), mode, {}, noise);
    const StillPictures& simdPictures = simdStill->run(sensors.still.view(), mode, {}, noise);
    compareStills(c, still, simdPictures, noise > 0);

    const auto glesPyramid = engines[0]->pyramid(), simdPyramid = engines[1]->pyramid();
    const float light = c.hostile.pick({0.0F, 1.0F, Guidance::kMost});
    glesPyramid->still(still, light);
    simdPyramid->still(still, light);
    const LumaPyramid& pyramid = glesPyramid->video(frame, shot.work);
    const LumaPyramid& other = simdPyramid->video(frame, shot.work);
    if (shot.work.matched > 0) comparePyramids(c, pyramid, other);

    const auto flow = engines[0]->flow();
    const FlowCells& cells = flow->run({frame, still, light}, pyramid, shot.work, false);
    const auto glesWeigh = engines[0]->weigh(), simdWeigh = engines[1]->weigh();
    const CellWeights& weights = glesWeigh->run(pyramid, cells, shot.work);
    if (shot.work.matched > 0)
        compareWeights(c, weights, simdWeigh->run(pyramid, cells, shot.work));

    const auto glesDetail = engines[0]->detail(), simdDetail = engines[1]->detail();
    const DetailStep::Matched glesMatched{still, weights}, simdMatched{simdPictures, weights};
    glesDetail->draw(frame, &glesMatched, shot.work, {.mode = mode});
    simdDetail->draw(frame, &simdMatched, shot.work, {.mode = mode});
    compareDrawn(c, mode, *glesDetail, *simdDetail);
    c.gl.frame(c.checks, pixelsOf(rig.video.size));
    for (const char* step : {"simd still", "simd pyramid", "simd weigh", "simd detail"})
        c.checks.through(step, pixelsOf(rig.video.size));
}

}  // namespace

std::vector<Case> engineCases() {
    return {{"engines", stepByStep, true}};
}

}  // namespace mfar::stress
