#pragma once

#include <opencv2/core.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mfar::eval::test {

/// Folder of the metrics' reference data. It may be missing.
[[nodiscard]] std::filesystem::path referenceFolder();

class ReferenceRow {
public:
    explicit ReferenceRow(std::map<std::string, std::string> fields) : fields_(std::move(fields)) {}
    [[nodiscard]] const std::string& text(const std::string& column) const {
        return fields_.at(column);
    }
    [[nodiscard]] double number(const std::string& column) const {
        return std::stod(fields_.at(column));
    }

private:
    std::map<std::string, std::string> fields_;
};

/// Rows of a table in the reference folder; empty if the folder is missing.
[[nodiscard]] std::vector<ReferenceRow> referenceTable(const std::string& file);

/// Picture from the reference folder in grey levels: CV_64F or CV_64FC3 (B G R).
[[nodiscard]] cv::Mat referencePicture(const std::string& name);

/// The scene of the reference pictures, CV_8U. referenceScene() draws it at `scale` times the size
/// of these pictures. bilinearFromLow() reduces `scene` by a factor of 3.6, and enlarges the result
/// bilinearly to the size of `scene`.
[[nodiscard]] cv::Mat referenceScene(int scale);
[[nodiscard]] cv::Mat bilinearFromLow(const cv::Mat& scene);
[[nodiscard]] cv::Mat blurred(const cv::Mat& scene, double sigma);

}  // namespace mfar::eval::test
