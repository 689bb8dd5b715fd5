// Lists the cameras of libcamera. With arguments, takes frames from one camera and prints a line
// for each frame:
//   libcamera-probe
//   libcamera-probe CAMERA WIDTHxHEIGHT FRAMES [NAME=VALUE...]
// CAMERA is the id, location, model or list index of a camera. NAME=VALUE sets a control. Exit
// status: 0 all frames came, 1 a camera failed or a second passed without a frame, 2 wrong usage.

#include "hal/device/camera_libcamera.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

using namespace mfar;

namespace {

constexpr std::chrono::milliseconds kPatience{1000};

int usage() {
    fmt::print(stderr, "usage: libcamera-probe [CAMERA WIDTHxHEIGHT FRAMES [NAME=VALUE...]]\n");
    return 2;
}

const char* nameOf(PixelFormat format) {
    switch (format) {
    case PixelFormat::Gray8: return "Gray8";
    case PixelFormat::Rgba8: return "Rgba8";
    case PixelFormat::Bgra8: return "Bgra8";
    case PixelFormat::Yuyv: return "Yuyv";
    case PixelFormat::Nv12: return "Nv12";
    case PixelFormat::Yuv420: return "Yuv420";
    }
    return "?";
}

double meanLuma(const ImageView& view) {
    const int step = bytesPerPixel(view.format);
    const int channel = step == 4 ? 1 : 0;
    double sum = 0;
    for (int y = 0; y < view.size.height; ++y) {
        const std::uint8_t* row = view.data + view.stride * static_cast<std::size_t>(y);
        for (int x = 0; x < view.size.width; ++x)
            sum += row[x * step + channel];
    }
    return sum / view.size.width / view.size.height;
}

std::string camera(const std::string& wanted) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (error != std::errc{} || end != wanted.data() + wanted.size()) return wanted;
    const auto cameras = listLibcameras();
    return index < cameras.size() ? cameras[index].id : wanted;
}

int list() {
    const auto cameras = listLibcameras();
    for (std::size_t i = 0; i < cameras.size(); ++i)
        fmt::print("{}: {}\n", i, describe({cameras[i]}));
    if (cameras.empty()) fmt::print("no camera\n");
    return 0;
}

int take(const LibcameraOptions& options, int frames) {
    LibcameraCamera camera(options);
    const CameraInfo info = camera.info();
    fmt::print("camera '{}' {}x{} {}\n", info.name, info.size.width, info.size.height,
               nameOf(info.format));
    camera.start();
    int got = 0;
    for (; got < frames; ++got) {
        const auto frame = camera.next(kPatience);
        if (!frame) break;
        const ImageView& view = frame->view();
        fmt::print("{:.6f} {} {}x{} {} stride {} luma {:.2f} age {:.1f} ms\n",
                   frame->time().seconds(), got, view.size.width, view.size.height,
                   nameOf(view.format), view.stride, meanLuma(view),
                   static_cast<double>((Timestamp::now() - frame->time()).count()) * 1e-6);
        std::fflush(stdout);
    }
    camera.stop();
    const LibcameraCounters counted = camera.counters();
    fmt::print("frames {} dropped {} broken {} startup {} untimed {} clock {}\n", counted.frames,
               counted.dropped, counted.broken, counted.startup, counted.untimed,
               counted.clock == SensorClock::Kind::Monotonic ? "monotonic" : "boottime");
    return got == frames ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc == 1) return list();
    if (argc < 4) return usage();
    LibcameraOptions options;
    options.camera.name = camera(argv[1]);
    if (std::sscanf(argv[2], "%dx%d", &options.size.width, &options.size.height) != 2)
        return usage();
    const int frames = std::atoi(argv[3]);
    if (frames <= 0) return usage();
    for (int i = 4; i < argc; ++i) {
        const std::string_view control = argv[i];
        const std::size_t equals = control.find('=');
        if (equals == control.npos) return usage();
        options.controls.emplace_back(control.substr(0, equals), control.substr(equals + 1));
    }
    return take(options, frames);
} catch (const std::exception& error) {
    fmt::print(stderr, "libcamera-probe: {}\n", error.what());
    return 1;
}
