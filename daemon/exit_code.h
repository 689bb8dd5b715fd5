#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {

/// Exit codes of the programs, from sysexits.h, so that a service manager can tell them apart.
enum class ExitCode {
    Ok = 0,
    Usage = 64,         ///< wrong command line
    BadData = 65,       ///< an input exists but is broken
    NoInput = 66,       ///< an input is missing or unreadable
    Unavailable = 69,   ///< a device or the GL renderer cannot be had
    Internal = 70,      ///< a bug
    OutputFailed = 74,  ///< display or recording cannot be written
    BadConfig = 78,     ///< the configuration file
};

/// An error that ends the program: one line for people, and the code it exits with.
class Failure : public std::runtime_error {
public:
    Failure(ExitCode exitCode, const std::string& message)
        : std::runtime_error(message), code(exitCode) {}

    const ExitCode code;
};

/// What `action` returns. An Error becomes a Failure with this code and the same message.
template <class Error = std::runtime_error, class Action>
decltype(auto) orFail(ExitCode code, Action&& action) {
    try {
        return std::forward<Action>(action)();
    } catch (const Error& error) {
        throw Failure(code, error.what());
    }
}

/// What to exit with after this error; Internal when it says nothing about that.
[[nodiscard]] inline ExitCode exitCode(const std::exception& error) {
    const auto* failure = dynamic_cast<const Failure*>(&error);
    return failure != nullptr ? failure->code : ExitCode::Internal;
}

}  // namespace mfar
