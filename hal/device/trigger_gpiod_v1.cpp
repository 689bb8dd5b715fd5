// Implements gpio_lines.h with libgpiod 1.x (Debian 12).

#include "hal/device/gpio_selection.h"

#include <fmt/format.h>

#include <system_error>

#include <cerrno>
#include <ctime>
#include <filesystem>
#include <gpiod.h>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

constexpr const char* kConsumer = "mfar-trigger";

struct CloseChip {
    void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

std::string text(const char* nullable) {
    return nullable ? nullable : "";
}

/// A requested line and its chip. The chip must stay open, because closing it releases the line.
struct Requested {
    Chip chip;
    gpiod_line* line = nullptr;
};

Requested request(const GpioAddress& address, int type) {
    Requested taken{Chip(gpiod_chip_open(address.path.c_str())), nullptr};
    if (taken.chip) taken.line = gpiod_chip_get_line(taken.chip.get(), address.offset);
    const gpiod_line_request_config config{
        kConsumer, type, address.activeLow ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0};
    if (!taken.line || gpiod_line_request(taken.line, &config, 0) != 0)
        throw std::runtime_error(gpioRequestFault(address, errno));
    return taken;
}

[[noreturn]] void fail(const std::string& what, int error) {
    throw std::runtime_error(
        fmt::format("GPIO {}: {}", what, std::generic_category().message(error)));
}

class Output final : public OutputLine {
public:
    explicit Output(const GpioAddress& address)
        : text_(address.text), taken_(request(address, GPIOD_LINE_REQUEST_DIRECTION_OUTPUT)) {}

    void set(bool active) override {
        if (gpiod_line_set_value(taken_.line, active ? 1 : 0) != 0) fail(text_, errno);
    }

private:
    std::string text_;
    Requested taken_;
};

class Edges final : public EdgeInput {
public:
    explicit Edges(const GpioAddress& address)
        : text_(address.text), taken_(request(address, GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES)) {}

    std::optional<Timestamp> next(std::chrono::microseconds timeout) override {
        // The casts are needed on 32-bit systems, where the fields of timespec have 32 bits.
        timespec wait{};
        wait.tv_sec = static_cast<time_t>(timeout.count() / 1'000'000);
        wait.tv_nsec = static_cast<decltype(wait.tv_nsec)>(timeout.count() % 1'000'000 * 1000);
        const int ready = gpiod_line_event_wait(taken_.line, &wait);
        if (ready == 0) return std::nullopt;
        gpiod_line_event event{};
        if (ready < 0 || gpiod_line_event_read(taken_.line, &event) != 0) fail(text_, errno);
        return Timestamp{static_cast<std::int64_t>(event.ts.tv_sec) * 1'000'000'000 +
                         event.ts.tv_nsec};
    }

private:
    std::string text_;
    Requested taken_;
};

GpioChip describe(const std::string& path) {
    GpioChip found;
    found.path = path;
    found.name = std::filesystem::path(path).filename();
    const Chip chip(gpiod_chip_open(path.c_str()));
    if (!chip) {
        found.error = errno;
        return found;
    }
    found.label = text(gpiod_chip_label(chip.get()));
    for (unsigned i = 0; i < gpiod_chip_num_lines(chip.get()); ++i) {
        gpiod_line* line = gpiod_chip_get_line(chip.get(), i);
        if (!line) {
            found.error = errno;  // newer kernels may not support the interface of libgpiod 1.x
            continue;
        }
        found.lines.push_back({i, text(gpiod_line_name(line)), text(gpiod_line_consumer(line)),
                               gpiod_line_is_used(line)});
    }
    return found;
}

}  // namespace

std::vector<GpioChip> listGpioChips() {
    std::vector<GpioChip> chips;
    for (const std::string& path : gpioChipPaths())
        chips.push_back(describe(path));
    return chips;
}

std::unique_ptr<OutputLine> requestOutput(const GpioAddress& line) {
    return std::make_unique<Output>(line);
}

std::unique_ptr<EdgeInput> requestEdges(const GpioAddress& line) {
    return std::make_unique<Edges>(line);
}

}  // namespace mfar
