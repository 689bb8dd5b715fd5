#include "pipeline/pipeline.h"

#include "base/image_layout.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/pipeline_state.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {
namespace {

void requireFit(const ImageView& view, Size size, const char* what) {
    if (view.size == size) {
        requireSound(view, what);
        return;
    }
    throw std::invalid_argument(std::string(what) + " is " + std::to_string(view.size.width) + "x" +
                                std::to_string(view.size.height) + ", the calibration says " +
                                std::to_string(size.width) + "x" + std::to_string(size.height));
}

void publishPose(const EpipolarFlow& flow, FrameStats& stats) {
    const PoseRefinement& refinement = flow.search().refinement();
    stats.usedPose = true;
    stats.predicted = flow.predicted();
    stats.refinedPose = refinement.accepted;
    stats.posePatches = refinement.patches;
    stats.epipolarError = refinement.normalAfter;
}

int tilesIn(const PixelRect& videoPixels) {
    const PixelRect tiles = tilesAround(videoPixels);
    return (tiles.x1 - tiles.x0) * (tiles.y1 - tiles.y0);
}

}  // namespace

Size Pipeline::State::outputSize(const StereoRig& rig, Size wanted) {
    return wanted.width > 0 && wanted.height > 0 ? wanted : fullSize(rig);
}

Size Pipeline::fullSize(const StereoRig& rig) {
    const double scale = static_cast<double>(rig.still.size.width) / rig.video.size.width;
    const auto height = static_cast<int>(std::lround(rig.video.size.height * scale));
    return {rig.still.size.width, std::max(height, 1)};
}

Pipeline::Pipeline(const StereoRig& rig, const PipelineOptions& options)
    : state_(std::make_unique<State>(rig, options)) {}
Pipeline::~Pipeline() = default;
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&&) noexcept = default;

void Pipeline::setStill(const ImageView& still, Timestamp, const std::optional<Pose>& pose) {
    State& s = *state_;
    requireFit(still, s.rig.still.size, "still");
    s.still.set(still);
    s.epipolar.dropStill();
    if (pose) s.epipolar.setStill(still, *pose);
    s.depth.renew();
    s.pyramids.buildStill(s.still.whole(), s.rig);
    s.hasStill = true;
    s.redraw = true;
    s.hasPrior = false;
}

void Pipeline::dropStill() {
    state_->hasStill = false;
    state_->epipolar.dropStill();
    state_->redraw = true;
    state_->hasPrior = false;
}

void Pipeline::setMode(SuperResMode mode) {
    state_->options.mode = mode;
    state_->superres.setMode(mode);
    state_->superres.setCubic(true);
    state_->redraw = true;
}

void Pipeline::setQuality(const Quality& quality) {
    validate(quality);
    State& s = *state_;
    s.options.mode = quality.mode;
    s.superres.setMode(quality.mode);
    s.superres.setCubic(quality.cubic || quality.mode != SuperResMode::Off);
    s.flow.setOptions(quality.flow2d);
    s.epipolar.setOptions(quality.epipolar);
    s.alongLines = quality.alongLines;
    s.detailShare = quality.detailShare;
    s.depthEvery = quality.depthEvery;
}

void Pipeline::redraw() {
    state_->redraw = true;
}

void Pipeline::setObjects(std::vector<VirtualObject> objects) {
    State& s = *state_;
    if (!s.objects && objects.empty()) return;
    if (!s.objects || s.objects->traced() != nullptr) {
        s.objects.emplace(s.rig.video, outputSize());
        s.objects->setSkips(s.options.skips);
        s.redraw = true;
    }
    s.objects->setObjects(std::move(objects));
}

void Pipeline::setScene(std::shared_ptr<const Scene> scene, const TracedLayerOptions& options) {
    State& s = *state_;
    if (!s.objects && !scene) return;
    TracedLayerOptions wanted = options;
    const Size output = outputSize();
    if (wanted.size.width <= 0 || wanted.size.height <= 0)
        wanted.size = {(output.width + 1) / 2, (output.height + 1) / 2};
    if (!s.objects || s.objects->traced() == nullptr || !(s.traced == wanted)) {
        s.objects.emplace(s.rig.video, output, wanted);
        s.objects->setSkips(s.options.skips);
        s.traced = wanted;
        s.redraw = true;
    }
    s.objects->setScene(std::move(scene));
}

