#pragma once

#include "hal/device/v4l2_device.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// One knob of a device.
struct V4l2Control {
    enum class Kind { Integer, Boolean, Menu, Button, Other };

    /// An entry of a menu; menus of numbers have the number as their text.
    struct Entry {
        std::int64_t index;
        std::string text;
    };

    std::uint32_t id = 0;
    std::string name;    ///< the driver's: "Trigger Mode"
    std::string folded;  ///< as in settings: "trigger_mode"
    Kind kind = Kind::Other;
    std::int64_t minimum = 0, maximum = 0, step = 1, standard = 0;
    bool readOnly = false, writeOnly = false;
    bool inactive = false;  ///< set, but without effect while another control says so
    bool wide = false;      ///< 64 bits
    std::vector<Entry> entries;
};

/// How settings write a control's name: letters and digits in lower case, one underscore for all
/// that lies between them. "White Balance, Automatic" is white_balance_automatic.
[[nodiscard]] std::string foldedName(std::string_view name);

/// One line for people: "exposure_time_absolute: 3 to 2047 in steps of 1, default 250".
[[nodiscard]] std::string describe(const V4l2Control& control);

/// The controls of a device, by name. Vendors give their controls colliding ids (0x981901 is one
/// vendor's trigger mode and another's flash), so names are what settings can rely on.
///
/// Names are compared folded. What is busy or fails on its bus is tried three times. All calls
/// throw std::runtime_error with one sentence: no such control (lists those there are), a value out
/// of range (says the range), read-only, busy, refused; and DeviceLost. The device must outlive
/// this.
class V4l2Controls {
public:
    /// Asks the device for all its controls.
    explicit V4l2Controls(const V4l2Device& device);

    [[nodiscard]] const std::vector<V4l2Control>& list() const { return controls_; }
    /// Null when there is none.
    [[nodiscard]] const V4l2Control* find(std::string_view name) const;

    [[nodiscard]] std::int64_t get(std::string_view name) const;
    /// Integer, boolean, or menu by the number of its entry. Returns what the device made of it.
    std::int64_t set(std::string_view name, std::int64_t value) const;
    /// The same from a text: a number; true, on, false, off; or a menu entry's text. A button takes
    /// any text.
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
