#pragma once

#include "hal/time.h"

#include <string>

namespace mfar {

/// The line that makes the still sensor expose one picture.
class Trigger {
public:
    virtual ~Trigger() = default;

    /// Fires one pulse and returns the time of its leading edge. Never waits for the still; the
    /// picture arrives later through the still camera. Throws std::runtime_error when the line
    /// cannot be driven.
    virtual Timestamp fire() = 0;
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace mfar