PixelRect Pipeline::objectsRegion() const {
    return state_->objects ? state_->objects->region() : PixelRect{};
}

std::optional<TracedLayerCounters> Pipeline::tracedCounters() const {
    if (!state_->objects || state_->objects->traced() == nullptr) return {};
    return state_->objects->traced()->counters();
}

std::optional<std::string> Pipeline::takeSceneError() {
    if (!state_->objects || state_->objects->traced() == nullptr) return {};
    return state_->objects->traced()->takeError();
}

void Pipeline::setImporter(PlaneImporter* importer) {
    state_->video.setImporter(importer);
    state_->still.setImporter(importer);
}

std::optional<std::string> Pipeline::takeImportFault() {
    std::optional<std::string> fault = state_->video.takeImportFault();
    return fault ? fault : state_->still.takeImportFault();
}

void Pipeline::setSkipUnchanged(bool skip) {
    state_->options.skipUnchanged = skip;
}

void Pipeline::State::limitMatching() {
    if (options.mode == SuperResMode::Blend || !options.skips.smoothTiles)
        plan.matchEverything();
    else
        plan.matchStructured(detailShare);
}

// The pixels of the video in these tiles.
PixelRect Pipeline::State::pixelsOf(const PixelRect& tiles) const {
    const auto [width, height] = rig.video.size;
    return common(
        {tiles.x0 * kTileSize, tiles.y0 * kTileSize, tiles.x1 * kTileSize, tiles.y1 * kTileSize},
        {0, 0, width, height});
}

// Along epipolar lines where the frame's pose is known, and the still's.
void Pipeline::State::matchStill(const ImageView& frame, const std::optional<Pose>& pose,
                                 const PixelRect& forDepth) {
    pyramids.buildVideo(video.texture(), plan);
    lap("pyramid");
    if (pose) {
        // The search runs on the processor, so that has to know whether it is needed.
        const PixelRect where = around(pixelsOf(plan.detailTiles()), forDepth);
        const int tiles = forDepth.empty() ? plan.matchedTiles() : plan.changedTiles();
        if (tiles > 0 && !where.empty()) epipolar.run(frame, *pose, where);
        lap("epipolar");
        flow.refine(pyramids, plan, epipolar.forward(), epipolar.hidden());
    } else {
        flow.run(pyramids, plan, hasPrior && options.skips.knownFlow);
    }
    lap("flow");
    superres.assess(pyramids, flow, plan);
    lap("assess");
}

PixelRect Pipeline::State::placeObjects(const std::optional<Pose>& pose, Timestamp time) {
    PixelRect where;
    if (objects) {
        where = objects->place(pose ? std::optional(pose->T_world_video) : std::nullopt, time,
                               depth.field());
        plan.drawnOver(objects->staleTiles(), objects->redraw());
    }
    if (options.depthEverywhere) where = {0, 0, rig.video.size.width, rig.video.size.height};
    return where;
}

void Pipeline::State::prepareDepth(bool hasPose, bool searched, const PixelRect& where) {
    draws = objects && plan.redraws();
    const bool isNeeded = options.depthEverywhere ? plan.changedTiles() > 0 : draws;
    matches.reset();
    measures = hasPose && isNeeded && (!where.empty() || inView());
    depthIsDue = measures && ++depthAge >= depthEvery && !where.empty();
    if (!depthIsDue) return;
    depthAge = 0;
    if (searched) matches = {flow.readForward(), flow.searched().read()};
}

void Pipeline::State::measureDepth(const ImageView& frame, const Pose& pose,
                                   const PixelRect& where) {
    if (matches) {
        const DepthStage::StillSearch still{epipolar.search(), epipolar.rotation(), epipolar.unit(),
                                            epipolar.lengthError(),
                                            epipolar.inverseDepthOf(matches->vectors)};
        depth.run(epipolar.luma(), pose, still, where);
        forgetMoving(*matches);
    } else {
        lumaOf(frame, luma);
        depth.run(luma, pose, {}, depthIsDue ? where : PixelRect{});
    }
    snap.run(depth.field(), frame, where);
}

// Where the flow leaves the epipolar lines, the scene is not at rest.
void Pipeline::State::forgetMoving(const DepthMatches& matches) {
    const Size tiles = plan.tileCount();
    for (int t = 0; t < tiles.width * tiles.height; ++t) {
        if (!matches.searched2d[static_cast<std::size_t>(t)]) continue;
        const int x = t % tiles.width, y = t / tiles.width;
        const PixelRect tile = pixelsOf({x, y, x + 1, y + 1});
        if (leavesLines(tile, matches.vectors)) depth.forget(tile);
    }
}

