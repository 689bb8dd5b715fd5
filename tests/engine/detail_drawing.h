#pragma once

#include "base/workers.h"
#include "pipeline/engine/engine.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/simd/detail_oracle.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace mfar {

using simd::DetailCase;

/// The engines that compute the detail and the still's pictures.
struct StepEngines {
    EngineKind detail, still;
};

/// Tests of the detail step, with each engine for it and for the still's pictures.
class DetailEngineTest : public GlTest, public testing::WithParamInterface<StepEngines> {
public:
    static auto everyPair() {
        return testing::Values(StepEngines{EngineKind::Gles, EngineKind::Gles},
                               StepEngines{EngineKind::Gles, EngineKind::Simd},
                               StepEngines{EngineKind::Simd, EngineKind::Gles},
                               StepEngines{EngineKind::Simd, EngineKind::Simd});
    }
    static std::string nameOfPair(const testing::TestParamInfo<StepEngines>& tested) {
        return std::string(nameOf(tested.param.detail)) + "_still_" +
               std::string(nameOf(tested.param.still));
    }
};

/// Reduces the contrast, so that no value leaves a byte's range when the video is enlarged along
/// columns: shaders would clamp it there, but the oracle does not.
inline DetailCase withRoom(DetailCase frame) {
    for (std::vector<std::uint8_t>* pixels : {&frame.videoPixels, &frame.stillPixels})
        for (std::uint8_t& byte : *pixels)
            byte = static_cast<std::uint8_t>(51 + byte * 3 / 5);
    frame.video.take(frame.videoView());
    return frame;
}

/// Draws frames with a detail step that keeps its state from frame to frame.
class Drawing {
public:
    Drawing(const StepEngines& engines, const DetailCase& first, Size output)
        : setup_{first.rig, output, {}, std::make_shared<Workers>(2)},
          stillEngine_(engineOf(engines.still)), detailEngine_(engineOf(engines.detail)),
          still_(stillEngine_->still()), step_(detailEngine_->detail()),
          pictures_(still_->run(first.stillView(), SuperResMode::Detail, {}, 0)) {}

    Rows<const std::uint32_t> draw(const DetailCase& frame, const FilterBank* filters = nullptr) {
        const CellWeights weights = weightsOf(frame);
        const DetailStep::Matched matched{pictures_, weights};
        return draw(frame, &matched, filters);
    }
    Rows<const std::uint32_t> drawBoth(const DetailCase& frame, const DetailCase& second,
                                       const FilterBank* filters) {
        if (!secondStill_) secondStill_ = stillEngine_->still();
        const StillPictures& pictures =
            secondStill_->run(second.stillView(), SuperResMode::Detail, {}, 0);
        const CellWeights weights = weightsOf(frame), secondWeights = weightsOf(second);
        const DetailStep::Matched other{pictures, secondWeights},
            matched{pictures_, weights, &other};
        return draw(frame, &matched, filters);
    }
    [[nodiscard]] TileSummary summary() const { return step_->summary(); }
    Rows<const std::uint32_t> drawWithoutStill(const DetailCase& frame, const FilterBank* filters) {
        return draw(frame, nullptr, filters);
    }
    [[nodiscard]] twin::Grey luma() const {
        if (!pictures_.raised.isEmpty()) {
            const Rows<const std::uint8_t> raised = pictures_.raised.host();
            return twin::greyOf(raised.size, [&](int x, int y) { return double(raised[y][x]); });
        }
        const Rows<const std::uint16_t> pairs = pictures_.pairs.host();
        return twin::greyOf(pairs.size, [&](int x, int y) { return double(pairs[y][x] & 255); });
    }

private:
    Rows<const std::uint32_t> draw(const DetailCase& frame, const DetailStep::Matched* matched,
                                   const FilterBank* filters) {
        const ImageView view = frame.videoView();
        step_->draw({view, frame.video, ++number_}, matched, frame.work,
                    {.mode = SuperResMode::Detail,
                     .enlargedTiles = false,
                     .plainTiles = false,
                     .filters = filters});
        return step_->output().host();
    }
    static CellWeights weightsOf(const DetailCase& frame) {
        CellWeights out;
        out.weighed.writtenOnHost(rowsOf(frame.weighed, frame.cells));
        out.lookUps.writtenOnHost(rowsOf(frame.lookUps, frame.cells));
        out.trust.writtenOnHost(rowsOf(frame.trust, frame.cells));
        return out;
    }
    template <class T>
    static Rows<const T> rowsOf(const std::vector<T>& cells, Size size) {
        return {cells.data(), size.width, size};
    }
    [[nodiscard]] std::unique_ptr<Engine> engineOf(EngineKind kind) const {
        return kind == EngineKind::Gles ? makeGlesEngine(setup_) : makeSimdEngine(setup_);
    }

    StepSetup setup_;
    std::unique_ptr<Engine> stillEngine_, detailEngine_;
    std::unique_ptr<StillStep> still_, secondStill_;
    std::unique_ptr<DetailStep> step_;
    const StillPictures& pictures_;
    std::uint64_t number_ = 0;
};

inline std::vector<std::uint32_t> copyOf(Rows<const std::uint32_t> picture) {
    std::vector<std::uint32_t> out;
    for (int y = 0; y < picture.size.height; ++y)
        out.insert(out.end(), picture[y], picture[y] + picture.size.width);
    return out;
}

inline double channel(Rows<const std::uint32_t> picture, int x, int y, int c) {
    return static_cast<double>(picture[y][x] >> (8 * c) & 255U);
}

}  // namespace mfar
