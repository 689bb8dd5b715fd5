#include "daemon/option_table.h"

#include "base/calibration/plausible_ranges.h"

namespace mfar {
namespace {

constexpr Option text(std::string_view name, std::string_view byDefault, std::string_view meaning) {
    return {name, OptionType::Text, byDefault, meaning};
}

constexpr Option flag(std::string_view name, std::string_view byDefault, std::string_view meaning) {
    return {name, OptionType::Flag, byDefault, meaning};
}

constexpr Option word(std::string_view name, std::string_view words, std::string_view byDefault,
                      std::string_view meaning) {
    return {name, OptionType::Word, byDefault, meaning, words};
}

constexpr Option number(std::string_view name, OptionRange range, std::string_view byDefault,
                        std::string_view meaning) {
    return {name, OptionType::Number, byDefault, meaning, {}, range};
}

constexpr Option whole(std::string_view name, OptionRange range, std::string_view byDefault,
                       std::string_view meaning) {
    return {name, OptionType::Whole, byDefault, meaning, {}, range};
}

constexpr Option numbers(std::string_view name, int count, OptionRange range,
                         std::string_view byDefault, std::string_view meaning) {
    return {name, OptionType::Numbers, byDefault, meaning, {}, range, count};
}

constexpr Option absent(Option option) {
    option.isAbsent = true;
    return option;
}

constexpr Option argument(std::string_view name, Option option) {
    option.argument = name;
    return option;
}

constexpr OptionRange kSide{16, 8192, "px"}, kThreads{1, 64, ""};
constexpr OptionRange kShare{0, 1, ""}, kMegabytes{0, 1e9, "MB"};

constexpr Option kTop[] = {
    argument("--source",
             text("source", R"("cameras")",
                  "Where pictures come from: \"cameras\" (section [cameras]), or a simulated "
                  "board: \"synthetic\", \"synthetic:SCENE\" or \"synthetic:SCENE,PATH\". SCENE is "
                  "one of: office, shelf, outdoor, flat, moving, still, calibration. PATH is the "
                  "camera's motion: handheld, pan, orbit, forward, rotate, rest, survey.")),
    argument("--recording",
             text("recording", R"("")",
                  "Recording (folder in EuRoC layout) to play instead of `source`. Empty: none.")),
    argument("--display",
             text("display", R"("auto")",
                  "Where finished pictures go: \"auto\", the first screen that is found; \"kms\", "
                  "\"kms:card1\" or \"kms:card0,HDMI-A-1,1920x1080@60\" for a card, connector and "
                  "mode; \"fbdev\" or \"fbdev:/dev/fb1\" for a framebuffer; \"png:FOLDER\", one "
                  "file for each frame; \"y4m:FILE\", one video file or named pipe; \"none\", "
                  "nowhere. mfard waits for a screen that is missing.")),
    argument(
        "--size",
        text("size", R"("screen")",
             "Size of finished pictures: \"still\", as wide as the still, with the video's aspect "
             "ratio; \"screen\", the largest such size that fits on the screen found at the start "
             "(without a screen, as \"still\"); or a size into which they must fit, like "
             "\"1280x720\". Never smaller than the video or wider than the still.")),
    argument("--pace",
             word("pace", "auto realtime consumer", R"("auto")",
                  "Speed of the source. \"realtime\": the speed of its time stamps; frames are "
                  "dropped if mfard is too slow. \"consumer\": as fast as mfard processes frames; "
                  "no frame is dropped. \"auto\": \"consumer\" for recordings, otherwise "
                  "\"realtime\".")),
    argument("--seed", whole("seed", {}, "1",
                             "Seed of the synthetic source's random numbers, at least 0: the same "
                             "seed gives the same pictures.")),
};

constexpr Option kCameras[] = {
    text("calibration", R"("")",
         "Path of the calibration of both sensors: a folder with rig.yaml as mfar-calibrate writes "
         "it, a Kalibr camchain or an OpenCV file. Empty: nominal lenses with a horizontal field "
         "of view of 60 degrees, 14 mm apart. These are good enough to enlarge the video, but too "
         "inexact for poses and depth."),
};

constexpr Option kVideo[] = {
    word("driver", "libcamera v4l2", R"("libcamera")",
         "Driver of the camera: \"libcamera\", or \"v4l2\" for USB cameras and boards without "
         "libcamera."),
    text("camera", R"("")",
         "Name of the camera. For driver \"libcamera\": id (as \"cam --list\" prints it), model, "
         "or \"front\", \"back\", \"external\". For \"v4l2\": path, card or bus. Empty: any "
         "but the still camera; if there are several, the one with the smallest pictures. mfard "
         "waits for a camera that is missing."),
    whole("width", kSide, "640", "Width of the camera's pictures."),
    whole("height", kSide, "480", "Height of the camera's pictures."),
    number("rate_hz", {0.01, 1000, "Hz"}, "30.0", "Frame rate."),
    text("format", R"("auto")",
         "Pixel format: \"auto\", or for \"v4l2\" the four characters of a format, like \"YUYV\"."),
    flag("allow_crop", "false",
         "Accept a sensor mode that shows a part of the field of view; \"libcamera\" only."),
    {"controls", OptionType::Values, "{}",
     "Camera controls, as the driver names them, like { ExposureTime = 8000, AnalogueGain = 2.0 }. "
     "They are set before the first picture; for \"v4l2\", in the order of this list."},
};

constexpr Option kStill[] = {
    word("driver", "libcamera v4l2", R"("libcamera")", ""),
    text("camera", R"("")",
         "Name, as in [cameras.video]. Empty: any camera but the video camera; if there "
         "are several, the one with the largest pictures."),
    whole("width", kSide, "2304", ""),
    whole("height", kSide, "1728", ""),
    number("rate_hz", {0, 1000, "Hz"}, "0.0", "Frame rate; 0: a picture for each trigger pulse."),
    text("format", R"("auto")", ""),
    flag("allow_crop", "false", ""),
    {"controls", OptionType::Values, "{}", ""},
};

constexpr Option kLine[] = {
    text("line", R"("")",
         "Number or name of the GPIO line that triggers the still sensor. Empty: there is no "
         "trigger line, and every still that the camera sends is used."),
    text("chip", R"("")",
         "Label, name or path of the line's GPIO chip. Empty: any chip with a line of this name."),
    flag("active_low", "false", "The line is active when its level is low."),
    number("pulse_ms", {0.001, 10000, "ms"}, "1.0", "Length of a pulse, below trigger.timeout_s."),
    flag("pulse_is_exposure", "false", "The sensor exposes as long as the pulse lasts."),
    text("loopback", R"("")",
         "Number or name of a GPIO input that is wired to the trigger line, to measure the times "
         "of its pulses. Empty: there is no such input."),
    text("loopback_chip", R"("")",
         "GPIO chip of the loopback input. Empty: the chip of the trigger line."),
    number("delay_ms", {-1000, 10000, "ms"}, "0.0",
           "First estimate of the time from a trigger pulse to the start of the exposure, as the "
           "camera's time stamps report it. mfard learns the exact value."),
    number("jitter_ms", {0.001, 1000, "ms"}, "1.0",
           "Largest error of the camera's time stamps: 1 ms if the sensor sets them; more if they "
           "are times of arrival, as with USB cameras, or an automatic exposure shifts them."),
    number("arrival_ms", {1, 60000, "ms"}, "500.0",
           "A still that has not arrived this long after its exposure counts as lost."),
};

constexpr std::string_view kEngines = "auto gles simd", kAuto = R"("auto")";
constexpr Option kEngine[] = {
    argument(
        "--engine",
        word(
            "use", kEngines, kAuto,
            "Engine that computes the pictures: \"gles\", shaders on the GPU; \"simd\", vector "
            "units of the CPU, without OpenGL ES; \"auto\": \"simd\" if there is no OpenGL ES 3.1, "
            "or only in software, otherwise the faster one for each step, as mfard measures.")),
    word("still", kEngines, kAuto,
         "Engine of the step that prepares a new still; \"auto\": as `use`."),
    word("pyramid", kEngines, kAuto, "Engine of the step that computes image pyramids."),
    word("flow", kEngines, kAuto, "Engine of the step that matches video and still."),
    word("weigh", kEngines, kAuto, "Engine of the step that computes the confidence of matches."),
    word("detail", kEngines, kAuto, "Engine of the step that adds the still's detail."),
    word("occlusion", kEngines, kAuto,
         "Engine of the step that finds which parts of virtual objects are hidden."),
};

constexpr std::string_view kModes = "detail blend off";
constexpr std::string_view kModeMeaning =
    "\"detail\" adds the still's detail as far as the video confirms it, \"blend\" blends the "
    "still in by confidence (the published method), \"off\" only enlarges the video.";
constexpr Option kSuperres[] = {
    argument("--mode", word("mode", kModes, R"("detail")", kModeMeaning)),
    flag("skip_unchanged", "true", "Do not recompute parts in which the video did not change."),
    flag("learn", "true",
         "Learn in the background, from matched stills, how to enlarge the video of these two "
         "sensors. The learned filters are kept in the service's state folder."),
};

constexpr Option kTrigger[] = {
    word("mode", "demand rate off", R"("demand")",
         "When the still sensor takes a picture: \"demand\", when the current still no longer "
         "explains the video; \"rate\", at a fixed rate; \"off\", never."),
    number("rate_hz", {0.01, 60, "Hz"}, "2.0", "For mode \"rate\": stills per second."),
    number("explained_below", kShare, "0.6",
           "For mode \"demand\": take a new still when the current one explains less than this "
           "share of the picture."),
    number("max_age_s", {0.1, 86400, "s"}, "10.0",
           "For mode \"demand\": take a new still when the current one is older than this and the "
           "picture has changed."),
    number("min_interval_s", {0, 3600, "s"}, "0.3",
           "For mode \"demand\": shortest time between two stills."),
    number("timeout_s", {0.05, 60, "s"}, "3.0",
           "A still that has not arrived this long after its request counts as lost and is "
           "requested once more."),
};

constexpr std::string_view kFamilies = "tag36h11 tag25h9 tag16h5 tagStandard41h12";
constexpr OptionRange kTagSize{plausible::kTagSize.least, plausible::kTagSize.most, "m"};
constexpr Option kPose[] = {
    argument("--pose", word("source", "tags recorded none", R"("tags")",
                            "Where the camera's pose comes from: \"tags\", AprilTags in the video "
                            "and in each still; \"recorded\", the recording, which must have "
                            "poses; \"none\", there are no poses. With poses, frames are matched "
                            "with the still along epipolar lines, otherwise in both dimensions.")),
    text("tags", R"("")",
         "Path of the tag map: a tags.toml, or the tags.yaml of apriltag_ros. Empty: the tags.toml "
         "of the recording or the tags of the simulated board; if there is no map, the largest tag "
         "with a usable pose defines the world."),
    {"families", OptionType::Texts, R"(["tag36h11"])",
     "Families of tags to find if there is no map; with a tags.yaml, its tags' family.", kFamilies},
    number("tag_size", kTagSize, "0.1",
           "Edge length of the tag that defines the world when there is no map."),
    number("decimation", {1, 8, ""}, "2.0",
           "Factor by which the video is reduced before it is searched for tags: 1.5 or a whole "
           "number. A larger factor is faster but misses small tags."),
    whole("threads", kThreads, "1", "Number of threads that search for tags, for each sensor."),
    whole("full_search_interval", {1, 1'000'000, "frames"}, "15",
          "Longest time between searches of the whole picture for tags. Other frames are searched "
          "at the expected positions first."),
    whole("bridge_frames", {0, 300, "frames"}, "12",
          "Largest number of consecutive frames without a tag for which the pose is predicted."),
};

constexpr Option kGovernor[] = {
    number("deadline_ms", {0, 10000, "ms"}, "0.0",
           "Time limit of a frame. mfard uses the most accurate level in `table` that meets this "
           "limit in 95 % of the frames. 0: no limit, the highest accuracy."),
    text("pin", R"("")", "Name of the level that is always used. Empty: mfard chooses the level."),
    text("table", R"("")",
         "Path of the file with the levels, which \"mfar-bench pareto --table FILE\" writes. "
         "Empty: levels that were measured on two x86-64 cores without a GPU."),
};

constexpr Option kRecord[] = {
    text("directory", R"("")",
         "Folder in which each start of mfard creates a recording, a folder named by the time "
         "(UTC). It may be relative to mfard's working directory. Empty: nothing is recorded."),
    number("least_free_mb", kMegabytes, "512",
           "When less disk space than this would be free, the recording ends, and mfard goes on "
           "without it. 0: no limit."),
    number("most_mb", kMegabytes, "0", "Largest size of a recording. 0: no limit."),
};

constexpr Option kLimits[] = {
    number("memory_mb", {0, 1048576, "MB"}, "0",
           "Memory limit for pictures, models and all other files; at least 64. A recording, "
           "camera, model or picture that needs more is refused. 0: three quarters of the "
           "machine's memory, or of the service's MemoryMax= if that is less, and at most 4096."),
};

constexpr Option kStatus[] = {
    number("interval_s", {0.1, 3600, "s"}, "1.0",
           "Time between status lines on the terminal and in systemctl status."),
    argument("--measure", flag("measure", "false",
                               "Wait for the GPU after each stage, so that stage times are exact. "
                               "This costs some speed.")),
};

constexpr Option kVirtual[] = {
    word("rendering", "path-traced preview", R"("path-traced")",
         "How virtual objects are drawn: \"path-traced\", with soft shadows on the real surface, "
         "or \"preview\", which takes little time, needs OpenGL ES and shows simple shapes only."),
    number("budget_ms", {0.1, 1000, "ms"}, "8.0",
           "Processor time for path tracing in each frame; twice this for the first picture."),
    word("slicing", "time space", R"("time")",
         "Which part of a path-traced picture is computed in each frame: \"time\", some samples of "
         "all pixels; \"space\", all samples of some tiles."),
    whole("samples", {1, 65536, ""}, "64",
          "Samples per pixel of a path-traced picture. More samples: less noise, more time."),
    number("resolution", {0.05, 1, ""}, "0.28",
           "Width and height of the path-traced picture as a share of the largest output, which is "
           "as wide as a still. It is never larger than the output or the GPU's textures."),
    word("holes", "push-pull re-render both none", R"("both")",
         "Filling of holes (pixels that come into view between two path-traced pictures). "
         "\"push-pull\": from colours around them; \"re-render\": by a few path-traced samples, "
         "shadows by \"push-pull\"; \"both\": \"push-pull\" until samples are ready; or \"none\"."),
    whole("threads", kThreads, "1", "Number of threads of the path tracer."),
    flag("filter", "true", "Smooth the noise of pictures with few samples, but not their edges."),
    number("turn_deg", {0.1, 90, "degrees"}, "4.0",
           "A new path-traced picture is made at the latest when the direction from which the "
           "camera sees an object has changed by this angle."),
};

constexpr Option kLight[] = {
    text("environment", R"("studio")",
         "Light on virtual objects: \"studio\", \"sky\", \"camera\" (the light that the video "
         "shows), or a latitude-longitude picture, a .hdr, PNG or JPEG file relative to the "
         "configuration file. White in PNG and JPEG is a radiance of 1."),
    number("exposure", {0.001, 1000, ""}, "1.0", "Factor of the brightness of virtual objects."),
};

constexpr Option kSun[] = {
    numbers("direction", 3, {-1000, 1000, ""}, "[0.406, -0.304, 0.862]",
            "Direction to the sun in the world: a vector x, y, z of any length but 0."),
    numbers("irradiance", 3, {0, 10000, ""}, "[1.0, 1.0, 1.0]",
            "Irradiance of a surface that faces the sun: red, green, blue."),
    number("radius_deg", {0.05, 45, "degrees"}, "1.146", "Angular radius of the sun."),
};

constexpr Option kObjects[] = {
    absent(text("model", R"("showpiece")",
                "\"showpiece\" or a glTF file (.glb, .gltf), relative to the configuration "
                "file. Absent: a simple shape.")),
    number("scale", {0.0001, 10000, ""}, "1.0", "Factor by which a model is enlarged."),
    absent(whole("tag", {0, 2114, ""}, "0",
                 "Id of the tag that the object stands on. The object's axes are then x right and "
                 "y up in the print, z out of it. Absent: the object is in the world of the tag "
                 "map; without a map, on the first tag. The upper limit depends on the family.")),
    word("family", kFamilies, R"("tag36h11")", "Family of the tag that the object stands on."),
    numbers("position", 3, {-1000, 1000, "m"}, "[0.0, 0.0, 0.0]",
            "Position of the object in the world or on its tag."),
    numbers("orientation", 4, {-1, 1, ""}, "[1.0, 0.0, 0.0, 0.0]",
            "Orientation of the object: a quaternion w, x, y, z of length 1."),
    word("shape", "box sphere quad", R"("box")", "Shape to draw. `position` is its centre."),
    numbers("size", 3, {0.001, 100, "m"}, "[0.1, 0.1, 0.1]", "Size of a shape along its axes."),
    absent(numbers("colour", 3, kShare, "[0.9, 0.9, 0.9]",
                   "Colour of a shape: red, green, blue. Absent: a checkerboard of two colours.")),
    absent(numbers("second_colour", 3, kShare, "[0.8, 0.2, 0.1]",
                   "Colour of every second square. Absent: as `colour` if that is present.")),
    whole("squares", {1, 256, ""}, "4", "Number of squares of the checkerboard along each side."),
};

constexpr OptionSection kConfig[] = {
    {"", kTop, ""},
    {"cameras", kCameras, ""},
    {"cameras.video", kVideo, "The video sensor."},
    {"cameras.still", kStill, "The still sensor; same keys as [cameras.video]."},
    {"cameras.trigger", kLine, "The line that triggers the still sensor."},
    {"engine", kEngine, ""},
    {"superres", kSuperres, "", true},
    {"trigger", kTrigger, "When stills are taken.", true},
    {"pose", kPose, ""},
    {"governor", kGovernor, ""},
    {"record", kRecord, "Recording while mfard runs (EuRoC layout): pictures, tags and poses."},
    {"limits", kLimits, ""},
    {"status", kStatus, "", true},
    {"virtual", kVirtual, "How virtual objects are drawn."},
    {"light", kLight, "", true},
    {"light.sun", kSun, "A sun in addition to the environment's light.", true,
     OptionSection::Kind::Absent},
    {"objects", kObjects, "Virtual objects: one section for each, at most 64.", true,
     OptionSection::Kind::List},
};

constexpr OptionRange kFew{0, 8, ""}, kSmall{0, 2, ""};
constexpr Option kLevel[] = {
    absent(text("name", R"("fast")", "Name of the level, for `pin`; required.")),
    absent(number("ms", {0.001, 60000, "ms"}, "10.0",
                  "Time that a frame takes when everything in it moves; required.")),
    number("psnr_db", {0, 200, "dB"}, "0.0", "PSNR at this level against ground truth."),
    word("mode", kModes, R"("detail")", kModeMeaning),
    flag("cubic", "true", "For mode \"off\": bicubic instead of linear enlargement."),
    flag("learned", "true", "Enlarge by learned filters; for mode \"detail\" only."),
    flag("along_lines", "true", "If poses are known, search for matches along epipolar lines."),
    number("detail_share", {0.001, 1, ""}, "1.0",
           "Largest share of tiles that may be matched with the still; not for mode \"blend\"."),
    number("second_share", kShare, "0.25",
           "With `learned`: largest share of tiles that are matched with a second still. 0: none."),
    whole("depth_every", {1, 60, "frames"}, "1",
          "Interval at which the depth of the real scene is measured."),
    whole("flow2d.search_radius", {0, 40, "px"}, "10",
          "Radius of the search for a cell's flow at the coarsest pyramid level."),
    whole("flow2d.candidates", {1, 4, ""}, "4",
          "Number of flow vectors from the next coarser pyramid level that each cell tries."),
    whole("flow2d.steps", {0, 16, ""}, "4",
          "Gauss-Newton steps that refine a cell's best flow vector."),
    whole("flow2d.propagations", kFew, "0",
          "At the finest pyramid level: number of rounds in which cells try neighbours' flow."),
    whole("flow2d.coarsest_propagations", kFew, "4",
          "At the coarsest pyramid level: number of rounds in which cells try neighbours' flow."),
    whole("flow2d.plane_fits", kSmall, "2",
          "Number of rounds in which planes are fitted to the flow after its median filter."),
    whole("epipolar.window_radius", {0, 8, "px"}, "2",
          "Candidates of a pixel are the matches of the coarser pyramid level within this radius."),
    whole("epipolar.step_penalty", {1, 30, ""}, "12",
          "Smoothness penalty where neighbouring pixels differ by one candidate."),
    whole("epipolar.jump_penalty", {1, 60, ""}, "60",
          "Penalty for neighbours two or more candidates apart; lower at edges in the picture."),
    whole("epipolar.finest", kSmall, "0",
          "Finest pyramid level that is searched: 0, 1 and 2 have the full, half and quarter width "
          "and height."),
    whole("epipolar.most_predicted", {0, 60, "frames"}, "7",
          "Largest number of consecutive frames that are searched only near the previous match."),
};

constexpr OptionSection kLevels[] = {{"level", kLevel, "", false, OptionSection::Kind::List}};

}  // namespace

std::span<const OptionSection> configOptions() {
    return kConfig;
}

std::span<const OptionSection> levelOptions() {
    return kLevels;
}

}  // namespace mfar