// Of the tile's cells a quarter at least.
bool Pipeline::State::leavesLines(const PixelRect& tile, const EpipolarFlow::Cells& vectors) const {
    const int columns = flow.forward().cells.width;
    int off = 0, all = 0;
    for (int y = tile.y0 + 1; y < tile.y1; y += kCell) {
        for (int x = tile.x0 + 1; x < tile.x1; x += kCell, ++all) {
            const auto& u = vectors[static_cast<std::size_t>(y / kCell) * columns + x / kCell];
            if (epipolar.offLine(x, y, u[0], u[1]) > kOffLine) ++off;
        }
    }
    return 4 * off >= all;
}

// Depth and what it decides about. Where nothing is measured, what is known goes on with the
// camera.
void Pipeline::State::showObjects(const ImageView& frame, Timestamp time,
                                  const std::optional<Pose>& pose, const PixelRect& where) {
    result.stats.objectsInView = inView();
    result.stats.objectsHidden = inView() && objects->hidden();
    if (measures) {
        measureDepth(frame, {time, pose->T_world_video, pose->covariance}, where);
        result.stats.depthTiles = tilesIn(where);
        if (inView())
            result.stats.depthTilesSkipped =
                std::max(tilesIn(objects->region()) - tilesIn(where), 0);
        if (!where.empty()) result.stats.depth = depth.source();
        lap("depth");
    }
    if (!draws) return;
    objects->draw(snap.field(), snap.where(), video.texture(), superres.output(),
                  superres.target());
    lap("composite");
}

void Pipeline::State::keepDrawn() {
    result.unchanged = false;
    if (plan.drawsWhole()) {
        std::swap(now, drawn);
        return;
    }
    result.unchanged = !draws;
    const Size tiles = plan.tileCount();
    for (int row = 0, i = 0; row < tiles.height; ++row)
        for (int column = 0; column < tiles.width; ++column, ++i)
            if (plan.draws(i)) {
                drawn.takeTile(now, column, row);
                result.unchanged = false;
            }
}

const FrameResult& Pipeline::run(const ImageView& video, Timestamp time,
                                 const std::optional<Pose>& pose) {
    State& s = *state_;
    requireFit(video, s.rig.video.size, "video frame");
    s.stageTimes.clear();
    s.lastLap = std::chrono::steady_clock::now();

    const PixelRect where = s.placeObjects(pose, time);
    s.limitMatching();
    s.now.take(video);
    s.plan.update(s.now, s.drawn, s.redraw || !s.options.skipUnchanged);
    s.lap("plan");
    // At rest the GPU is left alone.
    if (s.plan.changedTiles() > 0 || s.plan.drawsWhole() || s.plan.redraws()) {
        s.video.upload(video);
        s.lap("upload");
    }
    const bool useStill = s.hasStill && s.options.mode != SuperResMode::Off;
    const bool usePose = useStill && s.alongLines && pose && s.epipolar.hasStill();
    if (useStill) s.matchStill(video, usePose ? pose : std::nullopt, where);
    s.prepareDepth(pose.has_value(), usePose, where);
    s.superres.draw(s.video.texture(), useStill ? &s.still : nullptr, s.plan);
    s.keepDrawn();
    glFlush();
    s.lap("superres");
    s.result.stats = s.superres.statsBefore();
    s.showObjects(video, time, pose, where);
    s.redraw = false;
    s.hasPrior = useStill;

    s.result.stats.usedStill = useStill;
    s.result.stats.searched2d = s.flow.searched().countBefore();
    if (usePose) publishPose(s.epipolar, s.result.stats);
    s.result.flow = {&s.flow.patches(), s.flow.forward().cells, 4};
    s.video.finishReading();  // long done
    return s.result;
}

const InverseDepthField& Pipeline::inverseDepth() const {
    return state_->snap.field();
}

Size Pipeline::outputSize() const {
    return state_->superres.output().size();
}

const std::vector<StageTime>& Pipeline::stageTimes() const {
    return state_->stageTimes;
}

void Pipeline::setMeasure(bool measure) {
    state_->measure = measure;
}

}  // namespace mfar
