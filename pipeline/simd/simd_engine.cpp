#include "pipeline/engine/engine.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/flow/least_texture.h"
#include "pipeline/simd/detail_step.h"
#include "pipeline/simd/direct_match.h"
#include "pipeline/simd/fine_check.h"
#include "pipeline/simd/flow2d.h"
#include "pipeline/simd/luma_pyramids.h"
#include "pipeline/simd/occlusion_step.h"
#include "pipeline/simd/simd_warp.h"
#include "pipeline/simd/still_kernels.h"
#include "pipeline/simd/still_preparation.h"
#include "pipeline/simd/subpixel_flow.h"
#include "pipeline/simd/weigh_step.h"
#include "pipeline/superres/still_scale.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace mfar {
namespace {

class SimdStill final : public StillStep {
public:
    explicit SimdStill(const StepSetup& setup) : still_(setup.rig, setup.output, setup.workers) {
        pictures_.rig = still_.rig();
    }

    const StillPictures& run(const ImageView& still, SuperResMode mode, const StillTone& tone,
                             double noise) override {
        still_.set(still, tone, true, noise);
        ++pictures_.number;
        pictures_.tone = tone;
        pictures_.luma.writtenOnHost(still_.luma());
        const simd::StillPairs pairs = still_.pairs();
        pictures_.pairs.writtenOnHost(
            Rows<const std::uint16_t>{pairs.data, pairs.pitch, pairs.size});
        setMode(mode);
        return pictures_;
    }
    void setMode(SuperResMode mode) override {
        if (pictures_.number > 0 && mode == SuperResMode::Blend)
            pictures_.picture.writtenOnHost(still_.picture());
    }

private:
    simd::StillPreparation still_;
    StillPictures pictures_;
};

class SimdPyramid final : public PyramidStep {
public:
    explicit SimdPyramid(const StepSetup& setup)
        : rig_(setup.rig), pyramids_(setup.rig.video.size, setup.workers),
          luma_{pyramids_.video(), pyramids_.still(), Field<std::uint32_t>({}, setup.transfers)} {}

    const LumaPyramid& video(const VideoFrame& frame, const TileWork& work) override {
        if (work.matched > 0) pyramids_.buildVideo(frame.planes);
        return written();
    }
    const LumaPyramid& still(const StillPictures& still, float light) override {
        pyramids_.buildStill(still.luma.host(), rig_, light);
        return written();
    }

private:
    const LumaPyramid& written() {
        const auto words = pyramids_.words();
        const auto count = static_cast<int>(words.size());
        luma_.words.writtenOnHost(Rows<const std::uint32_t>{words.data(), count, {count, 1}});
        return luma_;
    }

    StereoRig rig_;
    simd::LumaPyramids pyramids_;
    LumaPyramid luma_;
};

/// The StillPairs of the current stills, for all steps of the SIMD engine. A still that the GLES
/// engine prepared has no pairs, so this class creates them, once per still.
class PairedStills {
public:
    explicit PairedStills(std::shared_ptr<Workers> workers) : workers_(std::move(workers)) {}

    simd::StillPairs of(const StillPictures& still) {
        if (!still.pairs.isEmpty()) {
            const Rows<const std::uint16_t> rows = still.pairs.host();
            return {rows.data, rows.pitch, rows.size};
        }
        Made& made = madeOf(still);
        if (made.number != still.number) {
            pair(still.raised.host(), made.pairs);
            made.number = still.number;
        }
        return {made.pairs[0], made.pairs.pitch(), made.pairs.size()};
    }

private:
    struct Made {
        const StillPictures* still;
        std::uint64_t number = 0;
        AlignedRows<std::uint16_t> pairs{};
    };
    Made& madeOf(const StillPictures& still) {
        const auto at = std::ranges::find(made_, &still, &Made::still);
        return at != made_.end() ? *at : made_.emplace_back(Made{&still});
    }
    void pair(Rows<const std::uint8_t> luma, AlignedRows<std::uint16_t>& to) {
        const auto [width, height] = luma.size;
        if (to.size() != luma.size) to = AlignedRows<std::uint16_t>(luma.size);
        workers_->forRange(height, 16, [&, width = width, height = height](int y, int end) {
            for (; y < end; ++y)
                simd::pairRows(luma[y], luma[std::min(y + 1, height - 1)],
                               static_cast<std::size_t>(width), to[y]);
        });
    }

