#include "hal/device/v4l2_controls.h"

#include "hal/camera.h"

#include <fmt/format.h>

#include <linux/videodev2.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>

namespace mfar {
namespace {

using Kind = V4l2Control::Kind;

constexpr int kMostControls = 4096;  // the list of a faulty driver may never end
constexpr std::int64_t kMostEntries = 1024;
constexpr int kTries = 3;
constexpr std::chrono::milliseconds kBetweenTries{20};

// Returns true if setting a control may succeed later, because the device was busy or its bus
// failed.
bool mayPassLater(int error) {
    return error == EBUSY || error == EIO || error == EAGAIN || error == ETIMEDOUT ||
           error == EPROTO || error == EPIPE;
}

Kind kindOf(std::uint32_t type) {
    switch (type) {
    case V4L2_CTRL_TYPE_INTEGER:
    case V4L2_CTRL_TYPE_INTEGER64:
    case V4L2_CTRL_TYPE_BITMASK: return Kind::Integer;
    case V4L2_CTRL_TYPE_BOOLEAN: return Kind::Boolean;
    case V4L2_CTRL_TYPE_MENU:
    case V4L2_CTRL_TYPE_INTEGER_MENU: return Kind::Menu;
    case V4L2_CTRL_TYPE_BUTTON: return Kind::Button;
    default: return Kind::Other;
    }
}

V4l2Control controlOf(const v4l2_query_ext_ctrl& query) {
    V4l2Control out;
    out.id = query.id;
    out.name = fieldText(query.name, sizeof query.name);
    out.folded = foldedName(out.name);
    out.kind = kindOf(query.type);
    out.minimum = query.minimum;
    out.maximum = query.maximum;
    out.step = static_cast<std::int64_t>(query.step);
    out.standard = query.default_value;
    // Bounds of a bitmask are unsigned 32-bit numbers.
    if (query.type == V4L2_CTRL_TYPE_BITMASK) {
        out.minimum = 0;
        out.maximum &= 0xffffffff;
    }
    out.readOnly = (query.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0;
    out.writeOnly = (query.flags & V4L2_CTRL_FLAG_WRITE_ONLY) != 0;
    out.inactive = (query.flags & V4L2_CTRL_FLAG_INACTIVE) != 0;
    out.wide = query.type == V4L2_CTRL_TYPE_INTEGER64;
    return out;
}

std::optional<std::int64_t> numberIn(std::string_view text) {
    std::int64_t out = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return out;
}

std::optional<std::int64_t> valueIn(const V4l2Control& control, std::string_view text) {
    const std::string folded = foldedName(text);
    if (control.kind == Kind::Menu)
        for (const auto& entry : control.entries)
            if (entry.text == text || (!folded.empty() && foldedName(entry.text) == folded))
                return entry.index;
    if (control.kind == Kind::Boolean) {
        if (folded == "true" || folded == "on" || folded == "yes") return 1;
        if (folded == "false" || folded == "off" || folded == "no") return 0;
    }
    return numberIn(text);
}

std::string entriesText(const V4l2Control& control) {
    std::string out;
    for (const auto& entry : control.entries)
        out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", entry.index, entry.text);
    return out;
}

}  // namespace

std::string foldedName(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) != 0)
            out += static_cast<char>(std::tolower(letter));
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    if (!out.empty() && out.back() == '_') out.pop_back();
    return out;
}

std::string describe(const V4l2Control& control) {
    std::string range;
    switch (control.kind) {
    case Kind::Integer:
        range = fmt::format("{} to {} in steps of {}, default {}", control.minimum, control.maximum,
                            control.step, control.standard);
        break;
    case Kind::Boolean:
        range = fmt::format("on or off, default {}", control.standard != 0 ? "on" : "off");
        break;
    case Kind::Menu:
        range = fmt::format("{}, default {}", entriesText(control), control.standard);
        break;
    case Kind::Button: range = "button"; break;
    case Kind::Other: range = "has a type that cannot be set"; break;
    }
    return fmt::format("{}: {}{}{}", control.folded, range, control.readOnly ? ", read-only" : "",
                       control.inactive ? ", inactive now" : "");
}

V4l2Controls::V4l2Controls(const V4l2Device& device) : device_(&device) {
    v4l2_query_ext_ctrl query{};
    constexpr std::uint32_t kNext = V4L2_CTRL_FLAG_NEXT_CTRL | V4L2_CTRL_FLAG_NEXT_COMPOUND;
    std::uint32_t last = 0;
    for (int i = 0; i < kMostControls; ++i) {
        query = {};
        query.id = last | kNext;
        const int error = device.tryCall(VIDIOC_QUERY_EXT_CTRL, &query);
        if (error == ENODEV) device.fail("listing the controls", error);
        if (error != 0 || query.id <= last) break;
        last = query.id;
        const bool title = query.type == V4L2_CTRL_TYPE_CTRL_CLASS;
        if (title || (query.flags & V4L2_CTRL_FLAG_DISABLED) != 0) continue;
        controls_.push_back(controlOf(query));
        if (controls_.back().kind == Kind::Menu)
            controls_.back().entries =
                entriesOf(controls_.back(), query.type == V4L2_CTRL_TYPE_INTEGER_MENU);
    }
}

