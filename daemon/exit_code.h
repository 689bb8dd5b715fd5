#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {

/// Exit codes of the programs, from sysexits.h, so that a service manager can distinguish them.
enum class ExitCode {
    Ok = 0,
    Usage = 64,         ///< wrong command line
    BadData = 65,       ///< an input exists but is invalid
    NoInput = 66,       ///< an input is missing or unreadable
    Unavailable = 69,   ///< a device or the GL renderer is not available
    Internal = 70,      ///< a bug
    OutputFailed = 74,  ///< display or recording cannot be written
    BadConfig = 78,     ///< the configuration is invalid
};

/// An error that ends the program: a message of one line, and the exit code.
class Failure : public std::runtime_error {
public:
    Failure(ExitCode exitCode, const std::string& message)
        : std::runtime_error(message), code(exitCode) {}

    const ExitCode code;
};

/// Returns the result of `action`. An Error becomes a Failure with this code and the same message.
template <class Error = std::runtime_error, class Action>
decltype(auto) orFail(ExitCode code, Action&& action) {
    try {
        return std::forward<Action>(action)();
    } catch (const Error& error) {
        throw Failure(code, error.what());
    }
}

/// The exit code for this error; Internal for errors other than Failure.
[[nodiscard]] inline ExitCode exitCode(const std::exception& error) {
    const auto* failure = dynamic_cast<const Failure*>(&error);
    return failure != nullptr ? failure->code : ExitCode::Internal;
}

}  // namespace mfar
