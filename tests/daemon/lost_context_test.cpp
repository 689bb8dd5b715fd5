// A session must create a new GL context after a loss in any shader, texture upload, read or wait
// of a frame. The session's last picture must nearly equal that of a run without a loss. The tests
// use a libGLESv2 that loses contexts, see tests/device/faulty_moments.h.

#include "daemon/session.h"
#include "hal/virtual/recorder.h"
#include "tests/device/faulty_moments.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <dlfcn.h>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace mfar {
namespace {

constexpr int kFrames = 6;
/// A still that is taken with frame `frame` by a camera moved sideways by `aside` [m].
struct StillAt {
    int frame;
    double aside;
};
// Each still shows a border of the picture that the other still does not show.
constexpr std::array kStills{StillAt{1, 0.08}, StillAt{3, -0.08}};
constexpr Size kVideo{160, 120}, kStill{320, 240};

template <class F>
F* inFaultyGl(const char* name) {
    static void* const library = dlopen("libGLESv2.so.2", RTLD_NOW);
    return reinterpret_cast<F*>(dlsym(library, name));
}

StereoRig rigOf() {
    StereoRig rig;
    rig.video = {kVideo, 150, 150, 79.5, 59.5, {}};
    rig.still = {kStill, 300, 300, 159.5, 119.5, {}};
    rig.T_still_video.translation = {-0.01, 0, 0};
    return rig;
}

/// Returns the picture that a camera at `x` [m] takes of a wall one metre away.
std::vector<std::uint8_t> wall(const CameraModel& camera, double x) {
    std::vector<std::uint8_t> out;
    for (int v = 0; v < camera.size.height; ++v)
        for (int u = 0; u < camera.size.width; ++u) {
            const double wx = (u - camera.cx) / camera.fx + x, wy = (v - camera.cy) / camera.fy;
            const double wave = std::sin(97 * wx + 3 * std::sin(31 * wy)) +
                                std::sin(83 * wy - 2 * std::sin(41 * wx)) +
                                std::sin(211 * (wx + 0.7 * wy));
            out.push_back(static_cast<std::uint8_t>(128 + 38 * wave));
        }
    return out;
}

void record(const std::filesystem::path& folder, int frames) {
    const StereoRig rig = rigOf();
    Recorder recorder(folder, rig, 30);
    const auto view = [](const std::vector<std::uint8_t>& pixels, Size size) {
        return ImageView{pixels.data(), size, static_cast<std::size_t>(size.width),
                         PixelFormat::Gray8};
    };
    for (int i = 0; i < frames; ++i) {
        const Timestamp time{1'000'000'000 + i * 33'333'333LL};
        const double x = 0.004 * (i % kFrames);
        Pose pose{time, {}};
        pose.T_world_video.translation = {x, 0, 0};
        while (!recorder.video(view(wall(rig.video, x), kVideo), time))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ASSERT_TRUE(recorder.pose(pose));
        for (const StillAt& still : kStills)
            if (i == still.frame) {
                ASSERT_TRUE(recorder.still(view(wall(rig.still, x + still.aside), kStill), time));
            }
    }
    recorder.finish();
}

double meanDifference(const ScreenPicture& a, const ScreenPicture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    return sum / static_cast<double>(a.pixels.size());
}

class LostContext : public testing::Test {
protected:
    struct Ran {
        ScreenPicture last;
        Counted counted;
        std::vector<std::string> moments;
    };

    void SetUp() override {
        if (inFaultyGl<decltype(mfarFaultyGlLoseAt)>("mfarFaultyGlLoseAt") == nullptr)
            GTEST_SKIP() << "LD_LIBRARY_PATH lacks the folder of the faulty libGLESv2";
    }

    /// Configures a session that plays a recording. `virtualLayer`: keys of the section [virtual].
    void play(int frames, const std::string& virtualLayer) {
        record(folder_ / "recording", frames);
        config_ = parseConfig("[pose]\nsource = \"recorded\"\n[engine]\nuse = \"gles\"\n"
                              "[superres]\nlearn = false\n[virtual]\n" +
                                  virtualLayer +
                                  "\n[[objects]]\nshape = \"box\"\nsize = [0.2, 0.2, 0.2]\n"
                                  "position = [0.0, 0.0, 0.8]\n",
                              "test");
        config_.recording = folder_ / "recording";
        config_.display = "none";
    }

    /// Runs a session that loses its GL context at the GL call `moment`, or never if `moment` is
    /// null. The session ends a few pictures after the loss if `early` is true, otherwise at the
    /// end of the recording.
    Ran run(const char* moment, bool early = false) {
        Stats stats;
        Mailbox<Tunables> changes(HandOver::NewestWins);
        CallQueue<Session> calls;
        std::stop_source input;
        Session session(config_, stats, changes, calls, {input.get_token(), {}});
        inFaultyGl<decltype(mfarFaultyGlLoseAt)>("mfarFaultyGlLoseAt")(moment);
        const std::jthread watch([&](const std::stop_token& over) {
            std::optional<std::uint64_t> lostAt;
            while (early && !over.stop_requested()) {
                const Counted now = stats.count();
                if (now.gpuFailures > 0 && !lostAt) lostAt = now.frames;
                if (lostAt && now.frames > *lostAt + kFrames) input.request_stop();
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
        });
        (void)session.run(std::nullopt, [](const auto&, const auto&) {});
        std::set<std::string> moments;
        auto* const momentAt = inFaultyGl<decltype(mfarFaultyGlMoment)>("mfarFaultyGlMoment");
        for (int i = 0; momentAt(i) != nullptr; ++i)
            moments.insert(momentAt(i));
        return {session.snapshot(false), stats.count(), {moments.begin(), moments.end()}};
    }

    /// Runs one session for each GL call (a "moment") for which `isOne` returns true. The session
    /// loses its GL context at this call. `calls`: functions that a session must call at such
    /// moments.
    void loseAtAll(const std::function<bool(std::string_view)>& isOne,
                   const std::vector<std::string_view>& calls) {
        play(kFrames, "rendering = \"preview\"");
        const Ran whole = run(nullptr);
        ASSERT_EQ(whole.counted.gpuFailures, 0U);
        ASSERT_EQ(whole.counted.frames, kFrames);
        ASSERT_GT(whole.counted.last.showSecond, 0);
        std::map<std::string, int> losses;
        for (const std::string& moment : whole.moments) {
            if (!isOne(moment)) continue;
            ++losses[moment.substr(0, moment.find(' '))];
            SCOPED_TRACE(moment);
            const Ran with = run(moment.c_str());
            EXPECT_EQ(with.counted.gpuFailures, 1U);
            EXPECT_EQ(with.counted.frames, kFrames);
            EXPECT_TRUE(with.counted.last.usedStill);
            ASSERT_EQ(with.last.size, whole.last.size);
            EXPECT_LT(meanDifference(with.last, whole.last), 0.1);
        }
        int all = 0;
        for (const auto& [call, count] : losses)
            all += count;
        EXPECT_GT(all, 10);
        for (const std::string_view call : calls)
            EXPECT_GT(losses[std::string(call)], 0) << "no context was lost at " << call;
    }

    test::TempFolder folder_;
    Config config_;
};

TEST_F(LostContext, RecoversFromAContextLostInAnyShader) {
    loseAtAll([](std::string_view moment) { return moment.starts_with("glUseProgram"); },
              {"glUseProgram"});
}

TEST_F(LostContext, RecoversFromAContextLostInAnyTextureUploadReadOrWait) {
    loseAtAll(
        [](std::string_view moment) {
            return std::ranges::none_of(
                std::array{"glUseProgram", "glBufferSubData", "glDispatchCompute", "glDrawArrays"},
                [&](const char* other) { return moment.starts_with(other); });
        },
        {"glGenTextures", "glTexSubImage2D", "glMapBufferRange", "glReadPixels", "glFenceSync",
         "glClientWaitSync"});
}

// Warping starts once the path tracer has a picture of the objects.
TEST_F(LostContext, RecoversFromAContextLostDuringTheWarp) {
    constexpr int kSeconds = 12;
    play(30 * kSeconds,
         "rendering = \"path-traced\"\nresolution = 0.3\nsamples = 1\nbudget_ms = 30");
    config_.pace = SourcePace::Realtime;
    for (const char* shader : {"warp_silhouette.frag", "warp_fill.comp", "warp_look_up.frag"}) {
        SCOPED_TRACE(shader);
        const Ran with = run(("glUseProgram " + std::string(shader)).c_str(), true);
        EXPECT_EQ(with.counted.gpuFailures, 1U);
        EXPECT_TRUE(with.counted.last.usedStill);
    }
}

}  // namespace
}  // namespace mfar
