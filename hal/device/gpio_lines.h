#pragma once

#include "base/time.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The subset of a GPIO library that the trigger needs. Implemented for libgpiod 1.6, for 2.x, and
/// in the tests without lines.

namespace mfar {

struct GpioLine {
    unsigned offset = 0;
    std::string name;      ///< empty: the board gives it no name
    std::string consumer;  ///< its user, if the kernel knows it
    bool used = false;
};

struct GpioChip {
    std::string path;   ///< "/dev/gpiochip0"
    std::string name;   ///< "gpiochip0"
    std::string label;  ///< "pinctrl-bcm2711"
    std::vector<GpioLine> lines;
    int error = 0;  ///< errno when the chip could not be opened; label and lines are then empty
};

/// Address of a line, and its name in messages.
struct GpioAddress {
    std::string path;
    unsigned offset = 0;
    bool activeLow = false;
    std::string text;  ///< "line 7 'TRIGGER' of gpiochip0 (9030000.pl061)"
    /// Its user when it was looked up; empty: unused, or the user has no name.
    std::string consumer;
};

/// An output line. Levels are logical: the implementation handles active-low lines.
class OutputLine {
public:
    virtual ~OutputLine() = default;
    /// Throws std::runtime_error.
    virtual void set(bool active) = 0;
};

/// A line whose edges the kernel timestamps.
class EdgeInput {
public:
    virtual ~EdgeInput() = default;
    /// Time (CLOCK_MONOTONIC) of the oldest unread edge, waiting for one up to `timeout`. Throws
    /// std::runtime_error.
    [[nodiscard]] virtual std::optional<Timestamp> next(std::chrono::microseconds timeout) = 0;
};

/// All chips of this machine, ordered by number.
[[nodiscard]] std::vector<GpioChip> listGpioChips();
/// Requests the line as an output at its inactive level. The line keeps its level when this object
/// is destroyed. Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<OutputLine> requestOutput(const GpioAddress& line);
/// Requests the line as an input with events on both edges. Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<EdgeInput> requestEdges(const GpioAddress& line);

}  // namespace mfar
