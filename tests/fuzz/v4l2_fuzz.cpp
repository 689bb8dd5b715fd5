// Fuzzes CameraV4l2 with a driver that gives arbitrary answers. The input is the script of these
// answers.
#include "base/image_layout.h"
#include "hal/device/camera_v4l2.h"
#include "tests/fuzz/scripted_v4l2.h"
#include "tests/fuzz/target.h"

namespace {

using namespace mfar;

void run(test::ScriptedV4l2& driver) {
    CameraV4l2 camera({.device = {"/dev/video0"},
                       .wish = {{64, 48}, 30, ""},
                       .buffers = 3,
                       .controls = {{"gain", "7"}, {"mode", "manual"}}},
                      driver);
    for (const V4l2Control& control : camera.controls().list())
        static_cast<void>(describe(control));
    camera.start();
    std::vector<Frame> held;
    for (int i = 0; i < 4; ++i)
        if (auto frame = camera.next(std::chrono::milliseconds(0))) {
            requireSound(frame->view(), "a camera's picture");
            const ImageView view = frame->view();
            const std::uint8_t last = view.data[view.stride * (view.size.height - 1U)];
            static_cast<void>(last);
            held.push_back(std::move(*frame));
        }
    camera.stop();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    test::ScriptedV4l2 driver({data, size});
    try {
        run(driver);
    } catch (const std::runtime_error&) {
        return 0;
    }
    return 0;
}
