#include "base/calibration/yaml_reader.h"

#include "base/bounded_file.h"
#include "base/calibration/yaml_bounds.h"

#include <fmt/format.h>

#include <cmath>

namespace mfar {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20;

int lineOf(const YAML::Mark& mark) {
    return mark.is_null() ? 0 : mark.line + 1;
}

}  // namespace

void calibrationFault(const std::filesystem::path& file, int line, std::string_view what) {
    if (line > 0) throw CalibrationError(fmt::format("{}:{}: {}", file.string(), line, what));
    throw CalibrationError(fmt::format("{}: {}", file.string(), what));
}

YamlReader::YamlReader(const std::filesystem::path& file) : file_(file) {
    std::string text;
    try {
        text = boundedText(file, kMaxBytes);
    } catch (const std::runtime_error& error) {
        fail(error.what());
    }
    root_ = boundedYaml(text);
    if (!root_.IsMap()) calibrationFault(file_, 1, "is not a YAML map");
}

YAML::Node YamlReader::at(const YAML::Node& map, const char* key) const {
    if (!map.IsMap()) fail(map, fmt::format("has no key {}", key));
    YAML::Node node = map[key];
    if (node.IsDefined() && !node.IsNull()) return node;
    if (map.is(root_)) fail(fmt::format("has no key {}", key));
    fail(map, fmt::format("has no key {}", key));
}

double YamlReader::number(const YAML::Node& node, const char* what) const {
    double value = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value))
        fail(node, fmt::format("{} is not a number", what));
    if (!std::isfinite(value)) fail(node, fmt::format("{} is not finite", what));
    return value;
}

std::vector<double> YamlReader::numbers(const YAML::Node& node, const char* what) const {
    if (!node.IsSequence()) fail(node, fmt::format("{} is not a list of numbers", what));
    std::vector<double> out;
    for (const YAML::Node& value : node)
        out.push_back(number(value, what));
    return out;
}

std::string YamlReader::word(const YAML::Node& node, const char* what) const {
    if (!node.IsScalar()) fail(node, fmt::format("{} must be a single value", what));
    return node.Scalar();
}

YAML::Node YamlReader::data(const YAML::Node& node, const char* what) const {
    if (!node.IsMap()) return node;
    YAML::Node values = node["data"];
    if (!values.IsDefined()) fail(node, fmt::format("{} has no key \"data\"", what));
    return values;
}

Eigen::MatrixXd YamlReader::matrix(const YAML::Node& node, int rows, int columns,
                                   const char* what) const {
    const YAML::Node list = data(node, what);
    std::vector<double> values;
    if (list.IsSequence() && list.size() > 0 && list[0].IsSequence()) {
        for (const YAML::Node& row : list) {
            const std::vector<double> some = numbers(row, what);
            if (static_cast<int>(some.size()) != columns)
                fail(row, fmt::format("{} has a row of {} numbers; expected {}", what, some.size(),
                                      columns));
            values.insert(values.end(), some.begin(), some.end());
        }
    } else {
        values = numbers(list, what);
    }
    if (static_cast<int>(values.size()) != rows * columns)
        fail(list,
             fmt::format("{} has {} numbers; expected {}", what, values.size(), rows * columns));
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(values.data(), rows, columns);
}

void YamlReader::fail(const YAML::Node& node, const std::string& what) const {
    calibrationFault(file_, lineOf(node.Mark()), what);
}

void YamlReader::fail(const std::string& what) const {
    calibrationFault(file_, 0, what);
}

void readYaml(const std::filesystem::path& file,
              const std::function<void(const YamlReader&)>& read) {
    try {
        read(YamlReader(file));
    } catch (const YAML::Exception& e) {
        calibrationFault(file, lineOf(e.mark), e.msg);
    }
}

}  // namespace mfar
