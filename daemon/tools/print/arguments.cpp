#include "daemon/tools/print/arguments.h"

#include "daemon/number_range.h"
#include "daemon/output_checks.h"
#include "daemon/tools/calibrate/target.h"
#include "daemon/tools/command_failure.h"
#include "daemon/tools/print/printed_page.h"
#include "pipeline/track/tag_family.h"

#include <algorithm>
#include <tuple>

namespace mfar::print {
namespace {

constexpr double kSmallest = 0.002, kLargest = 1;  // limits of the edges of tags and squares [m]
constexpr int kLargestId = std::ranges::max(kTagFamilies, {}, &TagFamilyInfo::count).count - 1;

template <class Values>
std::vector<std::string> namesOf(const Values& values) {
    std::vector<std::string> out;
    for (const auto& one : values)
        out.emplace_back(one.name);
    return out;
}

/// Refuses ids with leading zeros. CLI11 would read them as octal numbers.
CLI::Validator decimal() {
    return CLI::Validator(
        [](const std::string& text) {
            return hasLeadingZero(text) ? text + ": ids are written without leading zeros"
                                        : std::string();
        },
        "");
}

CLI::Validator svgFile() {
    return CLI::Validator(
        [](const std::string& name) {
            return name.ends_with(".svg") ? std::string() : name + ": the name must end with .svg";
        },
        "");
}

void addPage(CLI::App& command, PrintArguments& a) {
    command.add_option("--paper", a.paper, "paper to print on")
        ->transform(CLI::IsMember(namesOf(kPapers), CLI::ignore_case))
        ->capture_default_str();
    command.add_option("--out", a.out, "file to write; its name must end with .svg")
        ->required()
        ->check(svgFile())
        ->check(fileToWrite());
    command.failure_message(commandFailure);
}

CLI::App* addTags(CLI::App& app, PrintArguments& a) {
    CLI::App* command = app.add_subcommand("tags", "draw one page with AprilTags");
    command->add_option("id", a.ids, "ids of the tags")
        ->required()
        ->check(CLI::Range(0, kLargestId))
        ->check(decimal());
    command->add_option("--family", a.family, "family of the tags")
        ->check(CLI::IsMember(namesOf(kTagFamilies)))
        ->capture_default_str();
    command
        ->add_option(
            "--size", a.tagSize,
            "distance between two adjacent corners of a tag [m], as tag_size in mfard.toml")
        ->check(numberFrom(kSmallest, kLargest))
        ->capture_default_str();
    addPage(*command, a);
    return command;
}

CLI::App* addGrid(CLI::App& app, PrintArguments& a) {
    CLI::App* command = app.add_subcommand(
        "aprilgrid", "draw an AprilGrid for mfar-calibrate, and write its description for "
                     "--aprilgrid into a file of the same name that ends with .yaml");
    for (const auto& [name, value, what] : {std::tuple("--columns", &a.columns, "tags in a row"),
                                            std::tuple("--rows", &a.rows, "rows of tags")})
        command->add_option(name, *value, what)
            ->check(CLI::Range(1, calibration::kMostPerSide))
            ->capture_default_str();
    command->add_option("--spacing", a.spacing, "gap between tags, divided by the edge of a tag")
        ->check(numberFrom(0.1, 1))
        ->capture_default_str();
    command
        ->add_option("--size", a.gridTagSize,
                     "edge of a tag [m]; default: the largest whole number of mm that fits")
        ->check(numberFrom(kSmallest, kLargest));
    addPage(*command, a);
    return command;
}

CLI::App* addBoard(CLI::App& app, PrintArguments& a) {
    CLI::App* command =
        app.add_subcommand("checkerboard", "draw a checkerboard for mfar-calibrate");
    command->add_option("corners", a.board, "numbers of inner corners")->capture_default_str();
    command
        ->add_option("--square", a.square,
                     "edge of a square [m]; default: the largest whole number of mm that fits")
        ->check(numberFrom(kSmallest, kLargest));
    addPage(*command, a);
    return command;
}

}  // namespace

PrintParser::PrintParser()
    : tags(addTags(app, arguments)), grid(addGrid(app, arguments)),
      board(addBoard(app, arguments)) {
    app.require_subcommand(1);
    app.failure_message(commandFailure);
}

}  // namespace mfar::print
