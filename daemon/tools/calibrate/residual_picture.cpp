#include "daemon/tools/calibrate/residual_picture.h"

#include "hal/virtual/image_files.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace mfar::calibration {
namespace {

// The picture is drawn at kFine times its size and then reduced, which smooths letters and lines.
constexpr int kFine = 2;
constexpr int kWidth = 1320, kRow = 620, kMargin = 40, kTop = 64, kBottom = 40;
constexpr int kArea = kRow - kTop - kBottom;
constexpr int kColumns = 16, kRows = 12;
constexpr int kLeastCount = 4;
constexpr double kLongestArrow = 1.3;  // [cell widths]; longer arrows are shortened
const cv::Scalar kPaper(255, 255, 255), kInk(40, 40, 40), kFaint(190, 190, 190),
    kPanel(248, 248, 248);

class Canvas {
public:
    Canvas(int width, int height) : image_(height * kFine, width * kFine, CV_8UC3, kPaper) {}

    void text(cv::Point2d at, const std::string& words, double size, const cv::Scalar& colour) {
        cv::putText(image_, words, fine(at), cv::FONT_HERSHEY_SIMPLEX, size * kFine, colour,
                    size > 0.6 ? 3 : 2, cv::LINE_AA);
    }
    void box(cv::Rect2d r, const cv::Scalar& colour, bool filled) {
        cv::rectangle(image_, fine(r.tl()), fine(r.br()), colour, filled ? cv::FILLED : 2);
    }
    void line(cv::Point2d a, cv::Point2d b, const cv::Scalar& colour, int thickness = 2) {
        cv::line(image_, fine(a), fine(b), colour, thickness, cv::LINE_AA);
    }
    void arrow(cv::Point2d a, cv::Point2d b, const cv::Scalar& colour) {
        const double length = cv::norm(b - a);
        cv::arrowedLine(image_, fine(a), fine(b), colour, 3, cv::LINE_AA, 0,
                        std::clamp(5 / std::max(length, 1e-6), 0.15, 0.5));
    }
    void circle(cv::Point2d at, double radius, const cv::Scalar& colour) {
        cv::circle(image_, fine(at), static_cast<int>(std::lround(radius * kFine)), colour, 2,
                   cv::LINE_AA);
    }
    void dot(cv::Point2d at, const cv::Vec3b& colour, double strength) {
        const cv::Point p = fine(at);
        for (int y = p.y - 1; y <= p.y + 1; ++y)
            for (int x = p.x - 1; x <= p.x + 1; ++x)
                if (x >= 0 && y >= 0 && x < image_.cols && y < image_.rows) {
                    auto& pixel = image_.at<cv::Vec3b>(y, x);
                    for (int k = 0; k < 3; ++k)
                        pixel[k] = cv::saturate_cast<std::uint8_t>((1 - strength) * pixel[k] +
                                                                   strength * colour[k]);
                }
    }
    void save(const std::filesystem::path& file) const {
        cv::Mat small, rgba;
        cv::resize(image_, small, image_.size() / kFine, 0, 0, cv::INTER_AREA);
        cv::cvtColor(small, rgba, cv::COLOR_RGB2RGBA);
        savePng(file, {rgba.ptr(), {rgba.cols, rgba.rows}, rgba.step, PixelFormat::Rgba8});
    }

private:
    static cv::Point fine(cv::Point2d p) {
        return {static_cast<int>(std::lround(p.x * kFine)),
                static_cast<int>(std::lround(p.y * kFine))};
    }
    cv::Mat image_;
};

double roundedUp(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1., 2., 5.})
        if (step * power >= value) return step * power;
    return 10 * power;
}

struct Cell {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int count = 0;
};
using Cells = std::array<std::array<Cell, kColumns>, kRows>;

template <class Visit>
void forEachResidual(const SensorResult& sensor, const Visit& visit) {
    for (const ViewResult& view : sensor.views)
        if (view.used)
            for (std::size_t i = 0; i < view.corners.size(); ++i)
                visit(view.corners[i].pixel, view.residuals[i]);
}

Cells cellsOf(const SensorResult& sensor) {
    Cells out;
    const Size size = sensor.camera.size;
    forEachResidual(sensor, [&](const Eigen::Vector2d& p, const Eigen::Vector2d& r) {
        const int x = static_cast<int>((p.x() + 0.5) / size.width * kColumns);
        const int y = static_cast<int>((p.y() + 0.5) / size.height * kRows);
        Cell& cell = out[std::clamp(y, 0, kRows - 1)][std::clamp(x, 0, kColumns - 1)];
        cell.sum += r;
        ++cell.count;
    });
    return out;
}

/// Returns the scale of the arrows. It is the residual [px] whose arrow is as long as a cell is
/// wide. At least nine of ten mean residuals are at most this long.
double arrowUnit(const Cells& cells) {
    std::vector<double> lengths{1e-4};
    for (const auto& row : cells)
        for (const Cell& c : row)
            if (c.count >= kLeastCount) lengths.push_back((c.sum / c.count).norm());
    const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 9 / 10);
    std::nth_element(lengths.begin(), at, lengths.end());
    return roundedUp(*at);
}

