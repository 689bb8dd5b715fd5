#include "pipeline/pipeline.h"

#include "base/image_layout.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/gles/device_copies.h"
#include "pipeline/pipeline_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {
namespace {

void requireFit(const ImageView& view, Size size, const char* what) {
    if (view.size == size) return requireSound(view, what);
    throw std::invalid_argument(std::string(what) + " is " + std::to_string(view.size.width) + "x" +
                                std::to_string(view.size.height) + ", but the calibration is for " +
                                std::to_string(size.width) + "x" + std::to_string(size.height));
}

void publishPose(const EpipolarFlow& flow, FrameStats& stats) {
    const PoseRefinement& refinement = flow.search().refinement();
    stats.predicted = flow.predicted();
    stats.refinedPose = refinement.accepted;
    stats.posePatches = refinement.patches;
    stats.epipolarError = refinement.normalAfter;
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

Pipeline::State::State(const StereoRig& rigIn, const PipelineOptions& optionsIn)
    : rig(rigIn), options(optionsIn), output(outputSize(rig, options.output)),
      workers(std::make_shared<Workers>(options.threads)), now(rig.video.size),
      drawn(rig.video.size), plan(rig.video.size, workers), secondTiles(tilesOf(rig.video.size)) {
    validate(options.epipolar);
    validate(options.depth);
    const StepSetup setup{rig, output, options.flow2d, workers, &transfers};
    if (options.engines.uses(EngineKind::Gles)) gles = makeGlesEngine(setup);
    if (options.engines.uses(EngineKind::Simd)) simd = makeSimdEngine(setup);
    newest = makeReference();
    second = makeReference();
    detail = engineOf(options.engines.detail).detail();
    quality.mode = options.mode;
    if (!options.skips.tileLists) plan.drawWholeFrom(0);
    if (options.depthEverywhere) needDepth();
}

Engine& Pipeline::State::engineOf(EngineKind kind) {
    return kind == EngineKind::Gles ? *gles : *simd;
}

Reference Pipeline::State::makeReference() {
    const EngineChoice& engines = options.engines;
    Reference out{engineOf(engines.still).still(), engineOf(engines.pyramid).pyramid(),
                  engineOf(engines.flow).flow(), engineOf(engines.weigh).weigh()};
    const Size cells = cellsOf(rig.video.size);
    out.first.reserve(static_cast<std::size_t>(cells.width) * cells.height);
    return out;
}

Pipeline::Pipeline(const StereoRig& rig, const PipelineOptions& options)
    : state_(std::make_unique<State>(rig, options)) {}
Pipeline::~Pipeline() = default;
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&&) noexcept = default;

void Pipeline::setStill(const ImageView& still, Timestamp time, const std::optional<Pose>& pose) {
    State& s = *state_;
    requireFit(still, s.rig.still.size, "still");
    s.tellReplaced();
    s.retireNewest();
    s.filters = s.nextFilters;
    s.newest.take(still, time, s.quality.mode, *s.filterBank());
    const EngineChoice& engines = s.options.engines;
    if (std::ranges::count(std::array{engines.flow, engines.weigh, engines.detail},
                           EngineKind::Simd) > 0)
        s.simd->take(*s.newest.pictures);
    if (s.epipolar) s.epipolar->dropStill();
    if (pose) s.needEpipolar().setStill(still, *pose);
    if (s.depth) s.depth->stage.renew();
    s.redraw = true;
    s.isNewStill = true;
}

void Pipeline::State::retireNewest() {
    if (newest.pictures == nullptr) return;
    if (!keepsSecond())
        second.drop();
    else if (!keepsOlder(second, newest))
        std::swap(newest, second);
    secondTiles.forget();
}

void Pipeline::dropStill() {
    state_->newest.drop();
    state_->second.drop();
    if (state_->epipolar) state_->epipolar->dropStill();
    state_->redraw = true;
}

void Pipeline::setMode(SuperResMode mode) {
    state_->quality.mode = mode;
    state_->quality.cubic = true;
    state_->newest.still->setMode(mode);
    state_->redraw = true;
}

void Pipeline::setQuality(const Quality& quality) {
    validate(quality);
    State& s = *state_;
    if (quality.mode != s.quality.mode) s.newest.still->setMode(quality.mode);
    s.quality = quality;
    s.quality.cubic = quality.cubic || quality.mode != SuperResMode::Off;
    s.newest.flow->setOptions(quality.flow2d);
    s.second.flow->setOptions(quality.flow2d);
    s.options.epipolar = changed(s.options.epipolar, quality.epipolar);
    if (s.epipolar) s.epipolar->setOptions(s.options.epipolar);
}

void Pipeline::setFilters(std::shared_ptr<const FilterBank> filters) {
    State& s = *state_;
    s.nextFilters = std::move(filters);
    if (s.newest.pictures != nullptr) return;
    s.filters = s.nextFilters;
    s.redraw = true;
}

void Pipeline::setMatchListener(MatchListener* listener) {
    state_->matchListener = listener;
}

void Pipeline::redraw() {
    state_->redraw = true;
}

void Pipeline::setImporter(PlaneImporter* importer) {
    if (state_->gles) state_->gles->setImporter(importer);
}

std::optional<std::string> Pipeline::takeImportFault() {
    return state_->gles ? state_->gles->takeImportFault() : std::nullopt;
}

void Pipeline::setSkipUnchanged(bool skip) {
    state_->options.skipUnchanged = skip;
}

const FrameResult& Pipeline::run(const ImageView& video, Timestamp time,
                                 const std::optional<Pose>& pose) {
    State& s = *state_;
    requireFit(video, s.rig.video.size, "video frame");
    s.clock.start();
    s.result.stats = {};
    const VideoFrame frame{video, s.now, ++s.frames};

    const PixelRect decides = s.placeObjects(pose, time);
    const TileWork& work = s.planFrame(frame);
    s.rest.add(s.plan.measured(), s.plan.leastStructure(),
               s.plan.redrawnShare() - s.plan.changedShare(), time);
    const bool usesStill = s.newest.pictures != nullptr && s.quality.mode != SuperResMode::Off;
    const bool usesPose =
        usesStill && s.quality.alongLines && pose && s.epipolar && s.epipolar->matches(*pose);
    std::optional<State::Match> match;
    if (usesStill)
        match.emplace(s.matchStill(frame, work, usesPose ? pose : std::nullopt, decides));
    if (match) match->second = s.matchSecond(frame, work);
    const State::DepthTask task =
        s.prepareDepth(decides, pose.has_value(), usesPose ? &match->flow : nullptr);
    s.drawDetail(frame, work, match ? &*match : nullptr);
    if (task.measures) s.measureDepth(frame, time, *pose, task);
    s.showObjects(frame);
    s.publish(work, usesStill);
    s.followScene(frame, pose, time);
    if (pose && s.quality.mode != SuperResMode::Off && s.quality.alongLines) s.beginEpipolar();
    return s.result;
}

void Pipeline::State::beginEpipolar() {
    if (epipolar || comingEpipolar.valid()) return;
    comingEpipolar =
        std::async(std::launch::async, [rig = rig, workers = workers, how = options.epipolar] {
            return std::make_unique<EpipolarFlow>(rig, workers, how);
        });
}

EpipolarFlow& Pipeline::State::needEpipolar() {
    if (epipolar) return *epipolar;
    beginEpipolar();
    epipolar = comingEpipolar.get();
    epipolar->setOptions(options.epipolar);
    return *epipolar;
}

const TileWork& Pipeline::State::planFrame(const VideoFrame& frame) {
    if (quality.mode == SuperResMode::Blend || !options.skips.smoothTiles)
        plan.matchEverything();
    else
        plan.matchStructured(quality.detailShare);
    now.take(frame.view);
    plan.update(now, drawn, redraw || !options.skipUnchanged);
    lap("plan");
    return plan.work();
}

Pipeline::State::Match Pipeline::State::matchStill(const VideoFrame& frame, const TileWork& work,
                                                   const std::optional<Pose>& pose,
                                                   const PixelRect& forDepth) {
    const LumaPyramid& pyramids = newest.pyramid->video(frame, work);
    lap("pyramid");
    const FlowCells* found = nullptr;
    const bool usePrior = newest.lastFlow != nullptr && options.skips.knownFlow;
    if (pose) {
        const PixelRect where = around(pixelsOf(work.detailTiles), forDepth);
        const int tiles = forDepth.empty() ? work.matched : work.changed;
        result.stats.usedPose = true;
        if (tiles > 0 && !where.empty()) {
            epipolar->run(frame.view, *pose, where, rest.restedSince(newest.time));
            publishPose(*epipolar, result.stats);
        }
        lap("epipolar");
        found = &newest.flow->refine({frame, *newest.pictures, light()}, pyramids, work,
                                     {epipolar->forward(), epipolar->occlusion()}, usePrior);
    } else {
        found = &newest.flow->run({frame, *newest.pictures, light()}, pyramids, work, usePrior);
    }
    lap("flow");
    const CellWeights& weights = weighed(newest, frame, pyramids, *found, work);
    lap("weigh");
    if (work.matched > 0) newest.lastFlow = found;  // without matched tiles, nothing was searched
    newest.lastWeights = &weights;
    listen(weights);
    return {*found, weights};
}

const CellWeights& Pipeline::State::weighed(const Reference& still, const VideoFrame& frame,
                                            const LumaPyramid& pyramids, const FlowCells& flow,
                                            const TileWork& work) {
    const CellWeights& weights = still.weigh->run(pyramids, flow, work);
    if (quality.mode != SuperResMode::Detail || !quality.learned) return weights;
    const FineMatch& match = filterBank()->fineMatch();
    return match.isKnown() ? still.weigh->confirm(frame, *still.pictures, work, match) : weights;
}

const CellWeights* Pipeline::State::matchSecond(const VideoFrame& frame, const TileWork& work) {
    if (keepsSecond() && work.matched == 0) return nullptr;
    // A search may start only from the flow of the last frame with matched tiles, not an older one.
    const FlowCells* const lastFlow = std::exchange(second.lastFlow, nullptr);
    if (!keepsSecond()) return nullptr;
    if (newest.first.empty()) newest.keepFirst();
    const SecondTiles::Match shown{newest.lastWeights->weighed.host(),
                                   newest.lastWeights->trust.host()};
    const double share = second.pictures != nullptr ? quality.secondShare : 0;
    const int most = static_cast<int>(std::ceil(share * static_cast<double>(work.flags.size())));
    const TileWork& missed = secondTiles.choose(work, plan.measured(), shown, most);
    newest.count(secondTiles.matched(), secondTiles.shownByNewest());
    if (missed.matched == 0) return nullptr;
    const LumaPyramid& luma = second.pyramid->video(frame, missed);
    const bool prior = lastFlow != nullptr && options.skips.knownFlow;
    second.lastFlow = &second.flow->run({frame, *second.pictures, light()}, luma, missed, prior);
    second.lastWeights = &weighed(second, frame, luma, *second.lastFlow, missed);
    secondTiles.judge(shown, second.lastWeights->weighed.host());
    second.count(missed.matched, secondTiles.gained());
    result.stats.matchedSecond = missed.matched;
    lap("second still");
    return second.lastWeights;
}

void Pipeline::State::listen(const CellWeights& weights) {
    if (!isNewStill || newest.lastFlow == nullptr || quality.mode != SuperResMode::Detail) return;
    isNewStill = false;
    if (matchListener == nullptr || !quality.learned) return;
    matchListener->matched(now, newest.pictures->luma.host(), weights.lookUps.host(), lookedUp());
}

MatchedPictures::LookedUp Pipeline::State::lookedUp() const {
    const CameraModel& looked = newest.pictures->rig.still;
    return {looked.size, looked.fx / rig.video.fx, looked.fy / rig.video.fy, newest.pictures->tone};
}

void Pipeline::State::tellReplaced() {
    if (matchListener == nullptr || !quality.learned || quality.mode != SuperResMode::Detail)
        return;
    if (newest.pictures == nullptr || newest.lastFlow == nullptr) return;
    matchListener->replaced(drawn, newest.pictures->luma.host(), newest.lastWeights->lookUps.host(),
                            lookedUp());
}

void Pipeline::State::drawDetail(const VideoFrame& frame, const TileWork& work,
                                 const Match* match) {
    // Both skips are off in mode Blend: it enlarges in another way and weighs by the confidence.
    const bool blends = quality.mode == SuperResMode::Blend;
    const DetailOptions how{quality.mode, quality.cubic, options.skips.enlargedTiles && !blends,
                            options.skips.plainTiles && !blends,
                            quality.learned ? filterBank() : nullptr};
    if (match != nullptr) {
        DetailStep::Matched matched{*newest.pictures, match->weights};
        std::optional<DetailStep::Matched> also;
        if (match->second != nullptr)
            matched.second = &also.emplace(DetailStep::Matched{*second.pictures, *match->second});
        detail->draw(frame, &matched, work, how);
    } else {
        detail->draw(frame, nullptr, work, how);
        newest.lastFlow = second.lastFlow = nullptr;
    }
    if (gles) gles->flush();
    lap("detail");
}

void Pipeline::State::keepDrawn(const TileWork& work) {
    result.unchanged = false;
    if (work.drawsWhole()) {
        std::swap(now, drawn);
        return;
    }
    result.unchanged = !drawsObjects();
    for (int row = 0, i = 0; row < work.tiles.height; ++row)
        for (int column = 0; column < work.tiles.width; ++column, ++i)
            if (work.draws(static_cast<std::size_t>(i))) {
                drawn.takeTile(now, column, row);
                result.unchanged = false;
            }
}

void Pipeline::State::publish(const TileWork& work, bool usedStill) {
    FrameStats& stats = result.stats;
    publishTiles(detail->finishedSummary(), stats);
    stats.changed = plan.changedShare();
    stats.redrawn = plan.redrawnShare();
    stats.usedStill = usedStill;
    stats.searched2d = newest.flow->finishedSearchedCount();
    stats.transfers = {transfers.uploadedBytes - transfersBefore.uploadedBytes,
                       transfers.downloadedBytes - transfersBefore.downloadedBytes};
    transfersBefore = transfers;
    const Field<std::uint32_t>& picture = detail->output();
    if (picture.isOnDevice())
        result.picture =
            GlImage{textureOf(picture, gpu::TexelFormat::Rgba8).texture().id(), output};
    else
        result.picture = picture.host();
    keepDrawn(work);
    redraw = false;
    // Hardly waits, because the GPU reads the frame's memory before it does all other work.
    if (gles) gles->finishReading();
}

void Pipeline::State::publishTiles(const TileSummary& tiles, FrameStats& stats) const {
    stats.tiles = tiles.tiles;
    stats.meanConfidence = tiles.meanConfidence;
    stats.explained = std::max(1 - (1 - tiles.explained) * plan.structuredPerMatched(), 0.0);
    stats.showSecond = tiles.second;
}

void Pipeline::State::lap(const char* stage) {
    if (clock.measures && gles) gles->finish();
    clock.lap(stage);
}

PixelRect Pipeline::State::pixelsOf(const PixelRect& tiles) const {
    const auto [width, height] = rig.video.size;
    return common(
        {tiles.x0 * kTileSize, tiles.y0 * kTileSize, tiles.x1 * kTileSize, tiles.y1 * kTileSize},
        {0, 0, width, height});
}

Size Pipeline::outputSize() const {
    return state_->output;
}

const std::vector<StageTime>& Pipeline::stageTimes() const {
    return state_->clock.times();
}

void Pipeline::finish(EngineKind shownFrom) const {
    const Field<std::uint32_t>& picture = state_->detail->output();
    if (shownFrom == EngineKind::Simd)
        (void)picture.host();
    else
        (void)textureOf(picture, gpu::TexelFormat::Rgba8);
    if (state_->gles) state_->gles->finish();
}

void Pipeline::setMeasure(bool measure) {
    state_->clock.measures = measure;
}

}  // namespace mfar
