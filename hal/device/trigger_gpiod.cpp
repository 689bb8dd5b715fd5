#include "hal/device/trigger_gpiod.h"

#include "hal/device/gpio_selection.h"
#include "hal/device/trigger_safe_level.h"

#include <utility>

namespace mfar {
namespace {

GpioAddress outputOf(const TriggerOptions& options, const std::vector<GpioChip>& chips) {
    GpioAddress line = findGpioLine(chips, options.chip, options.line);
    line.activeLow = options.activeLow;
    return line;
}

}  // namespace

std::unique_ptr<PulseTrigger> openGpioTrigger(const TriggerOptions& options) {
    const std::vector<GpioChip> chips = listGpioChips();
    const GpioAddress output = outputOf(options, chips);
    std::unique_ptr<EdgeInput> loopback;
    if (!options.loopback.empty()) {
        const std::string& chip =
            options.loopbackChip.empty() ? options.chip : options.loopbackChip;
        GpioAddress input = findGpioLine(chips, chip, options.loopback);
        input.activeLow = options.activeLow;
        loopback = requestEdges(input);
    }
    return std::make_unique<PulseTrigger>("GPIO " + output.text, requestOutput(output),
                                          std::move(loopback), options.pulse);
}

void driveSafe(const TriggerOptions& options) {
    requestOutput(outputOf(options, listGpioChips()))->set(false);
}

}  // namespace mfar