    std::shared_ptr<Workers> workers_;
    std::vector<Made> made_;
};

class SimdFlow final : public FlowStep {
public:
    SimdFlow(const StepSetup& setup, std::shared_ptr<PairedStills> stills)
        : workers_(setup.workers), stills_(std::move(stills)),
          lookUp_(stillFor(setup.output, setup.rig)),
          subpixel_(stillFor(setup.output, setup.rig), setup.workers),
          flow_(setup.rig.video.size, setup.flow2d, setup.workers),
          cells_{Field<FlowCell>({}, setup.transfers), flow_.forward().size, flow_.backward().size,
                 flow_.backwardLevel(), false},
          row_({2 * static_cast<int>(cells_.count()), 1}) {}

    void setOptions(const Flow2dOptions& options) override { flow_.setOptions(options); }
    const FlowCells& run(const Pictures& pictures, const LumaPyramid& luma, const TileWork& work,
                         bool usePrior) override {
        flow_.run(lumaOf(luma), work, usePrior);
        if (work.matched > 0) {
            copy(flow_.backward(), row_[0] + cells_.count());
            copy(flow_.forward(), row_[0]);
            correct(pictures, work, nullptr);
        }
        return written();
    }
    const FlowCells& refine(const Pictures& pictures, const LumaPyramid& luma, const TileWork& work,
                            const AlongLines& along, bool usePrior) override {
        flow_.refine(lumaOf(luma), work, along.vectors, along.errors, usePrior);
        if (work.matched > 0) {
            copy(flow_.errors(), errors());
            copy(flow_.forward(), row_[0]);
            matchDirectly(pictures, work, along.vectors);
            correct(pictures, work, errors());
        }
        return written();
    }
    std::vector<bool> searchedTiles() const override { return flow_.searchedTiles(); }
    int searchedCount() const override { return flow_.searchedCount(); }

private:
    static simd::Flow2d::Luma lumaOf(const LumaPyramid& luma) {
        const Rows<const std::uint32_t> words = luma.words.host();
        return {luma.video, luma.still, {words.data, static_cast<std::size_t>(words.size.width)}};
    }
    ErrorCell* errors() { return reinterpret_cast<ErrorCell*>(row_[0] + cells_.count()); }
    void matchDirectly(const Pictures& pictures, const TileWork& work, Cells lines) {
        const simd::StillPairs pairs = stills_->of(pictures.still);
        const simd::DirectMatch match{
            pictures.video.planes,   pairs,        lookUp_,
            cells_.forward,          lines.data(), static_cast<float>(work.noise),
            leastTexture(work.noise)};
        workers_->forRange(cells_.forward.height, 1, [&](int first, int last) {
            for (int y = first; y < last; ++y)
                simd::forRuns(work, y / kCellsPerTile, kCellsPerTile, cells_.forward.width,
                              [&](bool matched, int begin, int end) {
                                  if (matched)
                                      simd::matchDirectly(match, y, begin, end, row_[0], errors());
                              });
        });
    }
    void correct(const Pictures& pictures, const TileWork& work, const ErrorCell* errors) {
        subpixel_.run(pictures.video.planes, stills_->of(pictures.still), pictures.light, work,
                      row_[0], errors);
    }
    // Copies results of flow_ to row_. Must not be called in a frame without matched tiles: flow_
    // has no new results then, and the corrected flow and errors in row_ stay valid.
    template <class Cell>
    static void copy(Rows<const Cell> from, Cell* to) {
        for (int y = 0; y < from.size.height; ++y)
            to = std::copy_n(from[y], from.size.width, to);
    }
    const FlowCells& written() {
        cells_.errorsGiven = flow_.errorsGiven();
        cells_.cells.writtenOnHost(row_.rows());
        return cells_;
    }

