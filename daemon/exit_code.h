#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {

/// Exit codes of the programs, with the values of sysexits.h.
enum class ExitCode {
    Ok = 0,
    Usage = 64,
    BadData = 65,      ///< an input exists but is invalid
    NoInput = 66,      ///< an input is missing or unreadable
    Unavailable = 69,  ///< a device or the GL renderer is not available
    Internal = 70,
    OutputFailed = 74,  ///< display, recording, summary or report cannot be written
    BadConfig = 78,
};

/// An error with an exit code and a message, usually of one line. If only main() catches it, the
/// program prints the message and ends with this exit code.
class Failure : public std::runtime_error {
public:
    Failure(ExitCode exitCode, const std::string& message)
        : std::runtime_error(message), code(exitCode) {}

    const ExitCode code;
};

/// Calls `action` and returns its result. If `action` throws an `Error`, throws a Failure with the
/// exit code `code` and the same message.
template <class Error = std::runtime_error, class Action>
decltype(auto) orFail(ExitCode code, Action&& action) {
    try {
        return std::forward<Action>(action)();
    } catch (const Error& error) {
        throw Failure(code, error.what());
    }
}

[[nodiscard]] inline ExitCode exitCode(const std::exception& error) {
    const auto* failure = dynamic_cast<const Failure*>(&error);
    return failure != nullptr ? failure->code : ExitCode::Internal;
}

}  // namespace mfar
