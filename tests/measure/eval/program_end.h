#pragma once

#include <exception>
#include <string_view>

namespace mfar::eval {

inline constexpr int kWrongInput = 2;

/// Prints the error that ended a program to standard error. Returns the exit code: kWrongInput if
/// the input is the cause, otherwise 1.
[[nodiscard]] int endedBy(const std::exception& error, std::string_view program);

}  // namespace mfar::eval
