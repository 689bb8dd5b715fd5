#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace mfar {

/// Reports that a calibration cannot be used. The message is one line. If the fault is in a file,
/// the message begins with the file's name and the line ("file:12: "), or with "file: " if the
/// fault has no line.
class CalibrationError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

[[noreturn]] void calibrationFault(const std::filesystem::path& file, int line,
                                   std::string_view what);

}  // namespace mfar
