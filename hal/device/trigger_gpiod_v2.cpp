// Implements gpio_lines.h with libgpiod 2.x (Debian 13).

#include "hal/device/gpio_selection.h"

#include <fmt/format.h>

#include <system_error>

#include <cerrno>
#include <filesystem>
#include <gpiod.h>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

constexpr const char* kConsumer = "mfar-trigger";

template <auto Free>
struct Freed {
    template <typename T>
    void operator()(T* handle) const {
        Free(handle);
    }
};
using Chip = std::unique_ptr<gpiod_chip, Freed<gpiod_chip_close>>;
using ChipInfo = std::unique_ptr<gpiod_chip_info, Freed<gpiod_chip_info_free>>;
using LineInfo = std::unique_ptr<gpiod_line_info, Freed<gpiod_line_info_free>>;
using Settings = std::unique_ptr<gpiod_line_settings, Freed<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, Freed<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, Freed<gpiod_request_config_free>>;
using Request = std::unique_ptr<gpiod_line_request, Freed<gpiod_line_request_release>>;
using Events = std::unique_ptr<gpiod_edge_event_buffer, Freed<gpiod_edge_event_buffer_free>>;

std::string text(const char* nullable) {
    return nullable ? nullable : "";
}

Settings outputSettings() {
    Settings settings(gpiod_line_settings_new());
    if (!settings) return settings;
    gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_OUTPUT);
    gpiod_line_settings_set_output_value(settings.get(), GPIOD_LINE_VALUE_INACTIVE);
    return settings;
}

Settings edgeSettings() {
    Settings settings(gpiod_line_settings_new());
    if (!settings) return settings;
    gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_INPUT);
    gpiod_line_settings_set_edge_detection(settings.get(), GPIOD_LINE_EDGE_BOTH);
    gpiod_line_settings_set_event_clock(settings.get(), GPIOD_LINE_CLOCK_MONOTONIC);
    return settings;
}

Request request(const GpioAddress& address, const Settings& settings) {
    const Chip chip(gpiod_chip_open(address.path.c_str()));
    const LineConfig lines(gpiod_line_config_new());
    const RequestConfig config(gpiod_request_config_new());
    if (!chip || !settings || !lines || !config)
        throw std::runtime_error(gpioRequestFault(address, errno));
    gpiod_line_settings_set_active_low(settings.get(), address.activeLow);
    gpiod_request_config_set_consumer(config.get(), kConsumer);
    Request taken;
    if (gpiod_line_config_add_line_settings(lines.get(), &address.offset, 1, settings.get()) == 0)
        taken.reset(gpiod_chip_request_lines(chip.get(), config.get(), lines.get()));
    if (!taken) throw std::runtime_error(gpioRequestFault(address, errno));
    return taken;
}

[[noreturn]] void fail(const std::string& what, int error) {
    throw std::runtime_error(
        fmt::format("GPIO {}: {}", what, std::generic_category().message(error)));
}

class Output final : public OutputLine {
public:
    explicit Output(const GpioAddress& address)
        : text_(address.text), offset_(address.offset), taken_(request(address, outputSettings())) {
    }

    void set(bool active) override {
        const auto value = active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
        if (gpiod_line_request_set_value(taken_.get(), offset_, value) != 0) fail(text_, errno);
    }

private:
    std::string text_;
    unsigned offset_;
    Request taken_;
};

class Edges final : public EdgeInput {
public:
    explicit Edges(const GpioAddress& address)
        : text_(address.text), taken_(request(address, edgeSettings())),
          events_(gpiod_edge_event_buffer_new(1)) {
        if (!events_) fail(text_, errno);
    }

    std::optional<Timestamp> next(std::chrono::microseconds timeout) override {
        const int ready = gpiod_line_request_wait_edge_events(
            taken_.get(), std::chrono::nanoseconds(timeout).count());
        if (ready == 0) return std::nullopt;
        if (ready < 0 || gpiod_line_request_read_edge_events(taken_.get(), events_.get(), 1) != 1)
            fail(text_, errno);
        const auto ns =
            gpiod_edge_event_get_timestamp_ns(gpiod_edge_event_buffer_get_event(events_.get(), 0));
        return Timestamp{static_cast<std::int64_t>(ns)};
    }

private:
    std::string text_;
    Request taken_;
    Events events_;
};

GpioChip describe(const std::string& path) {
    GpioChip found;
    found.path = path;
    found.name = std::filesystem::path(path).filename();
    const Chip chip(gpiod_chip_open(path.c_str()));
    const ChipInfo info(chip ? gpiod_chip_get_info(chip.get()) : nullptr);
    if (!info) {
        found.error = errno;
        return found;
    }
    found.label = text(gpiod_chip_info_get_label(info.get()));
    for (unsigned i = 0; i < gpiod_chip_info_get_num_lines(info.get()); ++i) {
        const LineInfo line(gpiod_chip_get_line_info(chip.get(), i));
        if (!line) {
            found.error = errno;
            continue;
        }
        found.lines.push_back({i, text(gpiod_line_info_get_name(line.get())),
                               text(gpiod_line_info_get_consumer(line.get())),
                               gpiod_line_info_is_used(line.get())});
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
