#include "daemon/tools/calibrate/target.h"

#include "base/calibration/yaml_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace mfar::calibration {
namespace {

int wholeNumber(const YamlReader& in, const char* key, int least, int most) {
    const YAML::Node node = in.at(key);
    const double value = in.number(node, key);
    if (!(value >= least && value <= most) || value != std::floor(value))
        in.fail(node,
                fmt::format("{} {} is not a whole number from {} to {}", key, value, least, most));
    return static_cast<int>(value);
}

double length(const YamlReader& in, const char* key, double most) {
    const YAML::Node node = in.at(key);
    const double value = in.number(node, key);
    if (!(value > 0 && value <= most))
        in.fail(node, fmt::format("{} {} is not between 0 and {}", key, value, most));
    return value;
}

}  // namespace

Target aprilGrid(int columns, int rows, double tagSize, double spacing, int firstId) {
    Target out{TargetKind::AprilGrid, columns, rows, tagSize, spacing, firstId, {}};
    const double pitch = tagSize * (1 + spacing);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double x = column * pitch, y = row * pitch;
            out.points.insert(out.points.end(), {{x, y, 0},
                                                 {x + tagSize, y, 0},
                                                 {x + tagSize, y + tagSize, 0},
                                                 {x, y + tagSize, 0}});
        }
    }
    return out;
}

void checkTagCount(int tags) {
    constexpr int kLeastTags = kLeastViewCorners / 4;
    if (tags < kLeastTags)
        throw std::runtime_error(fmt::format(
            "an AprilGrid needs at least {} tags, because fewer give no precise pose", kLeastTags));
    if (tags > kGridFamily.count)
        throw std::runtime_error(fmt::format(
            "the AprilGrid has {} tags, but its family has only {}", tags, kGridFamily.count));
}

Target checkerboard(int columns, int rows, double square) {
    if (!(columns >= 3 && columns <= kMostPerSide && rows >= 3 && rows <= kMostPerSide))
        throw std::runtime_error(fmt::format(
            "a checkerboard needs 3 to {} inner corners along each side", kMostPerSide));
    if ((columns + rows) % 2 == 0)
        throw std::runtime_error(
            fmt::format("a checkerboard of {}x{} inner corners looks the same upside down: one "
                        "number must be odd, the other even",
                        columns, rows));
    if (!(square > 0 && square <= 10))
        throw std::runtime_error(fmt::format(
            "the edge of a square must be above 0 and at most 10 m, but is {} m", square));
    Target out{TargetKind::Checkerboard, columns, rows, square, 0, 0, {}};
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            out.points.emplace_back(column * square, row * square, 0);
    return out;
}

Target checkerboard(std::string_view corners, double square) {
    int columns = 0, rows = 0;
    const char* const end = corners.data() + corners.size();
    const auto first = std::from_chars(corners.data(), end, columns);
    const bool cross = first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x';
    const auto second = cross ? std::from_chars(first.ptr + 1, end, rows) : first;
    if (!cross || second.ec != std::errc{} || second.ptr != end)
        throw std::runtime_error(fmt::format(
            "checkerboard '{}' is invalid; expected the numbers of inner corners, like 9x6",
            corners));
    return checkerboard(columns, rows, square);
}

Target readAprilGrid(const std::filesystem::path& file) {
    Target out;
    readYaml(file, [&](const YamlReader& in) {
        const YAML::Node kind = in.at("target_type");
        if (const std::string type = in.word(kind, "target_type"); type != "aprilgrid")
            in.fail(kind,
                    fmt::format("target_type '{}' is not supported; expected aprilgrid", type));
        const int columns = wholeNumber(in, "tagCols", 1, kMostPerSide);
        const int rows = wholeNumber(in, "tagRows", 1, kMostPerSide);
        try {
            checkTagCount(columns * rows);
        } catch (const std::runtime_error& error) {
            in.fail(error.what());
        }
        const int first = in.has("codeOffset")
                              ? wholeNumber(in, "codeOffset", 0, kGridFamily.count - columns * rows)
                              : 0;
        out = aprilGrid(columns, rows, length(in, "tagSize", 10), length(in, "tagSpacing", 10),
                        first);
    });
    return out;
}

}  // namespace mfar::calibration
