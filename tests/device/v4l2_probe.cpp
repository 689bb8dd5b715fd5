// Captures from a real V4L2 device. Lists its controls, sets the given ones, and prints a line for
// each frame.
//
//   v4l2-probe DEVICE WIDTHxHEIGHT FRAMES [--format FOURCC] [--rate HZ] [NAME=VALUE]...
//
// Exit status: 0 all frames arrived, 1 some did not, 2 the device refused a request or was lost,
// 64 wrong usage.
#include "base/image_layout.h"
#include "hal/device/camera_v4l2.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

using namespace std::chrono_literals;

constexpr int kUsage = 64;

double meanLuma(const mfar::ImageView& view) {
    const bool colour = mfar::bytesPerPixel(view.format) == 4;
    const auto step = static_cast<std::size_t>(mfar::bytesPerPixel(view.format));
    double sum = 0;
    for (int y = 0; y < view.size.height; ++y) {
        const std::uint8_t* p = view.data + static_cast<std::size_t>(y) * view.stride;
        for (int x = 0; x < view.size.width; ++x, p += step)
            sum += colour ? (p[0] + 2 * p[1] + p[2]) / 4.0 : p[0];  // green counts half
    }
    return sum / view.size.width / view.size.height;
}

int capture(mfar::CameraV4l2& camera, int frames) {
    camera.start();
    int got = 0, empty = 0;
    while (got < frames && empty < 5) {
        const auto frame = camera.next(1s);
        if (!frame) {
            ++empty;
            continue;
        }
        ++got;
        const auto& view = frame->view();
        std::printf("frame %d time %.6f size %dx%d format %s luma %.2f\n", got,
                    frame->time().seconds(), view.size.width, view.size.height,
                    std::string(mfar::nameOf(view.format)).c_str(), meanLuma(view));
    }
    camera.stop();
    const mfar::CameraCounters counts = camera.cameraCounters();
    std::printf("delivered %llu broken %llu bad-times %llu missed %llu\n",
                static_cast<unsigned long long>(counts.delivered),
                static_cast<unsigned long long>(counts.broken),
                static_cast<unsigned long long>(counts.badTimes),
                static_cast<unsigned long long>(counts.missed.value_or(0)));
    return got == frames ? 0 : 1;
}

bool parse(int argc, char** argv, mfar::CameraV4l2Options& options, int& frames) {
    if (argc < 4) return false;
    options.device.name = argv[1];
    if (std::sscanf(argv[2], "%dx%d", &options.wish.size.width, &options.wish.size.height) != 2)
        return false;
    frames = std::atoi(argv[3]);
    for (int i = 4; i < argc; ++i) {
        const std::string argument = argv[i];
        const std::size_t equals = argument.find('=');
        if (argument == "--format" && i + 1 < argc)
            options.wish.format = argv[++i];
        else if (argument == "--rate" && i + 1 < argc)
            options.wish.rateHz = std::atof(argv[++i]);
        else if (equals != std::string::npos)
            options.controls.emplace_back(argument.substr(0, equals), argument.substr(equals + 1));
        else
            return false;
    }
    return frames >= 0;
}

}  // namespace

int main(int argc, char** argv) {
    mfar::CameraV4l2Options options;
    int frames = 0;
    if (!parse(argc, argv, options, frames)) {
        std::fputs("usage: v4l2-probe DEVICE WIDTHxHEIGHT FRAMES [--format FOURCC] [--rate HZ] "
                   "[NAME=VALUE]...\n",
                   stderr);
        return kUsage;
    }
    try {
        mfar::CameraV4l2 camera(options);
        const mfar::CameraInfo info = camera.info();
        std::printf("camera %s at %.3f Hz\n", info.name.c_str(), info.rateHz);
        for (const mfar::V4l2Control& control : camera.controls().list())
            std::printf("control %s\n", mfar::describe(control).c_str());
        for (const auto& [name, value] : options.controls)
            std::printf("set %s = %s\n", name.c_str(), value.c_str());
        return capture(camera, frames);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "v4l2-probe: %s\n", e.what());
        return 2;
    }
}