cv::Scalar heat(double share) {
    const double s = std::clamp(share, 0., 1.);
    return {40 + 180 * s, 90 - 30 * s, 170 - 130 * s};
}

void drawArea(Canvas& canvas, cv::Rect2d area, const SensorResult& sensor) {
    canvas.box(area, kPanel, true);
    const double scale = area.width / sensor.camera.size.width;
    const auto at = [&](double x, double y) {
        return cv::Point2d(area.x + (x + 0.5) * scale, area.y + (y + 0.5) * scale);
    };
    forEachResidual(sensor, [&](const Eigen::Vector2d& p, const Eigen::Vector2d&) {
        canvas.dot(at(p.x(), p.y()), {140, 155, 180}, 0.45);
    });
    const double cell = area.width / kColumns;
    const Cells cells = cellsOf(sensor);
    const double unit = arrowUnit(cells);
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x) {
            const Cell& c = cells[y][x];
            if (c.count < kLeastCount) continue;
            Eigen::Vector2d mean = c.sum / c.count / unit;
            if (mean.norm() > kLongestArrow) mean *= kLongestArrow / mean.norm();
            const cv::Point2d from(area.x + (x + 0.5) * cell,
                                   area.y + (y + 0.5) * area.height / kRows);
            const cv::Point2d to = from + cv::Point2d(mean.x(), mean.y()) * cell;
            canvas.arrow(from,
                         {std::clamp(to.x, area.x, area.x + area.width),
                          std::clamp(to.y, area.y, area.y + area.height)},
                         heat(mean.norm()));
        }
    }
    canvas.box(area, kFaint, false);
    const cv::Point2d corner(area.x, area.y + area.height + 24);
    canvas.arrow(corner + cv::Point2d(2, -5), corner + cv::Point2d(2 + cell, -5), kInk);
    canvas.text(
        corner + cv::Point2d(cell + 12, 0),
        fmt::format("{:g} px, mean residual of a cell (measured - expected position)", unit), 0.42,
        kInk);
}

void drawScatter(Canvas& canvas, cv::Rect2d area, const SensorResult& sensor) {
    canvas.box(area, kPanel, true);
    const cv::Point2d middle(area.x + area.width / 2, area.y + area.height / 2);
    const double sigma = std::max(1e-4, sensor.rms / std::sqrt(2.));
    const double scale = area.width / 2 / (4.5 * sigma);
    canvas.line({area.x, middle.y}, {area.x + area.width, middle.y}, kFaint);
    canvas.line({middle.x, area.y}, {middle.x, area.y + area.height}, kFaint);
    forEachResidual(sensor, [&](const Eigen::Vector2d&, const Eigen::Vector2d& r) {
        const cv::Point2d p = middle + cv::Point2d(r.x() * scale, r.y() * scale);
        if (area.contains(p)) canvas.dot(p, {40, 90, 170}, 0.4);
    });
    for (const int n : {1, 2, 3}) {
        canvas.circle(middle, n * sigma * scale, {120, 120, 120});
        canvas.text(middle +
                        cv::Point2d(n * sigma * scale * 0.71 + 3, n * sigma * scale * 0.71 + 12),
                    fmt::format("{} sigma", n), 0.36, kInk);
    }
    canvas.box(area, kFaint, false);
    canvas.text({area.x, area.y + area.height + 24},
                fmt::format("all residuals, sigma {:.3f} px per coordinate", sigma), 0.42, kInk);
}

void drawSensor(Canvas& canvas, int top, const SensorResult& sensor, const std::string& name) {
    const Size size = sensor.camera.size;
    const auto used = std::ranges::count_if(sensor.views, &ViewResult::used);
    canvas.text({kMargin, top + 30.}, name, 0.8, kInk);
    canvas.text({kMargin + 80., top + 30.},
                fmt::format("{}x{}, {} views, RMS reprojection error {:.3f} px", size.width,
                            size.height, used, sensor.rms),
                0.5, kInk);
    const double room = kWidth - 3 * kMargin - kArea;
    const double height = std::min<double>(kArea, room * size.height / size.width);
    const double width = height * size.width / size.height;
    drawArea(canvas, {1. * kMargin, 1. * top + kTop - 16, width, height}, sensor);
    drawScatter(canvas,
                {1. * kWidth - kMargin - kArea, 1. * top + kTop - 16, 1. * kArea, 1. * kArea},
                sensor);
}

}  // namespace

void saveResidualPicture(const std::filesystem::path& file, const Calibration& calibration) {
    Canvas canvas(kWidth, 2 * kRow);
    drawSensor(canvas, 0, calibration.video, "video");
    drawSensor(canvas, kRow, calibration.still, "still");
    canvas.save(file);
}

}  // namespace mfar::calibration
