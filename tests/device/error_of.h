#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace mfar::test {

/// Returns the message of the std::runtime_error that the action throws; "no error" if it throws
/// none.
[[nodiscard]] inline std::string errorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace mfar::test
