// The machine in a simulated log is read back; foreign and damaged metadata give none.

#include "io/reports/simulation_origin.h"

#include <gtest/gtest.h>

namespace clsurf::io::simulation_origin_test {
namespace {

Log log_with(std::string metadata) {
    Log log;
    log.metadata = std::move(metadata);
    return log;
}

TEST(SimulationOrigin, ComesBack) {
    Machine machine;
    machine.name = "mill \"7\"";
    Fidelity fidelity;
    fidelity.basis = FidelityBasis::cross_validation;
    fidelity.runs = 3;
    fidelity.time_error = -0.0123;
    fidelity.speed_error_p95 = 0.5;  // 30 mm/min
    fidelity.following_error_p95 = 0.004;
    fidelity.defects_recall = 0.9;
    machine.fidelity = fidelity;
    const std::optional<SimulationOrigin> origin = simulation_origin(log_with(with_simulation("{}", machine)));
    ASSERT_TRUE(origin);
    EXPECT_EQ(origin->machine, machine.name);
    ASSERT_TRUE(origin->fidelity);
    EXPECT_EQ(origin->fidelity->basis, FidelityBasis::cross_validation);
    EXPECT_EQ(origin->fidelity->runs, 3);
    EXPECT_NEAR(origin->fidelity->time_error, -0.0123, 1e-9);
    EXPECT_NEAR(origin->fidelity->speed_error_p95, 0.5, 1e-9);
    EXPECT_NEAR(*origin->fidelity->following_error_p95, 0.004, 1e-9);
    EXPECT_NEAR(*origin->fidelity->defects_recall, 0.9, 1e-9);
    EXPECT_FALSE(origin->fidelity->defects_precision);
    EXPECT_EQ(origin_text(origin),
              "This log was simulated for the machine \"mill \"7\"\".\n"
              "Fidelity of this machine file (runs, each left out of the fit: 3): time -1.23 %, speed within 30 mm/min "
              "over 95 % of the path, following error within 4 µm, 90 % of the defects found.\n");
}

TEST(SimulationOrigin, WhatThereWasStays) {
    const std::string text = with_simulation(R"({"work_offset": [1, 2, 3]})", Machine{});
    EXPECT_NE(text.find("work_offset"), std::string::npos);
    const std::optional<SimulationOrigin> origin = simulation_origin(log_with(text));
    ASSERT_TRUE(origin);
    EXPECT_FALSE(origin->fidelity) << "never measured";
}

TEST(SimulationOrigin, OtherMetadata) {
    for (const char* metadata :
         {"", "{", "[]", "{}", "7", R"({"simulation": 7})", R"({"simulation": null})", R"({"simulation": []})"})
        EXPECT_FALSE(simulation_origin(log_with(metadata))) << metadata;
    for (const char* fidelity :
         {"7", "[]", "{}", R"({"basis": "luck", "runs": 1})", R"({"basis": 7})",
          R"({"basis": "fit", "runs": "x", "time_error_percent": 1, "speed_error_p95_mm_min": 1})",
          R"({"basis": "fit", "runs": -1, "time_error_percent": 1, "speed_error_p95_mm_min": 1})"}) {
        const auto origin =
            simulation_origin(log_with(std::string(R"({"simulation": {"machine": 7, "fidelity": )") + fidelity + "}}"));
        ASSERT_TRUE(origin) << fidelity;
        EXPECT_FALSE(origin->fidelity) << fidelity;
        EXPECT_EQ(origin->machine, "");
    }
}

}  // namespace
}  // namespace clsurf::io::simulation_origin_test
