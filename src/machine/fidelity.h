#pragma once
// Fidelity: how far simulations with a machine file were from recorded runs.

#include <array>
#include <optional>
#include <string_view>

namespace clsurf {

enum class FidelityBasis : unsigned char {
    fit,               ///< the runs that the values were fitted to: too optimistic
    cross_validation,  ///< each run simulated with the values fitted to the other runs
    test,              ///< runs that were not used for the fit
};
inline constexpr std::array<std::string_view, 3> fidelity_basis_names{"fit", "cross-validation", "test"};
[[nodiscard]] constexpr std::string_view name_of(FidelityBasis basis) {
    return fidelity_basis_names[static_cast<std::size_t>(basis)];
}

/// The worst values over the runs; recall and precision count the defects of all of them.
struct Fidelity {
    FidelityBasis basis = FidelityBasis::test;
    int runs = 0;
    double time_error = 0;             ///< simulated over recorded time, minus 1; the greatest, signed
    double speed_error_p50 = 0;        ///< [mm/s] |difference| at the same place, median along the path
    double speed_error_p95 = 0;        ///< [mm/s] not exceeded over 95 % of the path
    double speed_error_p95_ratio = 0;  ///< the same relative to the run's usual speed
    std::optional<double>
        following_error_p95;  ///< [mm] |difference| not exceeded over 95 % of the path; nullopt: no measured positions
    std::optional<double> following_error_ratio;  ///< the same relative to the 95 % following error of the log
    std::optional<double> defects_recall;  ///< defects of the logs that simulations have, 0 … 1; nullopt: no defects
    std::optional<double> defects_precision;  ///< defects of the simulations that the logs have, 0 … 1
};

}  // namespace clsurf
