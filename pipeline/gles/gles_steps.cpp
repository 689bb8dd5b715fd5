#include "pipeline/gles/gles_steps.h"

#include "pipeline/gles/cell_weigher.h"
#include "pipeline/gles/detail_painter.h"
#include "pipeline/gles/device_copies.h"
#include "pipeline/gles/direct_matcher.h"
#include "pipeline/gles/fine_check.h"
#include "pipeline/gles/flow2d.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/still_reference.h"
#include "pipeline/gles/subpixel_corrector.h"
#include "pipeline/simd/luma_rows.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace mfar::gles {
namespace {

/// Returns the still's luma with amplified finest detail. If the SIMD engine prepared the still,
/// the texture has a second channel: the luma of the pixel below.
const gpu::Texture& raisedOf(const StillPictures& still) {
    const auto linear = gpu::Filter::Linear;
    return still.raised.isEmpty() ? textureOf(still.pairs, gpu::TexelFormat::Rg8, linear).texture()
                                  : textureOf(still.raised, gpu::TexelFormat::R8, linear).texture();
}

/// The GPU's copy of StillPictures::luma. Its texture is the still in colour; download() computes
/// the luma and applies the tone curve.
class StillLumaCopy final : public DeviceCopy {
public:
    StillLumaCopy(const gpu::PictureTexture& picture, const ToneTexture& tone)
        : picture_(picture), tone_(tone) {}

    [[nodiscard]] const gpu::Texture& texture() const { return picture_.texture(); }
    void upload(const void*, std::ptrdiff_t) override {
        assert(!"a still's luma cannot be uploaded, because it is computed from its colours");
    }
    [[nodiscard]] const ToneTexture& tone() const { return tone_; }
    /// Sets the still's format, which determines the order of the channels that download() reads
    /// back.
    void setFormat(PixelFormat format) { format_ = format; }
    std::size_t download(void* data, std::ptrdiff_t pitch) override {
        const std::vector<std::uint8_t> rgba = texture().readRgba8();
        const auto [width, height] = texture().size();
        for (int y = 0; y < height; ++y) {
            std::uint8_t* row = static_cast<std::uint8_t*>(data) + y * pitch;
            const std::uint8_t* texels = rgba.data() + 4UL * y * width;
            if (format_ == PixelFormat::Gray8)
                for (int x = 0; x < width; ++x)
                    row[x] = texels[4UL * x];
            else
                simd::lumaRow(texels, format_ == PixelFormat::Bgra8,
                              static_cast<std::size_t>(width), row);
            tone_.tone().apply({row, static_cast<std::size_t>(width)});
        }
        return rgba.size();
    }

private:
    PixelFormat format_ = PixelFormat::Rgba8;
    const gpu::PictureTexture& picture_;
    const ToneTexture& tone_;
};

/// The GPU's copy of StillPictures::picture. The texture of a picture that is not reduced has the
/// channels of the still's format.
class StillPictureCopy final : public TextureCopy {
public:
    StillPictureCopy(const gpu::Texture& picture, PixelFormat format)
        : TextureCopy(picture), format_(format) {}

    std::size_t download(void* data, std::ptrdiff_t pitch) override {
        const std::vector<std::uint8_t> read = texture().readRgba8();
        const auto [width, height] = texture().size();
        for (int y = 0; y < height; ++y) {
            std::uint8_t* row = static_cast<std::uint8_t*>(data) + y * pitch;
            std::copy_n(read.data() + 4UL * y * width, 4UL * width, row);
            for (std::uint8_t* pixel = row; pixel < row + 4UL * width; pixel += 4) {
                if (format_ == PixelFormat::Bgra8) std::swap(pixel[0], pixel[2]);
                if (format_ == PixelFormat::Gray8) pixel[1] = pixel[2] = pixel[0];
            }
        }
        return read.size();
    }

private:
    PixelFormat format_;
};

class GlesStill final : public StillStep {
public:
    GlesStill(const StepSetup& setup, FrameOnGpu& frame)
        : still_(setup.rig, setup.output, frame.stillPicture()),
          lumaCopy_(frame.stillPicture(), still_.tone()), raisedCopy_(still_.raised()) {
        pictures_.rig = still_.rig();
        pictures_.luma = Field<std::uint8_t>({}, setup.transfers);
    }

