#include "hal/virtual/recording_csv.h"

#include "hal/virtual/recording.h"

#include <fmt/format.h>

#include <system_error>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

namespace mfar {
namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr std::int64_t kTimeLimit = std::int64_t{1} << 62;

std::string_view trimmed(std::string_view s) {
    constexpr std::string_view kSpace = " \t\r";
    const std::size_t first = s.find_first_not_of(kSpace);
    if (first == s.npos) return {};
    return s.substr(first, s.find_last_not_of(kSpace) - first + 1);
}

// Damaged files may contain any bytes, so control characters are replaced and the text is cut to 60
// characters.
std::string quoted(std::string_view s) {
    std::string out = "'";
    for (const char c : s.substr(0, 60)) {
        const auto byte = static_cast<unsigned char>(c);  // char is signed on some machines only
        out += byte < 32 || byte == 127 ? '?' : c;
    }
    return out + (s.size() > 60 ? "...'" : "'");
}

template <class T>
bool parsed(std::string_view s, T& value) {
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    return error == std::errc{} && end == s.data() + s.size();
}

}  // namespace

void recordingFault(const std::filesystem::path& file, int line, std::string_view what) {
    if (line > 0) throw RecordingError(fmt::format("{}:{}: {}", file.string(), line, what));
    throw RecordingError(fmt::format("{}: {}", file.string(), what));
}

CsvRow::CsvRow(const std::filesystem::path& file, int line, std::string_view text, bool isTorn)
    : file_(file), line_(line), isTorn_(isTorn) {
    std::size_t at = 0;
    for (;;) {
        const std::size_t comma = text.find(',', at);
        fields_.push_back(trimmed(text.substr(at, comma - at)));
        if (comma == text.npos) return;
        at = comma + 1;
    }
}

Timestamp CsvRow::time(std::size_t i) const {
    Timestamp t;
    if (!parsed(text(i), t.ns))
        fail("timestamp " + quoted(text(i)) + " is not a whole number of nanoseconds");
    if (t.ns < 0 || t.ns >= kTimeLimit) fail("timestamp " + quoted(text(i)) + " is out of range");
    return t;
}

double CsvRow::number(std::size_t i) const {
    double value = 0;
    if (!parsed(text(i), value)) fail(quoted(text(i)) + " is not a number");
    if (!std::isfinite(value)) fail(quoted(text(i)) + " is not a finite number");
    return value;
}

void CsvRow::fail(std::string_view what) const {
    recordingFault(file_, line_, what);
}

void forEachCsvRow(const std::filesystem::path& file,
                   const std::function<void(const CsvRow&)>& visit) {
    // Only regular files are opened, because opening a pipe would block.
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        recordingFault(file, 0,
                       error == std::errc::permission_denied ? error.message() : "is missing");
    std::ifstream in(file);
    if (!in) recordingFault(file, 0, "cannot be read");
    std::array<char, kLongestLine + 1> text{};
    for (int line = 1; in.getline(text.data(), text.size()); ++line) {
        std::string_view row(text.data(), static_cast<std::size_t>(in.gcount()));
        if (row.ends_with('\0')) row.remove_suffix(1);
        if (line == 1 && row.starts_with("\xEF\xBB\xBF")) row.remove_prefix(3);
        const bool isTorn = in.eof();
        row = trimmed(row.substr(0, row.find('\0')));
        if (!row.empty() && row.front() != '#') visit(CsvRow(file, line, row, isTorn));
    }
    if (in.bad()) recordingFault(file, 0, "cannot be read");
    if (!in.eof())
        recordingFault(file, 0, fmt::format("has a line of more than {} characters", kLongestLine));
}

}  // namespace mfar