std::vector<V4l2Control::Entry> V4l2Controls::entriesOf(const V4l2Control& control,
                                                        bool numbers) const {
    std::vector<V4l2Control::Entry> out;
    const std::int64_t first = std::max<std::int64_t>(control.minimum, 0);
    if (first > UINT32_MAX) return out;
    const std::int64_t last = std::min(control.maximum, first + kMostEntries);
    for (std::int64_t i = first; i <= last; ++i) {
        v4l2_querymenu query{};
        query.id = control.id;
        query.index = static_cast<std::uint32_t>(i);
        if (device_->tryCall(VIDIOC_QUERYMENU, &query) != 0) continue;
        const std::int64_t number = query.value;
        out.push_back(
            {i, numbers ? std::to_string(number) : fieldText(query.name, sizeof query.name)});
    }
    return out;
}

const V4l2Control* V4l2Controls::find(std::string_view name) const {
    const std::string folded = foldedName(name);
    const auto found = std::find_if(controls_.begin(), controls_.end(),
                                    [&](const V4l2Control& c) { return c.folded == folded; });
    return found == controls_.end() ? nullptr : &*found;
}

const V4l2Control& V4l2Controls::require(std::string_view name) const {
    if (const V4l2Control* control = find(name)) return *control;
    std::string all;
    for (const V4l2Control& control : controls_)
        all += fmt::format("{}{}", all.empty() ? "" : ", ", control.folded);
    throw std::runtime_error(fmt::format("{}: there is no control '{}'; available: {}",
                                         device_->path(), name, all.empty() ? "none" : all));
}

std::int64_t V4l2Controls::get(std::string_view name) const {
    const V4l2Control& control = require(name);
    if (control.kind == Kind::Other || control.kind == Kind::Button || control.writeOnly)
        throw std::runtime_error(
            fmt::format("{}: control {} cannot be read", device_->path(), control.folded));
    v4l2_ext_control value{};
    value.id = control.id;
    v4l2_ext_controls request{};
    request.which = V4L2_CTRL_WHICH_CUR_VAL;
    request.count = 1;
    request.controls = &value;
    device_->call(VIDIOC_G_EXT_CTRLS, &request, "reading control " + control.folded);
    const std::int64_t wide = value.value64, narrow = value.value;
    return control.wide ? wide : narrow;
}

std::int64_t V4l2Controls::set(std::string_view name, std::int64_t value) const {
    const V4l2Control& control = require(name);
    if (control.kind == Kind::Other)
        throw std::runtime_error(fmt::format("{}: control {} has a type that cannot be set",
                                             device_->path(), control.folded));
    const bool known = control.kind != Kind::Menu ||
                       std::any_of(control.entries.begin(), control.entries.end(),
                                   [&](const V4l2Control::Entry& e) { return e.index == value; });
    const bool within = value >= control.minimum && value <= control.maximum;
    if (control.kind != Kind::Button && !(known && within))
        throw std::runtime_error(fmt::format("{}: control {} cannot be {}; {}", device_->path(),
                                             control.folded, value, describe(control)));
    return write(control, value);
}

std::int64_t V4l2Controls::set(std::string_view name, std::string_view text) const {
    const V4l2Control& control = require(name);
    if (control.kind == Kind::Button) return write(control, 1);
    const auto value = valueIn(control, text);
    if (!value)
        throw std::runtime_error(fmt::format("{}: control {} cannot be '{}'; {}", device_->path(),
                                             control.folded, text, describe(control)));
    return set(name, *value);
}

void V4l2Controls::press(std::string_view name) const {
    const V4l2Control& control = require(name);
    if (control.kind != Kind::Button)
        throw std::runtime_error(
            fmt::format("{}: control {} is not a button", device_->path(), control.folded));
    write(control, 1);
}

std::int64_t V4l2Controls::write(const V4l2Control& control, std::int64_t value) const {
    v4l2_ext_control one{};
    one.id = control.id;
    if (control.wide)
        one.value64 = value;
    else
        one.value = static_cast<std::int32_t>(value);
    v4l2_ext_controls request{};
    request.which = V4L2_CTRL_WHICH_CUR_VAL;
    request.count = 1;
    request.controls = &one;
    int error = device_->tryCall(VIDIOC_S_EXT_CTRLS, &request);
    for (int i = 1; i < kTries && mayPassLater(error); ++i) {
        std::this_thread::sleep_for(kBetweenTries);
        error = device_->tryCall(VIDIOC_S_EXT_CTRLS, &request);
    }
    const std::string where = fmt::format("{}: control {}", device_->path(), control.folded);
    if (error == EACCES)
        throw std::runtime_error(where + (control.readOnly
                                              ? " is read-only"
                                              : " cannot be set now; first set the control that "
                                                "blocks it, usually an automatic mode"));
    if (error == EBUSY) throw std::runtime_error(where + " is busy and cannot be set now");
    if (error == ERANGE)
        throw std::runtime_error(
            fmt::format("{} cannot be {}; {}", where, value, describe(control)));
    if (error != 0) device_->fail("setting control " + control.folded, error);
    const std::int64_t wide = one.value64, narrow = one.value;
    return control.wide ? wide : narrow;
}

}  // namespace mfar
