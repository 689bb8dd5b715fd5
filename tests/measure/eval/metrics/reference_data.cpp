#include "tests/measure/eval/metrics/reference_data.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mfar::eval::test {
namespace {

std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> out;
    std::string field;
    bool quoted = false;
    for (const char c : line)
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            out.push_back(std::exchange(field, {}));
        else
            field += c;
    out.push_back(field);
    return out;
}

std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t k) {
    std::uint32_t n = 374761393U * x + 668265263U * y + 2246822519U * k;
    n = (n ^ (n >> 13)) * 1274126177U;
    return (n ^ (n >> 16)) & 255U;
}

int lattice(int x, int y, int c, int k) {
    const auto at = [&](int i, int j) { return static_cast<int>(hash(i, j, k)); };
    const int i = x / c, j = y / c, f = x % c, g = y % c;
    return ((c - f) * (c - g) * at(i, j) + f * (c - g) * at(i + 1, j) + (c - f) * g * at(i, j + 1) +
            f * g * at(i + 1, j + 1)) /
           (c * c);
}

int objectAt(int x, int y, int s, int v) {
    const auto within = [&](int x0, int x1, int y0, int y1) {
        return x >= x0 * s && x < x1 * s && y >= y0 * s && y < y1 * s;
    };
    if (within(20, 110, 18, 80)) v = 40 + lattice(x, y, 4, 6) / 8;
    if (within(34, 60, 30, 64)) v = 215;
    const int dx = x - 200 * s, dy = y - 60 * s, square = dx * dx + dy * dy;
    if (square <= 1600 * s * s) v = 200 - lattice(x, y, 8, 7) / 4;
    if (square <= 324 * s * s) v = 30;
    if (within(24, 120, 100, 190)) v = (x + 2 * y) % 24 < 12 ? 70 : 190;
    if (within(140, 200, 120, 190)) v = ((x / 6) ^ (y / 6)) % 2 != 0 ? 235 : 20;
    if (within(212, 272, 120, 190)) v = hash(x / 2, y / 3, 8) < 96 ? 25 : 225;
    return v;
}

/// Reduces an axis by a factor of 3.6. Returns for each output pixel the source pixels that it
/// covers, each with the number of its fifths that are covered.
std::vector<std::vector<std::pair<int, int>>> areaShares(int out) {
    std::vector<std::vector<std::pair<int, int>>> shares(static_cast<std::size_t>(out));
    for (int i = 0; i < out; ++i)
        for (int k = 18 * i; k < 18 * (i + 1); ++k) {
            auto& of = shares[static_cast<std::size_t>(i)];
            if (of.empty() || of.back().first != k / 5) of.emplace_back(k / 5, 0);
            ++of.back().second;
        }
    return shares;
}

cv::Mat areaAveraged(const cv::Mat& scene) {
    cv::Mat out(scene.rows * 5 / 18, scene.cols * 5 / 18, CV_8U);
    const auto xs = areaShares(out.cols), ys = areaShares(out.rows);
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x) {
            int sum = 0;
            for (const auto& [j, wy] : ys[static_cast<std::size_t>(y)])
                for (const auto& [i, wx] : xs[static_cast<std::size_t>(x)])
                    sum += wy * wx * scene.at<std::uint8_t>(j, i);
            out.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((2 * sum + 324) / 648);
        }
    return out;
}

std::pair<int, int> bilinearAt(int x, int from, int to) {
    const int at = std::clamp((2 * x + 1) * from - to, 0, 2 * to * (from - 1));
    return {std::min(at / (2 * to), from - 2), at - std::min(at / (2 * to), from - 2) * 2 * to};
}

}  // namespace

std::filesystem::path referenceFolder() {
    return std::filesystem::path(MFAR_SHARED_METRICS) / "ref";
}

std::vector<ReferenceRow> referenceTable(const std::string& file) {
    std::vector<ReferenceRow> out;
    std::ifstream in(referenceFolder() / file);
    std::string line;
    if (!std::getline(in, line)) return out;
    const auto names = fieldsOf(line);
    while (std::getline(in, line)) {
        const auto fields = fieldsOf(line);
        if (fields.size() != names.size()) throw std::runtime_error(line);
        std::map<std::string, std::string> row;
        for (std::size_t i = 0; i < names.size(); ++i)
            row[names[i]] = fields[i];
        out.emplace_back(std::move(row));
    }
    return out;
}

cv::Mat referencePicture(const std::string& name) {
    const std::string suffix = name.starts_with("rgb_") ? ".ppm" : ".pgm";
    const auto file = referenceFolder() / "img" / (name + suffix);
    const cv::Mat picture = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    if (picture.empty()) throw std::runtime_error(file.string() + ": cannot be read");
    cv::Mat out;
    picture.convertTo(out, CV_64F);
    return out;
}

cv::Mat referenceScene(int scale) {
    cv::Mat out(216 * scale, 288 * scale, CV_8U);
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x) {
            const int noise =
                (6 * lattice(x, y, 64, 1) + 4 * lattice(x, y, 16, 2) + 3 * lattice(x, y, 8, 3) +
                 2 * lattice(x, y, 4, 4) + lattice(x, y, 2, 5)) /
                16;
            out.at<std::uint8_t>(y, x) =
                static_cast<std::uint8_t>(objectAt(x, y, scale, 64 + noise / 2));
        }
    return out;
}

cv::Mat bilinearFromLow(const cv::Mat& scene) {
    const cv::Mat low = areaAveraged(scene);
    cv::Mat out(scene.size(), CV_8U);
    const std::int64_t w = 2 * scene.cols, h = 2 * scene.rows;
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x) {
            const auto [i, f] = bilinearAt(x, low.cols, out.cols);
            const auto [j, g] = bilinearAt(y, low.rows, out.rows);
            const std::int64_t top =
                (w - f) * low.at<std::uint8_t>(j, i) + f * low.at<std::uint8_t>(j, i + 1);
            const std::int64_t below =
                (w - f) * low.at<std::uint8_t>(j + 1, i) + f * low.at<std::uint8_t>(j + 1, i + 1);
            const std::int64_t sum = (h - g) * top + g * below;
            out.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((2 * sum + w * h) / (2 * w * h));
        }
    return out;
}

cv::Mat blurred(const cv::Mat& scene, double sigma) {
    const int reach = static_cast<int>(std::ceil(4 * sigma));
    std::vector<double> taps;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
        sum += taps.emplace_back(std::exp(-i * i / (2 * sigma * sigma)));
    cv::Mat values;
    scene.convertTo(values, CV_64F);
    for (const bool along : {true, false}) {
        cv::Mat next(values.size(), CV_64F);
        for (int y = 0; y < values.rows; ++y)
            for (int x = 0; x < values.cols; ++x) {
                double v = 0;
                for (int i = -reach; i <= reach; ++i) {
                    const int sx = std::clamp(x + (along ? i : 0), 0, values.cols - 1);
                    const int sy = std::clamp(y + (along ? 0 : i), 0, values.rows - 1);
                    v +=
                        taps[static_cast<std::size_t>(i + reach)] / sum * values.at<double>(sy, sx);
                }
                next.at<double>(y, x) = v;
            }
        values = next;
    }
    cv::Mat out(values.size(), CV_8U);
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x)
            out.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
                std::clamp(std::floor(values.at<double>(y, x) + 0.5), 0.0, 255.0));
    return out;
}

}  // namespace mfar::eval::test
