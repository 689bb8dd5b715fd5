#pragma once

#include "base/time.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Throws RecordingError with the message "file:line: fault", or "file: fault" for line 0.
[[noreturn]] void recordingFault(const std::filesystem::path& file, int line,
                                 std::string_view what);

/// A row of data in a CSV file. Its fields have no surrounding spaces and are valid only during the
/// visit of the row.
class CsvRow {
public:
    CsvRow(const std::filesystem::path& file, int line, std::string_view text, bool isTorn);

    /// Returns true if this is the last row and has no newline. A power cut may have truncated such
    /// a row.
    [[nodiscard]] bool isTorn() const { return isTorn_; }
    [[nodiscard]] std::size_t size() const { return fields_.size(); }
    [[nodiscard]] std::string_view text(std::size_t i) const { return fields_.at(i); }
    /// Returns field i as a timestamp [ns] in 0 <= t < 2^62, so that later sums and differences
    /// cannot overflow. Throws RecordingError.
    [[nodiscard]] Timestamp time(std::size_t i) const;
    [[nodiscard]] double number(std::size_t i) const;
    [[noreturn]] void fail(std::string_view what) const;

private:
    const std::filesystem::path& file_;
    int line_;
    bool isTorn_;
    std::vector<std::string_view> fields_;
};

/// Visits the rows of data in a CSV file. Skips blank lines, lines that begin with '#', a byte
/// order mark and carriage returns. Throws RecordingError if the file cannot be read or has a line
/// of more than 4096 characters.
void forEachCsvRow(const std::filesystem::path& file,
                   const std::function<void(const CsvRow&)>& visit);

}  // namespace mfar
