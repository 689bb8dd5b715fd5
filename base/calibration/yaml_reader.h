#pragma once

#include "base/calibration/calibration_error.h"

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mfar {

/// Reads values of one YAML file; every failure is a CalibrationError with the line of the value.
/// Also reads YAML that OpenCV's FileStorage wrote.
class YamlReader {
public:
    [[nodiscard]] const YAML::Node& root() const { return root_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] bool has(const char* key) const { return root_[key].IsDefined(); }
    /// A required value.
    [[nodiscard]] YAML::Node at(const char* key) const { return at(root_, key); }
    [[nodiscard]] YAML::Node at(const YAML::Node& map, const char* key) const;
    /// Finite numbers; `what` names the value in messages.
    [[nodiscard]] double number(const YAML::Node& node, const char* what) const;
    [[nodiscard]] std::vector<double> numbers(const YAML::Node& node, const char* what) const;
    [[nodiscard]] std::string word(const YAML::Node& node, const char* what) const;
    /// The `data` of a matrix that is written as a map, or the node itself.
    [[nodiscard]] YAML::Node data(const YAML::Node& node, const char* what) const;
    /// A list of rows, one flat list row by row, or a map with either as its `data`.
    [[nodiscard]] Eigen::MatrixXd matrix(const YAML::Node& node, int rows, int columns,
                                         const char* what) const;
    [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const;
    /// Throws a CalibrationError about the whole file.
    [[noreturn]] void fail(const std::string& what) const;

private:
    friend void readYaml(const std::filesystem::path& file,
                         const std::function<void(const YamlReader&)>& read);
    explicit YamlReader(const std::filesystem::path& file);

    std::filesystem::path file_;
    YAML::Node root_;
};

/// Opens a file and calls `read` with its reader. Throws CalibrationError, also for errors that the
/// YAML library finds.
void readYaml(const std::filesystem::path& file,
              const std::function<void(const YamlReader&)>& read);

}  // namespace mfar
