#pragma once

#include "compare/measure/registry.hpp"

/// The kinds of observables, each declared here and defined in the file that holds its rule.
namespace surge::compare {

[[nodiscard]] ObservableKind front_kind();
[[nodiscard]] ObservableKind gauge_kind();
[[nodiscard]] ObservableKind column_height_kind();
[[nodiscard]] ObservableKind profile_kind();
[[nodiscard]] ObservableKind volume_kind();
[[nodiscard]] ObservableKind centre_of_mass_kind();
[[nodiscard]] ObservableKind kinetic_energy_kind();
[[nodiscard]] ObservableKind potential_energy_kind();
[[nodiscard]] ObservableKind detached_kind();
[[nodiscard]] ObservableKind overlap_kind();
[[nodiscard]] ObservableKind pressure_kind();
[[nodiscard]] ObservableKind force_kind();

}  // namespace surge::compare
