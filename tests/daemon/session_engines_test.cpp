#include "daemon/exit_code.h"
#include "daemon/session_engines.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace mfar {
namespace {

/// Reports the software renderer as a GPU, because mfard does not choose a software renderer.
class PretendedGpu final : public GlContext {
public:
    void makeCurrent() override { real_->makeCurrent(); }
    void release() override { real_->release(); }
    [[nodiscard]] Proc getProcAddress(const char* name) const override {
        return real_->getProcAddress(name);
    }
    [[nodiscard]] std::optional<std::string> takeFault() override { return real_->takeFault(); }
    [[nodiscard]] bool isSoftware() const override { return false; }
    [[nodiscard]] std::string description() const override { return "a small GPU"; }

private:
    std::unique_ptr<GlContext> real_ = createGlContext();
};

EngineChoice choiceForLargeStills(const EngineConfig& engine) {
    constexpr Size kTooLarge{std::numeric_limits<int>::max(), 1728};
    const PretendedGpu gpu;
    Config config;
    config.engine = engine;
    StereoRig rig;
    rig.video.size = {640, 480};
    rig.still.size = kTooLarge;
    return chooseEngines(config, &gpu, rig, {1280, 960});
}

TEST(SessionEngines, IfStillsExceedTheLargestTextureOfTheGpuAllStepsUseSimd) {
    EXPECT_EQ(choiceForLargeStills({}), EngineChoice::all(EngineKind::Simd));
}

TEST(SessionEngines, AStepThatIsSetToGlesIsRefusedIfThePicturesAreTooLarge) {
    for (EngineWish EngineConfig::* step :
         {&EngineConfig::still, &EngineConfig::pyramid, &EngineConfig::detail}) {
        EngineConfig engine;
        engine.*step = EngineWish::Gles;
        try {
            (void)choiceForLargeStills(engine);
            FAIL() << "pictures beyond the limits of the GPU were accepted";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code, ExitCode::Unavailable);
            EXPECT_THAT(failure.what(),
                        testing::HasSubstr("too large for the textures of a small"));
        }
    }
}

}  // namespace
}  // namespace mfar