    const StillPictures& run(const ImageView& still, SuperResMode, const StillTone& tone,
                             double noise) override {
        still_.set(still, tone, noise);
        lumaCopy_.setFormat(still.format);
        pictures_.tone = tone;
        ++pictures_.number;
        const bool isReduced = &still_.picture() != &still_.whole();
        pictureCopy_.emplace(still_.picture(), isReduced ? PixelFormat::Rgba8 : still.format);
        pictures_.luma.writtenOnDevice(lumaCopy_, still_.whole().size());
        pictures_.raised.writtenOnDevice(raisedCopy_, still_.raised().size());
        pictures_.picture.writtenOnDevice(*pictureCopy_, still_.picture().size());
        return pictures_;
    }
    void setMode(SuperResMode) override {}

private:
    StillReference still_;
    StillLumaCopy lumaCopy_;
    TextureCopy raisedCopy_;
    // Created again for each still, because the next still can be in another texture.
    std::optional<StillPictureCopy> pictureCopy_;
    StillPictures pictures_;
};

class GlesPyramid final : public PyramidStep {
public:
    GlesPyramid(const StepSetup& setup, FrameOnGpu& frame)
        : rig_(setup.rig), frame_(frame), pyramids_(setup.rig.video.size),
          words_(static_cast<int>(pyramids_.words().bytes() / sizeof(std::uint32_t))),
          copy_(pyramids_.words(), 0, static_cast<std::size_t>(words_), sizeof(std::uint32_t)),
          luma_{pyramids_.video(), pyramids_.still(),
                Field<std::uint32_t>({words_, 1}, setup.transfers)} {}

    const LumaPyramid& video(const VideoFrame& frame, const TileWork& work) override {
        if (work.matched > 0) pyramids_.buildVideo(frame_.video(frame));
        return written();
    }
    const LumaPyramid& still(const StillPictures& still, float light) override {
        DeviceCopy& copy = still.luma.device([&] {
            return std::make_unique<TextureCopy>(still.luma.size(), gpu::TexelFormat::R8,
                                                 gpu::Filter::Linear);
        });
        // If the SIMD engine prepared the still, `copy` is a texture of the still's luma, to which
        // the tone curve is already applied. The shaders read this texture as a grey picture.
        if (const auto* own = dynamic_cast<const StillLumaCopy*>(&copy))
            pyramids_.buildStill(own->texture(), own->tone(), rig_, light);
        else
            pyramids_.buildStill(static_cast<const TextureCopy&>(copy).texture(), untoned_, rig_,
                                 light);
        return written();
    }

private:
    const LumaPyramid& written() {
        luma_.words.writtenOnDevice(copy_, {words_, 1});
        return luma_;
    }

    StereoRig rig_;
    FrameOnGpu& frame_;
    ToneTexture untoned_;
    LumaPyramids pyramids_;
    int words_;
    BufferCopy copy_;
    LumaPyramid luma_;
};

class GlesFlow final : public FlowStep {
public:
    GlesFlow(const StepSetup& setup, const StereoRig& stillRig, FrameOnGpu& frame)
        : frame_(frame), flow_(setup.rig.video.size, setup.flow2d), direct_(stillRig),
          subpixel_(stillRig),
          entries_(2 * flow_.forward().cells.width * flow_.forward().cells.height),
          copy_(flow_.cells(), flow_.forward().offset, static_cast<std::size_t>(entries_),
                sizeof(FlowCell)),
          cells_{Field<FlowCell>({entries_, 1}, setup.transfers), flow_.forward().cells,
                 flow_.backward().cells, flow_.backward().level, false} {}

