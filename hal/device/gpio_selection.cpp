#include "hal/device/gpio_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace mfar {
namespace {

constexpr std::string_view kDeviceFolder = "/dev", kPrefix = "gpiochip";

std::optional<unsigned> number(std::string_view text) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

bool denied(int error) {
    return error == EACCES || error == EPERM;
}

std::string because(int error) {
    if (denied(error)) return "permission denied: the user must be in the group gpio";
    return std::generic_category().message(error);
}

std::string describe(const GpioChip& chip) {
    if (chip.error != 0) return fmt::format("{} ({})", chip.name, because(chip.error));
    return fmt::format("{} ({}, {} lines)", chip.name, chip.label, chip.lines.size());
}

constexpr const char* kNoChip = "this machine has no GPIO chip that programs can use";

std::string listChips(const std::vector<GpioChip>& chips) {
    if (chips.empty()) return kNoChip;
    std::vector<std::string> texts;
    for (const GpioChip& chip : chips)
        texts.push_back(describe(chip));
    return fmt::format("available GPIO chips: {}", fmt::join(texts, ", "));
}

std::string listNames(const std::vector<const GpioChip*>& chips) {
    if (chips.empty()) return kNoChip;
    std::vector<std::string> texts;
    for (const GpioChip* chip : chips) {
        std::vector<std::string> names;
        for (const GpioLine& line : chip->lines)
            if (!line.name.empty()) names.push_back(line.name);
        if (!names.empty())
            texts.push_back(fmt::format("{}: {}", chip->name, fmt::join(names, ", ")));
        else if (chip->error != 0)
            texts.push_back(describe(*chip));
    }
    if (texts.empty()) return "no GPIO line has a name; set `line` to a number";
    return fmt::format("named lines: {}", fmt::join(texts, "; "));
}

/// Returns all chips if `wanted` is empty. Throws if no chip is called `wanted`.
std::vector<const GpioChip*> chipsFor(const std::vector<GpioChip>& chips, std::string_view wanted) {
    // `wanted` may be a symbolic link to a chip. An absolute `wanted` replaces the folder.
    std::error_code error;
    const auto device =
        std::filesystem::canonical(std::filesystem::path(kDeviceFolder) / wanted, error);
    std::vector<const GpioChip*> found;
    for (const GpioChip& chip : chips)
        if (wanted.empty() || wanted == chip.path || wanted == chip.name || device == chip.path)
            found.push_back(&chip);
    if (wanted.empty() || !found.empty()) return found;
    for (const GpioChip& chip : chips)
        if (wanted == chip.label) found.push_back(&chip);
    if (found.empty())
        throw std::runtime_error(fmt::format("no GPIO chip has the label, name or path '{}'; {}",
                                             wanted, listChips(chips)));
    return found;
}

GpioAddress address(const GpioChip& chip, const GpioLine& line) {
    const std::string name = line.name.empty() ? "" : fmt::format(" '{}'", line.name);
    const std::string user = line.consumer.empty() ? "the kernel" : "'" + line.consumer + "'";
    return {chip.path, line.offset, false,
            fmt::format("line {}{} of {} ({})", line.offset, name, chip.name, chip.label),
            line.used ? user : ""};
}

GpioAddress byNumber(const std::vector<const GpioChip*>& chips, std::string_view chip,
                     unsigned wanted) {
    if (chip.empty())
        throw std::runtime_error(
            fmt::format("GPIO line {} is given by its number, so `chip` must be set, too", wanted));
    if (chips.size() > 1)
        throw std::runtime_error(fmt::format(
            "{} GPIO chips have the label '{}'; set `chip` to a name or path", chips.size(), chip));
    for (const GpioLine& line : chips[0]->lines)
        if (line.offset == wanted) return address(*chips[0], line);
    if (chips[0]->error != 0)
        throw std::runtime_error(
            fmt::format("GPIO chip {}: {}", chips[0]->path, because(chips[0]->error)));
    throw std::runtime_error(
        fmt::format("there is no line {} on GPIO chip {}", wanted, describe(*chips[0])));
}

GpioAddress byName(const std::vector<const GpioChip*>& chips, std::string_view wanted) {
    std::vector<GpioAddress> found;
    for (const GpioChip* chip : chips)
        for (const GpioLine& line : chip->lines)
            if (line.name == wanted) found.push_back(address(*chip, line));
    if (found.empty())
        throw std::runtime_error(
            fmt::format("no GPIO line is named '{}'; {}", wanted, listNames(chips)));
    if (found.size() > 1)
        throw std::runtime_error(fmt::format(
            "more than one GPIO line is named '{}': {} and {}; set `chip` to the chip of the "
            "wanted line, and `line` to its number",
            wanted, found[0].text, found[1].text));
    return found[0];
}

}  // namespace

GpioAddress findGpioLine(const std::vector<GpioChip>& chips, std::string_view chip,
                         std::string_view line) {
    if (line.empty())
        throw std::runtime_error(
            "no GPIO line is given for the trigger; set `line` in [cameras.trigger]");
    const std::vector<const GpioChip*> candidates = chipsFor(chips, chip);
    const std::optional<unsigned> offset = number(line);
    return offset ? byNumber(candidates, chip, *offset) : byName(candidates, line);
}

std::string gpioRequestFault(const GpioAddress& line, int error) {
    if (error != EBUSY) return fmt::format("GPIO {}: {}", line.text, because(error));
    return fmt::format("GPIO {} is in use by {}", line.text,
                       line.consumer.empty() ? "another program" : line.consumer);
}

std::vector<std::string> gpioChipPaths(const std::string& folder) {
    std::vector<std::pair<unsigned, std::string>> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename();
        std::error_code unknown;
        if (!name.starts_with(kPrefix) || entry.is_symlink(unknown)) continue;
        if (const auto index = number(std::string_view(name).substr(kPrefix.size())))
            found.emplace_back(*index, entry.path());
    }
    std::ranges::sort(found);
    std::vector<std::string> paths;
    for (auto& [index, path] : found)
        paths.push_back(std::move(path));
    return paths;
}

}  // namespace mfar
