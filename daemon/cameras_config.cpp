#include "daemon/cameras_config.h"

#include "daemon/toml_reader.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace mfar {
namespace {

constexpr std::array<std::pair<std::string_view, CameraDriver>, 2> kDrivers = {
    {{"libcamera", CameraDriver::Libcamera}, {"v4l2", CameraDriver::V4l2}}};
constexpr double kLeastRate = 0.01;  // smallest valid frame rate of an untriggered camera [Hz]

std::optional<std::string> rateFault(double value) {
    if (value == 0 || value >= kLeastRate) return std::nullopt;
    return fmt::format("must be 0 or at least {} Hz", kLeastRate);
}

/// `other`: the camera that was read before, or null.
void readCamera(TomlReader& file, const std::string& section, CameraConfig& camera,
                const CameraConfig* other) {
    file.choice<CameraDriver>(section + "driver", camera.driver, kDrivers);
    // A name that fits several cameras is refused at run time, so equal names mean the same camera.
    file.text(section + "camera", camera.camera,
              [&](std::string_view name) -> std::optional<std::string> {
                  if (other == nullptr || name.empty() || name != other->camera ||
                      camera.driver != other->driver)
                      return std::nullopt;
                  return "is already the camera of [cameras.video]";
              });
    file.integer(section + "width", camera.size.width);
    file.integer(section + "height", camera.size.height);
    file.number(section + "rate_hz", camera.rateHz, rateFault);
    file.text(section + "format", camera.format,
              [&](std::string_view word) -> std::optional<std::string> {
                  if (word == "auto") return std::nullopt;
                  if (camera.driver == CameraDriver::Libcamera)
                      return "must be \"auto\" with libcamera, which selects the format itself; "
                             "to choose it, set driver = \"v4l2\"";
                  if (word.size() == 4) return std::nullopt;
                  return "must be \"auto\" or the four characters of a V4L2 format, such as "
                         "\"YUYV\"";
              });
    file.boolean(section + "allow_crop", camera.allowCrop);
    file.values(section + "controls", camera.controls);
}

/// Returns a check of a GPIO line that is given by its name, or by its number on `chip`.
auto checkOfLine(const std::string& chip) {
    return [&chip](std::string_view line) -> std::optional<std::string> {
        constexpr std::string_view kDigits = "0123456789";
        if (!chip.empty() || line.empty() || line.find_first_not_of(kDigits) != line.npos)
            return std::nullopt;
        return "is a line's number, so its chip must be set, too";
    };
}

void readLine(TomlReader& file, double stillTimeoutS, TriggerLineConfig& line) {
    file.text("cameras.trigger.chip", line.chip);
    file.text("cameras.trigger.line", line.line, checkOfLine(line.chip));
    file.boolean("cameras.trigger.active_low", line.activeLow);
    file.number("cameras.trigger.pulse_ms", line.pulseMs,
                [&](double ms) -> std::optional<std::string> {
                    if (line.line.empty() || ms < 1e3 * stillTimeoutS) return std::nullopt;
                    return fmt::format("must be shorter than trigger.timeout_s, which is {} s",
                                       stillTimeoutS);
                });
    file.boolean("cameras.trigger.pulse_is_exposure", line.pulseIsExposure);
    file.text("cameras.trigger.loopback_chip", line.loopbackChip);
    const std::string& chip = line.loopbackChip.empty() ? line.chip : line.loopbackChip;
    file.text("cameras.trigger.loopback", line.loopback, checkOfLine(chip));
    file.number("cameras.trigger.delay_ms", line.delayMs);
    file.number("cameras.trigger.jitter_ms", line.jitterMs);
    file.number("cameras.trigger.arrival_ms", line.arrivalMs);
}

}  // namespace

void readCameras(TomlReader& file, double stillTimeoutS, CamerasConfig& cameras) {
    std::string calibration;
    file.text("cameras.calibration", calibration);
    cameras.calibration = calibration;
    readCamera(file, "cameras.video.", cameras.video, nullptr);
    readCamera(file, "cameras.still.", cameras.still, &cameras.video);
    readLine(file, stillTimeoutS, cameras.trigger);
}

}  // namespace mfar
