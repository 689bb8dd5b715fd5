// Fires pulses on a GPIO line and prints a line of text for each still that matches a pulse:
//   trigger-probe CAMERA WIDTHxHEIGHT CHIP LINE PULSES PERIOD-MS JITTER-MS
// JITTER-MS is the largest accepted difference between a still's time and the time expected from
// its pulse, once the delay of the stills has been learned. A line is "TIME pulse N still M". TIME
// is the still's time [s]. N is the number of pulses fired so far. M is the number in the upper
// rows of the picture, as the emulated cameras of toolchains/testbed show it: 32 blocks side by
// side, bit 0 first, white for 1. The last line has the totals of all pulses and stills. Exit
// status: 0 done, 1 a device failed, 2 wrong usage.

#include "hal/device/camera_libcamera.h"
#include "hal/device/trigger_gpiod.h"
#include "hal/triggered_stills.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

using namespace mfar;

namespace {

constexpr std::chrono::milliseconds kLook{20};
constexpr std::chrono::seconds kAfter{3};

unsigned numberOf(const ImageView& view) {
    unsigned number = 0;
    for (unsigned bit = 0; bit < 32; ++bit) {
        const std::size_t x = (2 * bit + 1) * static_cast<std::size_t>(view.size.width) / 64;
        if (view.data[4 * view.stride + x * bytesPerPixel(view.format)] > 127) number |= 1U << bit;
    }
    return number;
}

void print(const std::optional<Frame>& still, std::uint64_t pulses) {
    if (!still) return;
    fmt::print("{:.6f} pulse {} still {}\n", still->time().seconds(), pulses,
               numberOf(still->view()));
    std::fflush(stdout);
}

void run(char** argv) {
    LibcameraOptions camera;
    camera.camera.name = argv[1];
    if (std::sscanf(argv[2], "%dx%d", &camera.size.width, &camera.size.height) != 2)
        throw std::runtime_error("the size must be WIDTHxHEIGHT");
    camera.rateHz = 0;
    camera.still = true;
    TriggerOptions trigger;
    trigger.chip = argv[3];
    trigger.line = argv[4];
    const int pulses = std::atoi(argv[5]);
    const std::chrono::milliseconds period(std::atoi(argv[6]));
    TriggeredStillOptions options;
    options.matching.window = std::chrono::milliseconds(std::atoi(argv[7]));
    TriggeredStillCamera stills(std::make_unique<LibcameraCamera>(camera), openGpioTrigger(trigger),
                                options);
    stills.start();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    for (int i = 0; i < pulses; ++i) {
        const Timestamp next = stills.fire() + period;
        while (Timestamp::now() < next)
            print(stills.next(kLook), stills.counters().fired);
    }
    for (const Timestamp end = Timestamp::now() + kAfter; Timestamp::now() < end;)
        print(stills.next(kLook), stills.counters().fired);
    const StillCounters c = stills.counters();
    fmt::print("fired {} matched {} unmatched {} lost {} late {} repeated {} relearned {}\n",
               c.fired, c.matched, c.unmatched, c.lost, c.late, c.repeated, c.relearned);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 8) {
        fmt::print(stderr, "usage: trigger-probe CAMERA WIDTHxHEIGHT CHIP LINE PULSES PERIOD-MS "
                           "JITTER-MS\n");
        return 2;
    }
    try {
        run(argv);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
