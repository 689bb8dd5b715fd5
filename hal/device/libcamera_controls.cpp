#include "hal/device/libcamera_controls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

using libcamera::ControlId;
using libcamera::ControlInfo;
using libcamera::ControlInfoMap;
using libcamera::ControlValue;

const ControlInfoMap::value_type* find(const ControlInfoMap& camera, const std::string& name) {
    for (const auto& entry : camera)
        if (entry.first->name() == name) return &entry;
    return nullptr;
}

std::string listNames(const ControlInfoMap& camera) {
    std::vector<std::string> names;
    for (const auto& [id, info] : camera)
        names.push_back(id->name());
    std::ranges::sort(names);
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

template <typename T>
std::optional<T> number(std::string_view text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || last != end) return std::nullopt;
    if constexpr (std::is_floating_point_v<T>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

template <typename T>
std::optional<T> element(const ControlId& id, std::string_view text) {
    if constexpr (std::is_same_v<T, bool>) {
        if (text == "true" || text == "1") return true;
        if (text == "false" || text == "0") return false;
        return std::nullopt;
    } else {
        if constexpr (std::is_same_v<T, std::int32_t>)
            if (const auto named = libcamera_compat::enumerator(id, text)) return *named;
        return number<T>(text);
    }
}

template <typename T>
std::optional<ControlValue> several(const ControlId& id, std::string_view text) {
    const auto count = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
    // The array is not a std::vector, because vector<bool> does not store an array of bool.
    const auto values = std::make_unique<T[]>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t comma = text.find(',');
        const auto value = element<T>(id, text.substr(0, comma));
        if (!value) return std::nullopt;
        values[i] = *value;
        text.remove_prefix(comma == text.npos ? text.size() : comma + 1);
    }
    return ControlValue(libcamera::Span<const T>(values.get(), count));
}

/// Returns false if the value is outside the camera's range. A bound of the range is ignored if it
/// is an array or has another type than the value.
template <typename T>
bool isWithin(const ControlInfo& info, T value) {
    const auto type = libcamera::details::control_type<T>::value;
    const auto bounds = [&](const ControlValue& bound) {
        return bound.type() == type && !bound.isArray();
    };
    if (bounds(info.min()) && value < info.min().get<T>()) return false;
    return !(bounds(info.max()) && value > info.max().get<T>());
}

template <typename T>
std::optional<ControlValue> parseAs(const ControlId& id, const ControlInfo& info,
                                    std::string_view text) {
    if (libcamera_compat::isArray(id) || text.find(',') != text.npos) return several<T>(id, text);
    const auto value = element<T>(id, text);
    if (!value || !isWithin<T>(info, *value)) return std::nullopt;
    return ControlValue(*value);
}

template <typename T, typename... Others>
std::optional<ControlValue> parse(const ControlId& id, const ControlInfo& info,
                                  std::string_view text) {
    if constexpr (libcamera_compat::hasControlType<T>())
        if (id.type() == libcamera::details::control_type<T>::value)
            return parseAs<T>(id, info, text);
    if constexpr (sizeof...(Others) > 0)
        return parse<Others...>(id, info, text);
    else
        return std::nullopt;
}

}  // namespace

bool hasControl(const ControlInfoMap& camera, const std::string& name) {
    return find(camera, name) != nullptr;
}

NamedValues withManualModes(const ControlInfoMap& camera, NamedValues wanted) {
    struct Mode {
        std::string_view value, mode, manual;
    };
    // Since libcamera 0.5, exposure and gain have a mode each. Before, AeEnable was the mode of
    // both. If both values are given, AeEnable is turned off, because all boards except Raspberry
    // Pi ignore the values while it is on. If only one value is given, AeEnable stays on: a
    // Raspberry Pi then fixes this value and controls the other.
    static constexpr std::array<Mode, 3> kModes{{{"ExposureTime", "ExposureTimeMode", "1"},
                                                 {"AnalogueGain", "AnalogueGainMode", "1"},
                                                 {"LensPosition", "AfMode", "0"}}};
    const auto isWanted = [&](std::string_view name) {
        return std::ranges::find(wanted, name, &NamedValues::value_type::first) != wanted.end();
    };
    NamedValues modes;
    for (const Mode& one : kModes)
        if (isWanted(one.value) && !isWanted(one.mode) && hasControl(camera, std::string(one.mode)))
            modes.emplace_back(one.mode, one.manual);
    if (isWanted("ExposureTime") && isWanted("AnalogueGain") && !isWanted("AeEnable") &&
        !hasControl(camera, "ExposureTimeMode") && hasControl(camera, "AeEnable"))
        modes.emplace_back("AeEnable", "false");
    wanted.insert(wanted.begin(), modes.begin(), modes.end());
    return wanted;
}

ControlValues parseControls(const ControlInfoMap& camera, const NamedValues& wanted) {
    ControlValues values;
    for (const auto& [name, text] : wanted) {
        const auto* control = find(camera, name);
        if (!control)
            throw std::runtime_error(fmt::format("the camera has no control '{}'; available: {}",
                                                 name, listNames(camera)));
        const auto& [id, info] = *control;
        const auto value = parse<bool, std::uint8_t, std::uint16_t, std::uint32_t, std::int32_t,
                                 std::int64_t, float>(*id, info, text);
        if (!value)
            throw std::runtime_error(fmt::format(
                "control {}: '{}' is not a valid value; expected {}", name, text, info.toString()));
        values.emplace_back(id->id(), *value);
    }
    return values;
}

}  // namespace mfar