    std::shared_ptr<Workers> workers_;
    std::shared_ptr<PairedStills> stills_;
    simd::LookUpParams lookUp_;
    simd::SubpixelFlow subpixel_;
    simd::Flow2d flow_;
    FlowCells cells_;
    AlignedRows<FlowCell> row_;
};

class SimdWeigh final : public WeighStep {
public:
    SimdWeigh(const StepSetup& setup, std::shared_ptr<PairedStills> stills)
        : SimdWeigh(setup, stillFor(setup.output, setup.rig), std::move(stills)) {}
    SimdWeigh(const StepSetup& setup, const StereoRig& stillRig,
              std::shared_ptr<PairedStills> stills)
        : weigh_(stillRig, setup.workers), fine_(stillRig, setup.workers),
          stills_(std::move(stills)),
          weights_{Field<WeighedCell>({}, setup.transfers), Field<LookUpCell>({}, setup.transfers),
                   Field<TrustCell>({}, setup.transfers)} {}

    const CellWeights& run(const LumaPyramid& luma, const FlowCells& flow,
                           const TileWork& work) override {
        if (work.changed > 0) {
            const Rows<const std::uint32_t> words = luma.words.host();
            const FlowCell* cells = flow.cells.host().data;
            const FlowCell* second = cells + flow.count();
            simd::WeighInput in{luma.video,
                                luma.still,
                                {words.data, static_cast<std::size_t>(words.size.width)},
                                {cells, flow.forward.width, flow.forward},
                                {second, flow.backward.width, flow.backward},
                                flow.backwardLevel,
                                {},
                                work};
            if (flow.errorsGiven)
                in.errors = {reinterpret_cast<const ErrorCell*>(second), flow.forward.width,
                             flow.forward};
            weigh_.run(in);
        }
        return written();
    }
    const CellWeights& confirm(const VideoFrame& frame, const StillPictures& still,
                               const TileWork& work, const FineMatch& match) override {
        if (work.changed == 0) return weights_;
        weigh_.confirm(fine_.run(frame.planes, stills_->of(still), weigh_.lookUps(),
                                 weigh_.surface(), work, match));
        return written();
    }

private:
    const CellWeights& written() {
        weights_.weighed.writtenOnHost(weigh_.weighed());
        weights_.lookUps.writtenOnHost(weigh_.lookUps());
        weights_.trust.writtenOnHost(weigh_.trust());
        return weights_;
    }

    simd::WeighStep weigh_;
    simd::FineCheck fine_;
    std::shared_ptr<PairedStills> stills_;
    CellWeights weights_;
};

class SimdDetail final : public DetailStep {
public:
    SimdDetail(const StepSetup& setup, std::shared_ptr<PairedStills> stills)
        : detail_(stillFor(setup.output, setup.rig), setup.output, setup.workers),
          stills_(std::move(stills)), picture_(setup.output), output_({}, setup.transfers) {
        output_.writtenOnHost(picture_.rows());
    }