    void setOptions(const Flow2dOptions& options) override { flow_.setOptions(options); }
    const FlowCells& run(const Pictures& pictures, const LumaPyramid& luma, const TileWork& work,
                         bool usePrior) override {
        flow_.run(lumaOf(luma), frame_.tiles(work), usePrior);
        correct(pictures, work, -1);
        return written();
    }
    const FlowCells& refine(const Pictures& pictures, const LumaPyramid& luma, const TileWork& work,
                            const AlongLines& along, bool /*usePrior*/) override {
        const TileBuffer& tiles = frame_.tiles(work);
        flow_.refine(lumaOf(luma), tiles, along.vectors, along.errors);
        if (work.matched > 0)
            direct_.run(flow_.cells(),
                        {flow_.forward().offset, flow_.seed(), flow_.backward().offset},
                        frame_.video(pictures.video), raisedOf(pictures.still), tiles);
        correct(pictures, work, flow_.backward().offset);
        return written();
    }
    std::vector<bool> searchedTiles() const override { return flow_.searched().read(); }
    int searchedCount() const override { return flow_.searched().count(); }
    int finishedSearchedCount() const override { return flow_.searched().countBefore(); }

private:
    static LumaOnGpu lumaOf(const LumaPyramid& luma) {
        return {luma.video, luma.still, bufferOf(luma.words).buffer()};
    }
    void correct(const Pictures& pictures, const TileWork& work, int errors) {
        if (work.matched > 0)
            subpixel_.run(flow_.cells(), {flow_.forward().offset, errors},
                          frame_.video(pictures.video), raisedOf(pictures.still), pictures.light,
                          frame_.tiles(work));
    }
    const FlowCells& written() {
        cells_.errorsGiven = flow_.errorsGiven();
        cells_.cells.writtenOnDevice(copy_, {entries_, 1});
        return cells_;
    }

    FrameOnGpu& frame_;
    Flow2d flow_;
    DirectMatcher direct_;
    SubpixelCorrector subpixel_;
    int entries_;
    BufferCopy copy_;
    FlowCells cells_;
};

class GlesWeigh final : public WeighStep {
public:
    GlesWeigh(const StepSetup& setup, const StereoRig& stillRig, FrameOnGpu& frame)
        : frame_(frame), weigher_(stillRig),
          copies_(weigher_.weighed(), weigher_.lookUps(), weigher_.trust()), fine_(stillRig),
          fineCopies_(fine_.weights().weighed, fine_.weights().lookUps, fine_.weights().trust),
          weights_{Field<WeighedCell>({}, setup.transfers), Field<LookUpCell>({}, setup.transfers),
                   Field<TrustCell>({}, setup.transfers)} {}

    const CellWeights& run(const LumaPyramid& luma, const FlowCells& flow,
                           const TileWork& work) override {
        if (work.changed > 0) {
            const BufferCopy& cells = bufferOf(flow.cells);
            weigher_.run({luma.video, luma.still, bufferOf(luma.words).buffer(), cells.buffer(),
                          cells.first(), flow.forward, flow.backward, flow.backwardLevel,
                          flow.errorsGiven},
                         frame_.tiles(work));
            fineIsOld_ = true;
        }
        return written(copies_);
    }
    const CellWeights& confirm(const VideoFrame& frame, const StillPictures& still,
                               const TileWork& work, const FineMatch& match) override {
        if (work.changed > 0) {
            fine_.run(frame_.video(frame), raisedOf(still),
                      {weigher_.weighed(), weigher_.lookUps(), weigher_.trust()},
                      weigher_.statistics(), frame_.tiles(work), match);
            fineIsOld_ = false;
        }
        return written(fineIsOld_ ? copies_ : fineCopies_);
    }

private:
    struct Copies {
        Copies(const gpu::Texture& weighedIn, const gpu::Texture& lookUpsIn,
               const gpu::Texture& trustIn)
            : weighed(weighedIn), lookUps(lookUpsIn), trust(trustIn, true) {}
        TextureCopy weighed, lookUps, trust;
    };
    const CellWeights& written(Copies& copies) {
        const Size cells = weigher_.weighed().size();
        weights_.weighed.writtenOnDevice(copies.weighed, cells);
        weights_.lookUps.writtenOnDevice(copies.lookUps, cells);
        weights_.trust.writtenOnDevice(copies.trust, cells);
        return weights_;
    }

