#include "daemon/taken_line.h"

#include "base/bounded_file.h"
#include "base/whole_file.h"
#include "daemon/exit_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mfar {
namespace {

constexpr std::size_t kMostBytes = 1024;
constexpr std::size_t kLongestName = 256;

bool isName(std::string_view text) {
    const auto isPrintable = [](char c) {
        return static_cast<unsigned char>(c) >= ' ' && c != 127;
    };
    return text.size() <= kLongestName && std::ranges::all_of(text, isPrintable);
}

std::string_view valueOf(std::string_view key, std::string_view& text) {
    const std::size_t end = text.find('\n');
    if (end == text.npos || !text.starts_with(key))
        throw std::runtime_error(fmt::format("has no line {}", key));
    const std::string_view value = text.substr(key.size(), end - key.size());
    if (!isName(value))
        throw std::runtime_error(fmt::format("the value of {} is not a valid name", key));
    text.remove_prefix(end + 1);
    return value;
}

TriggerLineConfig parsed(std::string_view text) {
    TriggerLineConfig out;
    out.chip = valueOf("chip=", text);
    out.line = valueOf("line=", text);
    const std::string_view activeLow = valueOf("active_low=", text);
    if (activeLow != "true" && activeLow != "false")
        throw std::runtime_error("the value of active_low= is neither true nor false");
    if (!text.empty()) throw std::runtime_error("has more than three lines");
    out.activeLow = activeLow == "true";
    return out;
}

}  // namespace

std::filesystem::path takenLineFile() {
    const char* folder = std::getenv("RUNTIME_DIRECTORY");
    return folder != nullptr && *folder == '/' ? std::filesystem::path(folder) / "trigger"
                                               : std::filesystem::path();
}

void noteTakenLine(const std::filesystem::path& file, const TriggerLineConfig& line) {
    if (!isName(line.chip) || !isName(line.line))
        throw std::runtime_error("the name of the GPIO chip or line is too long or not printable");
    const std::string text =
        fmt::format("chip={}\nline={}\nactive_low={}\n", line.chip, line.line, line.activeLow);
    writeWholeFile(file, text);
}

std::optional<TriggerLineConfig> takenLine(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
        return std::nullopt;
    try {
        return parsed(boundedText(file, kMostBytes, FileTrust::OwnFile));
    } catch (const std::runtime_error& error) {
        throw Failure(ExitCode::BadData, fmt::format("{}: {}", file.string(), error.what()));
    }
}

}  // namespace mfar
