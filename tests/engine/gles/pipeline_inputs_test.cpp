#include "tests/engine/gl_test.h"
#include "tests/engine/gles/pipeline_case.h"

#include <GLES2/gl2ext.h>
#include <cmath>

namespace mfar {
namespace {

using PipelineInputs = GlTest;

void expectFinite(const Pipeline& p) {
    for (const float v : p.readFlow())
        ASSERT_TRUE(std::isfinite(v));
    for (const float v : p.readConfidence())
        ASSERT_TRUE(v >= 0 && v <= 1) << v;
    const FrameStats s = p.readStats();
    for (const double v : {s.meanConfidence, s.explained, s.changed, s.redrawn})
        EXPECT_TRUE(v >= 0 && v <= 1) << v;
}

TEST_F(PipelineInputs, FramesOfAnotherSizeAreRefused) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    for (const Size wrong : {Size{160, 119}, Size{161, 120}, Size{120, 160}, Size{0, 0}})
        EXPECT_THROW(p.run(TestPicture(wrong).view(), {}), std::invalid_argument);
    EXPECT_THROW(p.run({}, {}), std::invalid_argument);
    EXPECT_THROW(p.setStill(c.video().view(), {}), std::invalid_argument);
    p.run(c.video().view(), {});
}

TEST_F(PipelineInputs, OptionsOutOfRangeAreRefused) {
    const PipelineCase c;
    PipelineOptions coarse, far;
    coarse.flow2d.levels = 0;
    far.epipolar.longestParallax = std::nan("");
    EXPECT_THROW(Pipeline(c.rig, coarse), std::invalid_argument);
    EXPECT_THROW(Pipeline(c.rig, far), std::invalid_argument);
}

// With a search radius of 4 px, a shift of 9 px can only be found at a coarser pyramid level.
TEST_F(PipelineInputs, FlowUsesTheConfiguredPyramidLevels) {
    const PipelineCase c;
    const auto errorWith = [&](int levels) {
        PipelineOptions options;
        options.flow2d.levels = levels;
        options.flow2d.searchRadius = 4;
        Pipeline p(c.rig, options);
        p.setStill(c.still().view(), {});
        p.run(c.video({9, 0}).view(), {});
        const auto flow = p.readFlow();
        const std::size_t centre = 2UL * (60 * 160 + 80);
        return std::hypot(flow[centre] - 9, flow[centre + 1]);
    };
    EXPECT_GT(errorWith(1), 1);
    EXPECT_LT(errorWith(3), 0.5);
}

TEST_F(PipelineInputs, AStillMuchNarrowerThanTheVideoGivesAnOutputOfOnePixel) {
    const TestPicture video({160, 40}, PixelFormat::Rgba8, 90),
        still({1, 7}, PixelFormat::Rgba8, 90);
    Pipeline p(plainRig(video.size, still.size), {});
    EXPECT_EQ(p.outputSize(), (Size{1, 1}));
    p.setStill(still.view(), {});
    p.run(video.view(), {});
    EXPECT_EQ(p.readImage().size(), 4U);
}

TEST_F(PipelineInputs, PicturesOfUnusualSizesAreProcessed) {
    for (const Size size : {Size{641, 479}, Size{648, 432}, Size{100, 60}, Size{61, 45}}) {
        const PipelineCase c(size);
        Pipeline p(c.rig, {});
        const TestPicture video = c.video({1.5, 0.5});
        const auto truth = c.fine(p.outputSize(), {1.5, 0.5}).bytes;
        p.run(video.view(), {});
        const double enlarged = psnr(p.readImage(), truth);
        p.setStill(c.still().view(), {});
        p.run(video.view(), {});
        EXPECT_GT(psnr(p.readImage(), truth), enlarged + 1) << size.width << "x" << size.height;
        EXPECT_EQ(p.readFlow().size(), 2UL * size.width * size.height);
        expectFinite(p);
    }
}

TEST_F(PipelineInputs, GreyPicturesInFormatsGrayAndRgbaGiveTheSameOutput) {
    const PipelineCase c;
    const auto run = [&](PixelFormat format) {
        Pipeline p(c.rig, {});
        p.setStill(c.waves.shoot(c.rig.still.size, {.step = 160.0 / 576, .format = format}).view(),
                   {});
        p.run(c.waves.shoot(c.rig.video.size, {.format = format}).view(), {});
        return p.readImage();
    };
    const auto grey = run(PixelFormat::Gray8), colour = run(PixelFormat::Rgba8);
    EXPECT_GT(psnr(grey, colour), 45);
}

TEST_F(PipelineInputs, TheFormatMayChangeFromFrameToFrame) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    for (const PixelFormat f : {PixelFormat::Gray8, PixelFormat::Rgba8, PixelFormat::Gray8}) {
        p.setStill(c.waves.shoot(c.rig.still.size, {.step = 160.0 / 576, .format = f}).view(), {});
        p.run(c.waves.shoot(c.rig.video.size, {.format = f}).view(), {});
        EXPECT_GT(p.readStats().meanConfidence, 0.7);
    }
}

