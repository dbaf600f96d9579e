// clsurf compare: two pictures, for snapshots in CI.

#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/report_output.h"
#include "cli/pictures/picture_output.h"
#include "io/files/atomic_file.h"
#include "io/reports/json_text.h"
#include "io/reports/junit.h"
#include "viz/image_compare.h"

namespace clsurf::cli {
namespace {

constexpr const char* compare_formats = "text|json|junit";

std::string verdict_of(const viz::Comparison& c, const viz::CompareRule& rule) {
    return fmt::format(
        "{}: {} pixels differ by more than {:.4f} of full brightness; largest difference {:.4f}, mean {:.6f}, "
        "signal-to-noise ratio (PSNR) {:.1f} dB, largest colour difference {:.1f} ΔE (1 is just visible)",
        c.equal ? "equal" : "different", c.pixels_over, rule.threshold, c.max_error, c.mean_error, c.psnr, c.delta_e);
}

void replace_reference(const std::string& path, std::string_view bytes) {
    io::AtomicFile file(path, io::Replaces::an_input);
    file.write(bytes);
    file.commit();
}

void ignore_texts(viz::Image& a, const std::string& made, viz::Image& b, const std::string& reference) {
    for (const auto& [image, name] : {std::pair(&a, &made), std::pair(&b, &reference)}) {
        if (image->texts.empty())
            throw InputError(
                Place::of_file(*name), "does not say where its texts are, which --ignore-text needs",
                "PNG pictures of clsurf with texts do; make it again, or compare pictures made with --no-legend");
    }
    viz::blank_texts(a, b);
}

std::string junit_of(const std::string& made, const std::string& reference, const std::string& verdict, bool equal) {
    return io::junit_text(
        {{"clsurf compare", made, {{"equals " + reference, equal ? "" : verdict, "", ""}}, verdict + "\n"}});
}

ExitCode run_compare(const po::variables_map& values) {
    const std::string made = required(values, "A.png");
    const std::string reference = required(values, "B.png");
    viz::CompareRule rule;
    if (values.count("threshold") > 0) {
        rule.threshold = values["threshold"].as<double>();
        if (!(rule.threshold >= 0 && rule.threshold <= 1)) throw UsageError("--threshold must be 0 … 1");
    }
    io::guard_input(made);
    io::guard_input(reference);
    ReportOutput output(values, compare_formats);
    std::optional<PictureOutput> difference;
    if (values.count("diff") > 0) difference.emplace(values["diff"].as<std::string>(), "--diff");
    viz::Image a = viz::read_image(made);
    const bool update = values.count("update") > 0;
    const bool missing = update && !std::filesystem::exists(reference);
    io::ComparisonReport report;
    report.threshold = rule.threshold;
    std::string verdict;
    if (missing) {
        verdict = "reference was missing";
    } else {
        viz::Image b = viz::read_image(reference);
        if (a.width != b.width || a.height != b.height) {
            verdict = fmt::format("sizes differ: {}x{} and {}x{}", a.width, a.height, b.width, b.height);
            report.max_error = report.mean_error = 1;
        } else {
            if (values.count("ignore-text") > 0) ignore_texts(a, made, b, reference);
            const viz::Comparison c = viz::compare(a, b, rule);
            report = {c.equal, c.max_error, c.mean_error, c.psnr, c.delta_e, rule.threshold, c.pixels_over};
            verdict = verdict_of(c, rule);
            if (difference)
                difference->write(viz::difference_picture(a, b), "difference of " + made + " and " + reference);
        }
    }
    if (update && !report.equal) {
        const io::Source source = io::map_file(made);
        replace_reference(reference, source.text());
        verdict += "; reference updated";
        report.equal = true;
    }
    if (output.format() == "json")
        output.write(io::comparison_json(report));
    else if (output.format() == "junit")
        output.write(junit_of(made, reference, verdict, report.equal));
    else
        output.write(verdict + "\n");
    return report.equal ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace

Subcommand compare_subcommand() {
    return {
        .name = "compare",
        .arguments = "A.png B.png",
        .summary = "compares two pictures, for snapshot tests",
        .description =
            "A is the new picture, B the reference. They differ when more than 0.02 % of the values are\n"
            "off by more than the threshold, or any by more than three times that: exit code 1.\n\n"
            "  clsurf compare map.png snapshots/map.png --diff difference.png",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("threshold", po::value<double>()->value_name("T"), "largest difference that is ignored, 0 … 1 (default: 1/255)")
                    ("ignore-text", "ignore words and numbers in the pictures, so that another name of the log does not count as a difference; PNG pictures of clsurf only")
                    ("diff", po::value<std::string>()->value_name("OUT.png"), "a picture of the differences")
                    ("update", "replace the reference by A if they differ or B is missing");
                // clang-format on
                declare_report_output(options, compare_formats);
            },
        .positional = {"A.png", "B.png"},
        .run = run_compare,
    };
}

}  // namespace clsurf::cli
