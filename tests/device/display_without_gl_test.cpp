// Displays to which the CPU writes must call no GL function for pictures on the host, even if a GL
// library is loaded.
#include "hal/device/display_auto.h"
#include "hal/device/gl_libraries.h"
#include "hal/virtual/display_files.h"
#include "hal/virtual/image_files.h"
#include "tests/device/fake_gl.h"
#include "tests/unit/temp_folder.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <dlfcn.h>
#include <functional>

namespace mfar {
namespace {

class WithoutGl : public testing::Test {
protected:
    void SetUp() override {
        for (int y = 0; y < rows_.size().height; ++y)
            std::fill_n(rows_[y], rows_.size().width, 0xff302010U);
    }
    [[nodiscard]] Picture picture() const { return rows_.rows(); }

    /// Returns the number of GL calls that the action makes while a GL library is loaded. The
    /// action must also work before the library is loaded.
    static int callsOf(const std::function<void()>& action) {
        action();
        loadGlLibraries({MFAR_FAKE_GL, MFAR_FAKE_GL});
        void* library = dlopen(MFAR_FAKE_GL, RTLD_NOW);
        const int& calls = reinterpret_cast<FakeGl* (*)()>(dlsym(library, "fakeGl"))()->others;
        const int before = calls;
        glFlush();
        EXPECT_EQ(calls, before + 1) << "the fake GL library must count calls";
        action();
        return calls - before - 1;
    }

    AlignedRows<std::uint32_t> rows_{{64, 48}};
    test::TempFolder folder_;
};

TEST_F(WithoutGl, FileDisplaysMakeNoGlCall) {
    EXPECT_EQ(callsOf([&] {
                  for (const std::string& spec :
                       {"png:" + folder_.path().string(), "y4m:" + (folder_ / "a.y4m").string(),
                        std::string("none")}) {
                      const auto display = openFileDisplay(spec, 30);
                      display->show(picture(), {17});
                      display->showAgain(picture(), {17});
                      display->finish();
                  }
              }),
              0);
    EXPECT_EQ(loadImage(folder_ / "17.png").pixels[2], 0x30);
}

TEST_F(WithoutGl, ScalingAPictureOnTheHostMakesNoGlCall) {
    EXPECT_EQ(callsOf([&] {
                  ScreenScaler scaler;
                  for (const Size screen : {Size{64, 48}, {32, 24}, {200, 100}}) {
                      ScreenReader reader(screen, scaler);
                      reader.begin(picture());
                      int centre = 0;
                      reader.finish([&](const ImageView& view) {
                          centre = view.data[screen.height / 2 * view.stride + 2UL * screen.width];
                      });
                      EXPECT_EQ(centre, 0x10);
                      EXPECT_EQ(reader.last().size, screen);
                  }
              }),
              0);
}

class CpuScreen final : public Screen {
public:
    explicit CpuScreen(int& shown) : shown_(shown) {}
    Presence look(bool /*thorough*/) override { return Presence::Ready; }
    [[nodiscard]] Size size() const override { return {64, 48}; }
    void show(const Picture& picture) override { shown_ += picture.isOnHost() ? 1 : 0; }
    void releaseGl() override {}
    void close() override {}
    [[nodiscard]] std::string status() const override { return "cpu"; }
    [[nodiscard]] std::optional<ScreenPicture> lastShown() const override { return std::nullopt; }

private:
    int& shown_;
};

TEST_F(WithoutGl, ScreensToWhichTheCpuWritesMakeNoGlCall) {
    int shown = 0;
    EXPECT_EQ(callsOf([&] {
                  std::vector<std::unique_ptr<Screen>> screens;
                  screens.push_back(std::make_unique<CpuScreen>(shown));
                  ScreenDisplay display(std::make_unique<ScreenScaler>(), std::move(screens),
                                        &Timestamp::now, [] { return false; });
                  display.show(picture(), {1});
                  (void)display.lastShown();
                  const auto nowhere = openScreen("fbdev:/dev/fb31");
                  nowhere->show(picture(), {1});
              }),
              0);
    EXPECT_EQ(shown, 2);
}

}  // namespace
}  // namespace mfar
