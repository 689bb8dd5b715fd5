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

/// How often the GPU was lost, by which is decided whether it is used on. Used by one thread.
class GpuFailures {
public:
    static constexpr std::chrono::seconds kWindow{60};
    static constexpr std::size_t kMost = 3;  ///< within kWindow

    /// True: it was the last time that the GPU is used.
    [[nodiscard]] bool add(Timestamp now, std::string why);
    /// What is wrong for people, nothing when all is well: a loss for as long as kWindow, a GPU
    /// that is no longer used for ever.
    [[nodiscard]] std::optional<std::string> fault(Timestamp now);
    /// What the picture is to say: fault() of a GPU that is no longer used, for as long as kWindow.
    [[nodiscard]] std::optional<std::string> banner(Timestamp now);

private:
    void forgetOld(Timestamp now);

    std::deque<Timestamp> times_;
    std::string why_;
    std::optional<Timestamp> givenUp_;
};

}  // namespace mfar
