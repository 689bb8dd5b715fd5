#pragma once

#include "base/time.h"

#include <deque>
#include <optional>
#include <stdexcept>
#include <string>

namespace mfar {

/// Reports that the GPU was lost. All objects on it are invalid and must be created again in
/// another context.
class GpuLost : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Counts losses of the GPU, and decides when to stop using it. Only one thread may use it.
class GpuFailures {
public:
    static constexpr std::chrono::seconds kWindow{60};
    /// After this number of losses within kWindow, the GPU is not used any more.
    static constexpr std::size_t kMost = 3;

    /// Counts a loss. Returns true if the GPU must not be used any more.
    [[nodiscard]] bool add(Timestamp now, std::string why);
    /// Returns a message if the GPU was lost within the last kWindow, otherwise nothing. After
    /// mfard has stopped using the GPU, always returns a message.
    [[nodiscard]] std::optional<std::string> fault(Timestamp now);
    /// Returns the text for a banner: for the time kWindow after mfard has stopped using the GPU,
    /// the message of fault(). Before and after that time, returns nothing.
    [[nodiscard]] std::optional<std::string> banner(Timestamp now);

private:
    void forgetOld(Timestamp now);

    std::deque<Timestamp> times_;
    std::string why_;
    std::optional<Timestamp> givenUp_;
};

}  // namespace mfar
