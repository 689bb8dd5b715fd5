#pragma once

#include "hal/device/v4l2_device.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

struct V4l2Control {
    enum class Kind { Integer, Boolean, Menu, Button, Other };

    struct Entry {
        std::int64_t index;
        std::string text;
    };

    std::uint32_t id = 0;
    std::string name;    ///< the driver's name of the control, e.g. "Trigger Mode"
    std::string folded;  ///< the name in mfard's configuration, e.g. "trigger_mode"
    Kind kind = Kind::Other;
    std::int64_t minimum = 0, maximum = 0, step = 1, standard = 0;
    bool readOnly = false, writeOnly = false;
    bool inactive = false;
    bool wide = false;
    std::vector<Entry> entries;
};

/// Converts a control's name for the configuration: to lower case, with one underscore instead of
/// each run of characters that are neither letters nor digits. Such runs at the beginning and the
/// end are removed. "White Balance, Automatic" becomes white_balance_automatic.
[[nodiscard]] std::string foldedName(std::string_view name);

[[nodiscard]] std::string describe(const V4l2Control& control);

/// The controls of a device. They are found by foldedName(), because vendors use the same id for
/// different controls: 0x981901 is one vendor's trigger mode and another vendor's flash.
///
/// If a control is busy or the bus fails, setting it is tried three times at most. get(), set() and
/// press() throw std::runtime_error if the control is unknown, the value is out of range, or the
/// control is read-only, busy or refuses the value. They throw DeviceLost if the device is lost.
/// The device must outlive this object.
class V4l2Controls {
public:
    explicit V4l2Controls(const V4l2Device& device);

    [[nodiscard]] const std::vector<V4l2Control>& list() const { return controls_; }
    [[nodiscard]] const V4l2Control* find(std::string_view name) const;

    [[nodiscard]] std::int64_t get(std::string_view name) const;
    /// Sets an integer, a boolean, or a menu (by the index of its entry). Returns the value that
    /// the device then reports.
    std::int64_t set(std::string_view name, std::int64_t value) const;
    /// `text` may be a number, a boolean (true, on, yes, false, off, no) or the name of a menu
    /// entry. A button is pressed, whatever the text is.
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
