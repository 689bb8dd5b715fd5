#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace mfar::test {

/// What the action throws as std::runtime_error, "no error" when it does not.
[[nodiscard]] inline std::string errorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace mfar::test
