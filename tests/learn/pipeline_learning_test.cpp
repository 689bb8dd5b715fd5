#include "pipeline/pipeline.h"
#include "tests/engine/gl_test.h"
#include "tests/learn/sensor_pair.h"

namespace mfar {
namespace {

struct Heard final : MatchListener {
    int times = 0, replacements = 0;
    int weighed = 0;  ///< cells of all reports with a weight above 0.5
    // Values of the last report by replaced(): number of such cells, a level of the video and one
    // of the still.
    int lastWeighed = 0, lastLuma = -1, lastStill = -1;
    void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                  Rows<const LookUpCell> lookUps,
                  const MatchedPictures::LookedUp& lookedUp) override {
        const int before = weighed;
        matched(video, still, lookUps, lookedUp);
        --times;
        ++replacements;
        lastWeighed = weighed - before;
        lastLuma = video.row(1, 0)[0];
        lastStill = still[300][400];
    }
    void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                 Rows<const LookUpCell> lookUps,
                 const MatchedPictures::LookedUp& lookedUp) override {
        ++times;
        EXPECT_EQ(video.size(), kDiscsVideo);
        EXPECT_EQ(still.size, kDiscsStill);
        EXPECT_NEAR(lookedUp.scaleX * still.size.width / lookedUp.size.width, 4, 1e-6);
        for (int y = 0; y < lookUps.size.height; ++y)
            for (int x = 0; x < lookUps.size.width; ++x)
                weighed += lookUps[y][x].weight > 0.5F;
    }
};

class PipelineLearning : public GlTest, public testing::WithParamInterface<EngineKind> {
protected:
    PipelineLearning()
        : current_(makeCurrent()), still_(sharp_.values.begin(), sharp_.values.end()),
          video_(low_.values.begin(), low_.values.end()), pipeline_(made()), other_(made()) {}

    // The context must be current before the pipelines are created.
    static bool makeCurrent() {
        context().makeCurrent();
        return true;
    }
    static Pipeline made() {
        return {discsRig(), {.output = {}, .engines = EngineChoice::all(GetParam())}};
    }
    void setStill(Pipeline& pipeline) const { setStill(pipeline, still_); }
    void setStill(Pipeline& pipeline, const std::vector<std::uint8_t>& still) const {
        pipeline.setStill(
            {still.data(), sharp_.size, std::size_t(sharp_.size.width), PixelFormat::Gray8}, {});
    }
    std::vector<std::uint8_t> picture(Pipeline& pipeline) const {
        return picture(pipeline, video_);
    }
    std::vector<std::uint8_t> picture(Pipeline& pipeline,
                                      const std::vector<std::uint8_t>& video) const {
        pipeline.redraw();
        pipeline.run({video.data(), low_.size, std::size_t(low_.size.width), PixelFormat::Gray8},
                     {});
        return pipeline.readImage();
    }
    bool alike() { return picture(pipeline_) == picture(other_); }

    bool current_;
    const twin::Grey sharp_ = sharpDiscs(1), low_ = videoOf(sharp_, {});
    const std::vector<std::uint8_t> still_, video_;
    Pipeline pipeline_, other_;
};