    void draw(const VideoFrame& frame, const Matched* matched, const TileWork& work,
              const DetailOptions& options) override {
        simd::DetailInput in{frame.planes, work, {}, {}, {}, {}, {}};
        if (matched != nullptr) {
            if (options.mode == SuperResMode::Blend)
                in.picture = matched->still.picture.host();
            else
                in.still = stills_->of(matched->still);
            in.weighed = matched->weights.weighed.host();
            in.lookUps = matched->weights.lookUps.host();
            in.trust = matched->weights.trust.host();
            if (matched->second != nullptr && options.mode == SuperResMode::Detail)
                in.second = secondOf(*matched->second);
        }
        const simd::TileSummary counts =
            detail_.draw(in,
                         {options.mode, options.cubic, options.enlargedTiles, options.plainTiles,
                          options.filters},
                         picture_.rows());
        summary_ = summaryOf(counts);
        if (work.changed > 0) output_.writtenOnHost(picture_.rows());
    }
    Field<std::uint32_t>& output() override { return output_; }
    TileSummary summary() const override { return summary_; }
    std::vector<TileClass> classes() const override { return detail_.classes(); }

private:
    static TileSummary summaryOf(const simd::TileSummary& counts) {
        TileSummary out{counts.tiles};
        const double all = std::accumulate(counts.tiles.begin(), counts.tiles.end(), 0);
        out.explained = 1 - counts.unexplained / all;
        out.meanConfidence = counts.confidence / (256 * all);
        out.second = counts.second;
        return out;
    }
    simd::DetailInput::Second secondOf(const Matched& second) {
        return {stills_->of(second.still), second.weights.weighed.host(),
                second.weights.lookUps.host(), second.weights.trust.host()};
    }

    simd::DetailStep detail_;
    std::shared_ptr<PairedStills> stills_;
    AlignedRows<std::uint32_t> picture_;
    Field<std::uint32_t> output_;
    TileSummary summary_;
};

class SimdOcclusion final : public OcclusionStep {
public:
    SimdOcclusion(const StepSetup& setup, Size layer)
        : occlusion_(setup.rig.video.size, setup.output, layer, {}, setup.workers) {}

    void draw(const LayerPicture& layer, const InverseDepthField& real, const PixelRect&,
              const VideoFrame& frame, Field<std::uint32_t>& picture) override {
        occlusion_.run({layer.colour.host(), layer.depth.host(), layer.bounds},
                       simd::RealDepth::of(real), frame.planes, picture.edit());
    }
    std::vector<float> visibility() const override {
        const Rows<const std::uint8_t> rows = occlusion_.visibility();
        std::vector<float> out;
        for (int y = 0; y < rows.size.height; ++y)
            std::transform(rows[y], rows[y] + rows.size.width, std::back_inserter(out),
                           [](std::uint8_t v) { return static_cast<float>(v) / 255; });
        return out;
    }

private:
    simd::OcclusionStep occlusion_;
};

class SimdEngine final : public Engine {
public:
    explicit SimdEngine(const StepSetup& setup)
        : setup_(setup), stills_(std::make_shared<PairedStills>(setup.workers)) {}

    std::unique_ptr<StillStep> still() override { return std::make_unique<SimdStill>(setup_); }
    std::unique_ptr<PyramidStep> pyramid() override {
        return std::make_unique<SimdPyramid>(setup_);
    }
    std::unique_ptr<FlowStep> flow() override {
        return std::make_unique<SimdFlow>(setup_, stills_);
    }
    std::unique_ptr<WeighStep> weigh() override {
        return std::make_unique<SimdWeigh>(setup_, stills_);
    }
    std::unique_ptr<DetailStep> detail() override {
        return std::make_unique<SimdDetail>(setup_, stills_);
    }
    void take(const StillPictures& still) override { (void)stills_->of(still); }
    std::unique_ptr<OcclusionStep> occlusion(Size layer) override {
        return std::make_unique<SimdOcclusion>(setup_, layer);
    }
    std::unique_ptr<WarpStep> warp(const CameraModel& layer, const WarpOptions& options) override {
        return simd::makeWarpStep(layer, options, setup_.workers, setup_.transfers);
    }

private:
    StepSetup setup_;
    std::shared_ptr<PairedStills> stills_;
};

}  // namespace

std::unique_ptr<Engine> makeSimdEngine(const StepSetup& setup) {
    return std::make_unique<SimdEngine>(setup);
}

}  // namespace mfar
