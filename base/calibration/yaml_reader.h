#pragma once

#include "base/calibration/calibration_error.h"

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mfar {

/// Reads values of one YAML file, including files of OpenCV's FileStorage. Every failure throws a
/// CalibrationError, with the line of the value if the value exists.
class YamlReader {
public:
    [[nodiscard]] const YAML::Node& root() const { return root_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] bool has(const char* key) const { return root_[key].IsDefined(); }
    [[nodiscard]] YAML::Node at(const char* key) const { return at(root_, key); }
    [[nodiscard]] YAML::Node at(const YAML::Node& map, const char* key) const;
    /// Reads finite numbers. NaN and infinity are failures. `what` names the value in messages.
    [[nodiscard]] double number(const YAML::Node& node, const char* what) const;
    [[nodiscard]] std::vector<double> numbers(const YAML::Node& node, const char* what) const;
    [[nodiscard]] std::string word(const YAML::Node& node, const char* what) const;
    /// Returns the node that lists a matrix's numbers: the entry `data` if `node` is a map,
    /// otherwise `node` itself.
    [[nodiscard]] YAML::Node data(const YAML::Node& node, const char* what) const;
    /// Reads a matrix that is written as a list of rows, as one flat list in row-major order, or as
    /// a map whose entry `data` is such a list.
    [[nodiscard]] Eigen::MatrixXd matrix(const YAML::Node& node, int rows, int columns,
                                         const char* what) const;
    [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const;
    [[noreturn]] void fail(const std::string& what) const;

private:
    friend void readYaml(const std::filesystem::path& file,
                         const std::function<void(const YamlReader&)>& read);
    explicit YamlReader(const std::filesystem::path& file);

    std::filesystem::path file_;
    YAML::Node root_;
};

/// Opens a file and calls `read` with a reader of its content. Throws CalibrationError.
/// Exceptions of the YAML library are turned into CalibrationError.
void readYaml(const std::filesystem::path& file,
              const std::function<void(const YamlReader&)>& read);

}  // namespace mfar