    FrameOnGpu& frame_;
    CellWeigher weigher_;
    Copies copies_;
    FineCheck fine_;
    Copies fineCopies_;
    bool fineIsOld_ = true;  // true if fineCopies_ does not belong to the last changed frame
    CellWeights weights_;
};

class GlesDetail final : public DetailStep {
public:
    GlesDetail(const StepSetup& setup, const StereoRig& stillRig, FrameOnGpu& frame)
        : frame_(frame), painter_(stillRig, setup.output), copy_(painter_.output()),
          output_({}, setup.transfers) {
        output_.writtenOnDevice(copy_, setup.output);
    }

    void draw(const VideoFrame& frame, const Matched* matched, const TileWork& work,
              const DetailOptions& options) override {
        const TileBuffer& tiles = frame_.tiles(work);
        // If no tile has changed, the shaders do not read the video. The output is passed instead,
        // so that the video need not be uploaded.
        const gpu::Texture& video = work.changed > 0 ? frame_.video(frame) : painter_.output();
        if (matched == nullptr) {
            painter_.draw(video, nullptr, tiles, options);
        } else {
            DetailPainter::Matched on = texturesOf(*matched, options.mode);
            std::optional<DetailPainter::Matched> second;
            if (matched->second != nullptr)
                on.second = &second.emplace(texturesOf(*matched->second, options.mode));
            painter_.draw(video, &on, tiles, options);
        }
        if (work.changed > 0) output_.writtenOnDevice(copy_, painter_.output().size());
    }
    Field<std::uint32_t>& output() override { return output_; }
    TileSummary summary() const override { return painter_.summaryNow(); }
    TileSummary finishedSummary() const override { return painter_.summaryBefore(); }
    std::vector<TileClass> classes() const override { return painter_.readClasses(); }

private:
    static DetailPainter::Matched texturesOf(const Matched& matched, SuperResMode mode) {
        const auto linear = gpu::Filter::Linear;
        const StillPictures& still = matched.still;
        const CellWeights& weights = matched.weights;
        return {mode == SuperResMode::Blend
                    ? textureOf(still.picture, gpu::TexelFormat::Rgba8, linear).texture()
                    : raisedOf(still),
                textureOf(weights.weighed, gpu::TexelFormat::Rgba32F).texture(),
                textureOf(weights.lookUps, gpu::TexelFormat::Rgba16F, linear).texture(),
                textureOf(weights.trust, gpu::TexelFormat::Rgba8, linear, true).texture()};
    }

    FrameOnGpu& frame_;
    DetailPainter painter_;
    TextureCopy copy_;
    Field<std::uint32_t> output_;
};

}  // namespace

const gpu::Texture& FrameOnGpu::video(const VideoFrame& frame) {
    if (number_ != frame.number) video_.upload(frame.view);
    number_ = frame.number;
    return video_.texture();
}

const TileBuffer& FrameOnGpu::tiles(const TileWork& work) {
    if (!tiles_[used_].holds(work)) used_ = 1 - used_;
    tiles_[used_].set(work);
    return tiles_[used_];
}

void FrameOnGpu::setImporter(PlaneImporter* importer) {
    video_.setImporter(importer);
    still_.setImporter(importer);
}

std::optional<std::string> FrameOnGpu::takeImportFault() {
    std::optional<std::string> fault = video_.takeImportFault();
    return fault ? fault : still_.takeImportFault();
}

std::unique_ptr<StillStep> makeStillStep(const StepSetup& setup, FrameOnGpu& frame) {
    return std::make_unique<GlesStill>(setup, frame);
}

std::unique_ptr<PyramidStep> makePyramidStep(const StepSetup& setup, FrameOnGpu& frame) {
    return std::make_unique<GlesPyramid>(setup, frame);
}

std::unique_ptr<FlowStep> makeFlowStep(const StepSetup& setup, const StereoRig& stillRig,
                                       FrameOnGpu& frame) {
    return std::make_unique<GlesFlow>(setup, stillRig, frame);
}

std::unique_ptr<WeighStep> makeWeighStep(const StepSetup& setup, const StereoRig& stillRig,
                                         FrameOnGpu& frame) {
    return std::make_unique<GlesWeigh>(setup, stillRig, frame);
}

std::unique_ptr<DetailStep> makeDetailStep(const StepSetup& setup, const StereoRig& stillRig,
                                           FrameOnGpu& frame) {
    return std::make_unique<GlesDetail>(setup, stillRig, frame);
}

}  // namespace mfar::gles