TEST_F(PipelineInputs, ExtremePicturesGiveNoNan) {
    const PipelineCase c({100, 60});
    const auto extremes = [](Size s) {
        return std::vector<TestPicture>{TestPicture(s), TestPicture(s, PixelFormat::Rgba8, 255),
                                        checkerboard(s), randomPicture(s, 1)};
    };
    for (const SuperResMode mode : {SuperResMode::Detail, SuperResMode::Blend}) {
        Pipeline p(c.rig, {mode, {}, true});
        for (const TestPicture& still : extremes(c.rig.still.size)) {
            p.setStill(still.view(), {});
            for (const TestPicture& video : extremes(c.rig.video.size)) {
                p.run(video.view(), {});
                expectFinite(p);
            }
        }
    }
}

TEST_F(PipelineInputs, FlatPicturesStayFlat) {
    const PipelineCase c({100, 60});
    Pipeline p(c.rig, {});
    for (const std::uint8_t level : {0, 128, 255}) {
        p.setStill(TestPicture(c.rig.still.size, PixelFormat::Rgba8, level).view(), {});
        p.run(TestPicture(c.rig.video.size, PixelFormat::Rgba8, level).view(), {});
        const auto image = p.readImage();
        for (std::size_t i = 0; i < image.size(); i += 4)
            ASSERT_EQ(image[i], level);
        EXPECT_EQ(p.readStats().explained, 1);
    }
}

class HighMessages {
public:
    explicit HighMessages(const GlContext& gl)
        : callback_(reinterpret_cast<PFNGLDEBUGMESSAGECALLBACKKHRPROC>(find(gl, "Callback"))),
          insert_(reinterpret_cast<PFNGLDEBUGMESSAGEINSERTKHRPROC>(find(gl, "Insert"))) {
        if (!available()) return;
        glEnable(GL_DEBUG_OUTPUT_KHR);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR);
        callback_(&HighMessages::take, this);
    }
    ~HighMessages() {
        if (!available()) return;
        callback_(nullptr, nullptr);
        glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR);
        glDisable(GL_DEBUG_OUTPUT_KHR);
    }
    HighMessages(const HighMessages&) = delete;
    HighMessages& operator=(const HighMessages&) = delete;

    [[nodiscard]] bool available() const { return callback_ != nullptr && insert_ != nullptr; }
    [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }
    void insertOne() const {
        insert_(GL_DEBUG_SOURCE_APPLICATION_KHR, GL_DEBUG_TYPE_ERROR_KHR, 1,
                GL_DEBUG_SEVERITY_HIGH_KHR, -1, "inserted");
    }

private:
    static GlContext::Proc find(const GlContext& gl, const std::string& what) {
        const auto core = gl.getProcAddress(("glDebugMessage" + what).c_str());
        return core != nullptr ? core
                               : gl.getProcAddress(("glDebugMessage" + what + "KHR").c_str());
    }
    static void GL_APIENTRY take(GLenum, GLenum, GLuint, GLenum severity, GLsizei,
                                 const GLchar* text, const void* self) {
        if (severity != GL_DEBUG_SEVERITY_HIGH_KHR) return;
        const_cast<HighMessages*>(static_cast<const HighMessages*>(self))
            ->messages_.emplace_back(text);
    }

    PFNGLDEBUGMESSAGECALLBACKKHRPROC callback_;
    PFNGLDEBUGMESSAGEINSERTKHRPROC insert_;
    std::vector<std::string> messages_;
};

TEST_F(PipelineInputs, TheGpuDriverReportsNoSevereMessage) {
    HighMessages high(context());
    if (!high.available()) GTEST_SKIP() << "the GL context lacks the extension KHR_debug";
    const PipelineCase c({100, 60});
    Pipeline p(c.rig, {});
    for (const SuperResMode mode : {SuperResMode::Off, SuperResMode::Blend, SuperResMode::Detail}) {
        p.setMode(mode);
        p.setStill(c.still().view(), {});
        for (int i = 0; i < 3; ++i)
            p.run(c.video({0.4 * i, 0}).view(), {});
        static_cast<void>(p.readImage());
    }
    EXPECT_EQ(high.messages(), std::vector<std::string>{});
    high.insertOne();
    EXPECT_EQ(high.messages(), std::vector<std::string>{"inserted"});
}

}  // namespace
}  // namespace mfar
