#pragma once

#include "base/time.h"

#include <deque>
#include <optional>
#include <stdexcept>
#include <string>

namespace mfar {

/// All that is on the GPU is lost: it has to be made anew on another context.
class GpuLost : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Counts losses of the GPU and decides when it is no longer used. Used by one thread.
class GpuFailures {
public:
    static constexpr std::chrono::seconds kWindow{60};
    static constexpr std::size_t kMost = 3;  ///< within kWindow

    /// True: it was the last time that the GPU is used.
    [[nodiscard]] bool add(Timestamp now, std::string why);
    /// The fault in words; nothing when all is well. A loss is reported for kWindow, a GPU that is
    /// no longer used is reported for ever.
    [[nodiscard]] std::optional<std::string> fault(Timestamp now);
    /// Text over the picture: fault() of a GPU that is no longer used, for kWindow.
    [[nodiscard]] std::optional<std::string> banner(Timestamp now);

private:
    void forgetOld(Timestamp now);

    std::deque<Timestamp> times_;
    std::string why_;
    std::optional<Timestamp> givenUp_;
};

}  // namespace mfar