INSTANTIATE_TEST_SUITE_P(Engines, PipelineLearning,
                         testing::Values(EngineKind::Gles, EngineKind::Simd),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

TEST_P(PipelineLearning, EachMatchedStillIsReportedOnce) {
    Heard heard;
    pipeline_.setMatchListener(&heard);
    (void)picture(pipeline_);
    EXPECT_EQ(heard.times, 0) << "without a still, the listener must not be called";
    setStill(pipeline_);
    EXPECT_EQ(heard.times, 0) << "without a frame, the listener must not be called";
    (void)picture(pipeline_);
    (void)picture(pipeline_);
    EXPECT_EQ(heard.times, 1);
    EXPECT_GT(heard.weighed, 1000) << "more than 1000 of 3072 cells must have a weight above 0.5";
    setStill(pipeline_);
    (void)picture(pipeline_);
    EXPECT_EQ(heard.times, 2);
    pipeline_.setMode(SuperResMode::Off);
    setStill(pipeline_);
    (void)picture(pipeline_);
    pipeline_.setMatchListener(nullptr);
    pipeline_.setMode(SuperResMode::Detail);
    (void)picture(pipeline_);
    EXPECT_EQ(heard.times, 2);
}

TEST_P(PipelineLearning, AStillIsReportedOnlyAfterAFrameWithMatchedTiles) {
    Heard heard;
    pipeline_.setMatchListener(&heard);
    setStill(pipeline_);
    const std::vector<std::uint8_t> dark(video_.size(), 3);
    pipeline_.run({dark.data(), low_.size, std::size_t(low_.size.width), PixelFormat::Gray8}, {});
    EXPECT_EQ(heard.times, 0);
    (void)picture(pipeline_);
    EXPECT_EQ(heard.times, 1);
    EXPECT_GT(heard.weighed, 1000) << "more than 1000 of 3072 cells must have a weight above 0.5";
}

TEST_P(PipelineLearning, ReplacedStillIsReportedWithTheLastFrame) {
    // The last frame and the new still differ from the others.
    std::vector<std::uint8_t> last = video_, dark = still_;
    last[0] = static_cast<std::uint8_t>(last[0] < 128 ? last[0] + 20 : last[0] - 20);
    for (std::uint8_t& level : dark)
        level /= 2;
    Heard heard;
    pipeline_.setMatchListener(&heard);
    setStill(pipeline_);
    setStill(pipeline_);
    EXPECT_EQ(heard.replacements, 0)
        << "a still that no frame was matched with must not be reported";
    (void)picture(pipeline_);
    (void)picture(pipeline_, last);
    EXPECT_EQ(heard.replacements, 0);
    setStill(pipeline_, dark);
    EXPECT_EQ(heard.replacements, 1);
    EXPECT_EQ(heard.lastLuma, last[0]);
    EXPECT_NEAR(heard.lastStill, sharp_.at(400, 300), 1) << "the old still must be reported";
    EXPECT_GT(heard.lastWeighed, 1000)
        << "more than 1000 of 3072 cells must have a weight above 0.5";
    pipeline_.dropStill();
    setStill(pipeline_);
    pipeline_.setMode(SuperResMode::Off);
    setStill(pipeline_);
    EXPECT_EQ(heard.replacements, 1);
}

TEST_P(PipelineLearning, TheToneCurveInTheFilterBankIsAppliedToStills) {
    struct Luma final : MatchListener {
        void matched(const RgbPlanes&, Rows<const std::uint8_t> still, Rows<const LookUpCell>,
                     const MatchedPictures::LookedUp& lookedUp) override {
            level = still[300][400];
            tone = lookedUp.tone;
        }
        int level = -1;
        StillTone tone;
    } heard;
    StillTone inverted;
    for (std::uint8_t& level : inverted.levels)
        level = static_cast<std::uint8_t>(255 - level);
    pipeline_.setFilters(std::make_shared<const FilterBank>(
        std::vector<FilterBank::Filter>(enlarge::kUnique, FilterBank::Filter{}), Guidance{},
        FineMatch{}, inverted));
    pipeline_.setMatchListener(&heard);
    setStill(pipeline_);
    (void)picture(pipeline_);
    EXPECT_EQ(heard.tone, inverted);
    EXPECT_NEAR(heard.level, 255 - sharp_.at(400, 300), 1);
}

TEST_P(PipelineLearning, NewFiltersTakeEffectAtTheNextStillOrAtOnceIfThereIsNoStill) {
    const auto none = std::make_shared<const FilterBank>(
        std::vector<FilterBank::Filter>(enlarge::kUnique, FilterBank::Filter{}));
    pipeline_.setFilters(none);
    EXPECT_FALSE(alike());
    pipeline_.setFilters(nullptr);
    EXPECT_TRUE(alike());

    for (Pipeline* one : {&pipeline_, &other_})
        setStill(*one);
    EXPECT_TRUE(alike());
    pipeline_.setFilters(none);
    EXPECT_TRUE(alike());
    for (Pipeline* one : {&pipeline_, &other_})
        setStill(*one);
    EXPECT_FALSE(alike());
}

}  // namespace
}  // namespace mfar
