#pragma once

#include <opencv2/core.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mfar::eval::test {

/// Folder of the metrics' reference vectors. It may be missing.
[[nodiscard]] std::filesystem::path referenceFolder();

/// A row of a table. Its values are found by the name of their column.
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

/// The rows of a table in the reference folder; empty if the folder is missing.
[[nodiscard]] std::vector<ReferenceRow> referenceTable(const std::string& file);

/// A picture in the reference folder, in grey levels: CV_64F or CV_64FC3 (B G R).
[[nodiscard]] cv::Mat referencePicture(const std::string& name);

/// The scene of the reference pictures, drawn at `scale` times their size, CV_8U. The other
/// functions give the same scene with 3.6 times larger pixels, interpolated bilinearly, or blurred.
[[nodiscard]] cv::Mat referenceScene(int scale);
[[nodiscard]] cv::Mat bilinearFromLow(const cv::Mat& scene);
[[nodiscard]] cv::Mat blurred(const cv::Mat& scene, double sigma);

}  // namespace mfar::eval::test
