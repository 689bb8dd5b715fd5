#pragma once

#include "base/time.h"

#include <deque>
#include <optional>
#include <stdexcept>
#include <string>

namespace mfar {

/// Everything on the GPU is lost and has to be created again on another context.
class GpuLost : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Counts losses of the GPU and decides when to stop using it. Used by one thread.
class GpuFailures {
public:
    static constexpr std::chrono::seconds kWindow{60};
    static constexpr std::size_t kMost = 3;  ///< within kWindow

    /// Returns true when the GPU must not be used any more.
    [[nodiscard]] bool add(Timestamp now, std::string why);
    /// The fault in words; nothing without a fault. A loss is reported for kWindow, a GPU that is
    /// no longer used for ever.
    [[nodiscard]] std::optional<std::string> fault(Timestamp now);
    /// Text of the banner: fault() of a GPU that is no longer used, for kWindow.
    [[nodiscard]] std::optional<std::string> banner(Timestamp now);

private:
    void forgetOld(Timestamp now);

    std::deque<Timestamp> times_;
    std::string why_;
    std::optional<Timestamp> givenUp_;
};

}  // namespace mfar
