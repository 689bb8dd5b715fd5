#pragma once

#include "hal/virtual/image_files.h"
#include "tests/unit/temp_folder.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mfar::test {

/// A picture whose bytes are all `level`, so that it can be recognised after lossless compression.
inline StoredImage plain(Size size, std::uint8_t level, PixelFormat format = PixelFormat::Rgba8) {
    StoredImage image{size, format, {}};
    image.pixels.assign(static_cast<std::size_t>(size.width) * size.height * bytesPerPixel(format),
                        level);
    return image;
}

constexpr Size kSmallVideo{16, 12};
constexpr Size kSmallStill{32, 24};

inline std::string smallSensorYaml(Size size, double rateHz, double x) {
    // Tests use these line numbers: 5 data of T_BS, 9 rate_hz, 10 resolution, 11 camera_model, 12
    // intrinsics, 13 distortion_model, 14 distortion_coefficients.
    return fmt::format("sensor_type: camera\n"
                       "T_BS:\n"
                       "  cols: 4\n"
                       "  rows: 4\n"
                       "  data: [1.0, 0.0, 0.0, {},\n"
                       "         0.0, 1.0, 0.0, 0.0,\n"
                       "         0.0, 0.0, 1.0, 0.0,\n"
                       "         0.0, 0.0, 0.0, 1.0]\n"
                       "rate_hz: {}\n"
                       "resolution: [{}, {}]\n"
                       "camera_model: pinhole\n"
                       "intrinsics: [20.5, 21.5, 7.5, 5.5] #fu, fv, cu, cv\n"
                       "distortion_model: radial-tangential\n"
                       "distortion_coefficients: [0.1, -0.02, 0.001, 0.002]\n",
                       x, rateHz, size.width, size.height);
}

inline void writeCamera(const std::filesystem::path& folder, const std::string& yaml, Size size,
                        const std::vector<std::int64_t>& times) {
    writeFile(folder / "sensor.yaml", yaml);
    std::filesystem::create_directories(folder / "data");
    std::string csv = "#timestamp [ns],filename\n";
    for (std::size_t i = 0; i < times.size(); ++i) {
        const std::string name = fmt::format("{}.png", times[i]);
        savePng(folder / "data" / name, plain(size, static_cast<std::uint8_t>(10 * i)).view());
        csv += fmt::format("{},{}\n", times[i], name);
    }
    writeFile(folder / "data.csv", csv);
}

/// Writes a valid recording. Picture i of a camera has the grey level 10 i. The still sensor is
/// 0.014 m to the right of the video sensor. The body, to which both sensors are fixed, is at (1,
/// 2, 3) [m] at the time 1 s. At 2 s it is at (2, 2, 3), rotated by 90 degrees about z.
inline void writeSmallRecording(const std::filesystem::path& root,
                                const std::vector<std::int64_t>& video = {1'000'000'000,
                                                                          1'500'000'000,
                                                                          2'000'000'000},
                                const std::vector<std::int64_t>& stills = {1'500'000'000}) {
    writeCamera(root / "cam0", smallSensorYaml(kSmallVideo, 30, 0), kSmallVideo, video);
    writeCamera(root / "cam1", smallSensorYaml(kSmallStill, 0, 0.014), kSmallStill, stills);
    writeFile(root / "state_groundtruth_estimate0" / "data.csv",
              "#timestamp,px,py,pz,qw,qx,qy,qz\n"
              "1000000000,1,2,3,1,0,0,0\n"
              "2000000000,2,2,3,0.70710678,0,0,0.70710678\n");
}

}  // namespace mfar::test
