#include "daemon/tools/status_text.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

namespace mfar {
namespace {

using nlohmann::ordered_json;

// The counters of a camera, in the order in which they are shown: the key that status.cpp gives to
// the counter, and its text.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kCounters{{
    {"missed", "missed"},
    {"broken", "broken"},
    {"bad_times", "with impossible times"},
    {"untimed", "without times"},
    {"startup", "before the sensor had settled"},
    {"repeated_pictures", "repeated"},
    {"restarts", "restarts of the stream"},
    {"reopened", "reopenings"},
}};

std::string valueText(const ordered_json& value) {
    if (value.is_null()) return "none";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.1f}", value.get<double>());
    return value.dump();
}

double number(const ordered_json& object, std::string_view key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

std::string text(const ordered_json& object, std::string_view key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string healthText(const ordered_json& health) {
    std::string out =
        fmt::format("{} for {:.1f} s", text(health, "state"), number(health, "since_s"));
    if (const std::string cause = text(health, "cause"); !cause.empty()) out += ": " + cause;
    if (health.contains("picture_age_s") && health["picture_age_s"].is_number())
        out += fmt::format("; last picture {:.1f} s ago", number(health, "picture_age_s"));
    return out;
}

std::string cameraText(const ordered_json& camera) {
    std::string out = fmt::format("{:.0f} pictures", number(camera, "delivered"));
    const double configured = number(camera, "configured_hz");
    if (configured > 0)
        out +=
            fmt::format(", {:.1f} of {:.1f} per second", number(camera, "measured_hz"), configured);
    for (const auto& [key, words] : kCounters)
        if (const double count = number(camera, key); count > 0)
            out += fmt::format(", {:.0f} {}", count, words);
    if (camera.contains("distinct_age_s"))
        out += fmt::format(", last new picture {:.1f} s ago", number(camera, "distinct_age_s"));
    return out;
}

std::string line(std::string_view key, std::string_view value) {
    return fmt::format("{:<11}{}\n", key, value);
}

}  // namespace

std::string statusText(const ordered_json& answer) {
    std::string out;
    for (const auto& [key, value] : answer.items()) {
        if (key == "health" && value.is_object()) {
            out += line(key, healthText(value));
        } else if (key == "cameras" && value.is_object()) {
            for (const auto& [name, camera] : value.items())
                out +=
                    line(name == value.begin().key() ? key : "", name + ": " + cameraText(camera));
        } else {
            out += line(key, valueText(value));
        }
    }
    return out;
}

}  // namespace mfar
