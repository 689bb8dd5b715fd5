#pragma once

#include "base/time.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What the trigger needs of a GPIO library, and no more: two sources implement it, for libgpiod
/// 1.6 and 2.x, a third one in the tests does without lines.

namespace mfar {

struct GpioLine {
    unsigned offset = 0;
    std::string name;      ///< empty: the board gives it none
    std::string consumer;  ///< who has it, as far as the kernel knows
    bool used = false;
};

struct GpioChip {
    std::string path;   ///< "/dev/gpiochip0"
    std::string name;   ///< "gpiochip0"
    std::string label;  ///< "pinctrl-bcm2711"
    std::vector<GpioLine> lines;
    int error = 0;  ///< errno when the chip could not be opened; then label and lines are empty
};

/// Where a line is, and what to call it in messages.
struct GpioAddress {
    std::string path;
    unsigned offset = 0;
    bool activeLow = false;
    std::string text;      ///< "line 7 'TRIGGER' of gpiochip0 (9030000.pl061)"
    std::string consumer;  ///< who had it when it was looked up; empty: nobody, or nobody named
};

/// A line that is driven. Levels are logical: active-low is done below this.
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
    /// Time (CLOCK_MONOTONIC) of the oldest edge not yet read, waiting for one up to `timeout`.
    /// Throws std::runtime_error.
    [[nodiscard]] virtual std::optional<Timestamp> next(std::chrono::microseconds timeout) = 0;
};

/// All chips of this machine in the order of their numbers.
[[nodiscard]] std::vector<GpioChip> listGpioChips();
/// Takes the line as an output at its inactive level. It keeps its level when this object ends.
/// Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<OutputLine> requestOutput(const GpioAddress& line);
/// Takes the line as an input with events on both edges. Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<EdgeInput> requestEdges(const GpioAddress& line);

}  // namespace mfar
