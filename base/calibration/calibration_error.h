#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace mfar {

/// A calibration cannot be used. The message begins with "file:line: " (or "file: " where no line
/// is at fault) and states the fault in one line.
class CalibrationError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws CalibrationError; line 0: no line is at fault.
[[noreturn]] void calibrationFault(const std::filesystem::path& file, int line,
                                   std::string_view what);

}  // namespace mfar
