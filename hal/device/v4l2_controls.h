#pragma once

#include "hal/device/v4l2_device.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// One control of a device.
struct V4l2Control {
    enum class Kind { Integer, Boolean, Menu, Button, Other };

    /// A menu entry; a menu of numbers has the number as its text.
    struct Entry {
        std::int64_t index;
        std::string text;
    };

    std::uint32_t id = 0;
    std::string name;    ///< the driver's name: "Trigger Mode"
    std::string folded;  ///< the name in settings: "trigger_mode"
    Kind kind = Kind::Other;
    std::int64_t minimum = 0, maximum = 0, step = 1, standard = 0;
    bool readOnly = false, writeOnly = false;
    bool inactive = false;  ///< can be set, but has no effect because of another control
    bool wide = false;      ///< 64-bit value
    std::vector<Entry> entries;
};

/// A control's name in settings: letters and digits in lower case, one underscore for everything
/// between them. "White Balance, Automatic" is white_balance_automatic.
[[nodiscard]] std::string foldedName(std::string_view name);

/// One line for users: "exposure_time_absolute: 3 to 2047 in steps of 1, default 250".
[[nodiscard]] std::string describe(const V4l2Control& control);

/// The controls of a device, by name. Vendors use colliding ids (0x981901 is one vendor's trigger
/// mode and another's flash), so settings rely on names.
///
/// Names are compared in folded form. Busy controls and bus errors are tried three times. All calls
/// throw std::runtime_error with one sentence: unknown control (lists the known ones), value out of
/// range (reports the range), read-only, busy, refused; and DeviceLost. The device must outlive
/// this.
class V4l2Controls {
public:
    /// Queries all controls of the device.
    explicit V4l2Controls(const V4l2Device& device);

    [[nodiscard]] const std::vector<V4l2Control>& list() const { return controls_; }
    /// Null if there is no control of this name.
    [[nodiscard]] const V4l2Control* find(std::string_view name) const;

    [[nodiscard]] std::int64_t get(std::string_view name) const;
    /// Sets an integer, a boolean, or a menu by entry number. Returns the value that the device
    /// adopted.
    std::int64_t set(std::string_view name, std::int64_t value) const;
    /// As above, from a text: a number; true, on, false, off; or a menu entry's text. A button
    /// accepts any text.
    std::int64_t set(std::string_view name, std::string_view text) const;
    void press(std::string_view name) const;

private:
    [[nodiscard]] const V4l2Control& require(std::string_view name) const;
    std::int64_t write(const V4l2Control& control, std::int64_t value) const;
    [[nodiscard]] std::vector<V4l2Control::Entry> entriesOf(const V4l2Control& control,
                                                            bool numbers) const;

    const V4l2Device* device_;
    std::vector<V4l2Control> controls_;
};

}  // namespace mfar
