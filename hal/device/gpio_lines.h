#pragma once

#include "base/time.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The subset of a GPIO library that the trigger needs. It is implemented with libgpiod 1.6, with
/// libgpiod 2.x, and, in the tests, without hardware. All functions except listGpioChips() may
/// throw std::runtime_error.

namespace mfar {

struct GpioLine {
    unsigned offset = 0;
    std::string name;
    std::string consumer;
    bool used = false;
};

/// Example: path "/dev/gpiochip0", name "gpiochip0", label "pinctrl-bcm2711".
struct GpioChip {
    std::string path;
    std::string name;
    std::string label;
    std::vector<GpioLine> lines;
    int error = 0;  ///< errno of opening the chip or a line; 0: no error
};

struct GpioAddress {
    std::string path;
    unsigned offset = 0;
    bool activeLow = false;
    std::string text;  ///< for messages: "line 7 'TRIGGER' of gpiochip0 (9030000.pl061)"
    std::string consumer;
};

/// An output line. `active` is the logical level; the implementation inverts it if the line is
/// active-low.
class OutputLine {
public:
    virtual ~OutputLine() = default;
    virtual void set(bool active) = 0;
};

class EdgeInput {
public:
    virtual ~EdgeInput() = default;
    /// Waits up to `timeout` and returns the time (CLOCK_MONOTONIC) of the oldest unread edge.
    /// Returns nothing if no edge came.
    [[nodiscard]] virtual std::optional<Timestamp> next(std::chrono::microseconds timeout) = 0;
};

[[nodiscard]] std::vector<GpioChip> listGpioChips();
/// Requests the line as an output at its inactive level. Most drivers keep the line's level when
/// the OutputLine is destroyed, but the kernel does not guarantee it.
[[nodiscard]] std::unique_ptr<OutputLine> requestOutput(const GpioAddress& line);
[[nodiscard]] std::unique_ptr<EdgeInput> requestEdges(const GpioAddress& line);

}  // namespace mfar
